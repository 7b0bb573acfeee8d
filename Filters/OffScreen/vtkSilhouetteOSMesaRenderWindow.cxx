// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteOSMesaRenderWindow.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderer.h"
#include "vtkRendererCollection.h"

#include <GL/osmesa.h>

#include <algorithm>
#include <cstdint>
#include <dlfcn.h>
#include <vector>

struct vtkSilhouetteOSMesaRenderWindow::Internals
{
  OSMesaContext Context = nullptr;
  std::vector<std::uint32_t>
      Buffer; // RGBA, what OSMesa calls the screen; VTK draws into framebuffers of its own
  int Width = 0;
  int Height = 0;
  bool Failed = false; // reported once, not at every Render()
};

vtkStandardNewMacro(vtkSilhouetteOSMesaRenderWindow);

vtkSilhouetteOSMesaRenderWindow::vtkSilhouetteOSMesaRenderWindow() : Private(new Internals)
{
  this->SetOwnContext(1);
  this->SetReadyForRendering(true);
  this->SetMultiSamples(0);
  this->SetFrameBlitModeToNoBlit();
  this->ShowWindow = false;
  this->UseOffScreenBuffers = true;
  this->Size[0] = 300;
  this->Size[1] = 300;
}

vtkSilhouetteOSMesaRenderWindow::~vtkSilhouetteOSMesaRenderWindow()
{
  this->Finalize();
  vtkRenderer* renderer = nullptr;
  vtkCollectionSimpleIterator iterator;
  this->Renderers->InitTraversal(iterator);
  while ((renderer = this->Renderers->GetNextRenderer(iterator)))
  {
    renderer->SetRenderWindow(nullptr);
  }
}

bool vtkSilhouetteOSMesaRenderWindow::IsProcessPrepared()
{
  return dlsym(RTLD_DEFAULT, "silhouetteGLXIsOSMesa") != nullptr;
}

void vtkSilhouetteOSMesaRenderWindow::Initialize()
{
  if (!this->Private->Context && !this->Private->Failed)
  {
    this->CreateAWindow();
  }
}

void vtkSilhouetteOSMesaRenderWindow::CreateAWindow()
{
  this->Private->Failed = true;
  if (!vtkSilhouetteOSMesaRenderWindow::IsProcessPrepared())
  {
    vtkErrorMacro("This process does not answer for GLX with OSMesa. Link the executable with "
                  "silhouette_link_offscreen(), or preload libsilhouetteglx.so (Python: python3 -m "
                  "vtksilhouette.offscreen SCRIPT).");
    return;
  }
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_STENCIL_BITS,
                            8,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  this->Private->Context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!this->Private->Context)
  {
    vtkErrorMacro("OSMesa gives no OpenGL 3.3 core context.");
    return;
  }
  this->MakeCurrent();
  if (!this->IsCurrent())
  {
    vtkErrorMacro("OSMesa takes no buffer of " << this->Size[0] << " x " << this->Size[1] << " pixels.");
    this->DestroyWindow();
    return;
  }
  this->Private->Failed = false;
  this->Mapped = 1;
  this->OpenGLInit();
}

void vtkSilhouetteOSMesaRenderWindow::DestroyWindow()
{
  if (this->Private->Context)
  {
    this->ReleaseCurrent();
    OSMesaDestroyContext(this->Private->Context);
  }
  this->Private->Context = nullptr;
  this->Private->Buffer.clear();
  this->Private->Width = 0;
  this->Private->Height = 0;
  this->Mapped = 0;
  this->Initialized = false;
}

void vtkSilhouetteOSMesaRenderWindow::Render()
{
  this->Initialize();
  if (this->Private->Context)
  {
    this->Superclass::Render();
  }
}

void vtkSilhouetteOSMesaRenderWindow::Finalize()
{
  if (this->Private->Context)
  {
    this->Superclass::Finalize();
    this->DestroyWindow();
  }
  this->Private->Failed = false;
}

void vtkSilhouetteOSMesaRenderWindow::MakeCurrent()
{
  Internals& internals = *this->Private;
  if (!internals.Context)
  {
    return;
  }
  const int width = std::max(1, this->Size[0]);
  const int height = std::max(1, this->Size[1]);
  const bool resized = width != internals.Width || height != internals.Height;
  if (!resized && this->IsCurrent())
  {
    return;
  }
  if (resized)
  {
    internals.Buffer.assign(std::size_t(width) * height, 0);
    internals.Width = width;
    internals.Height = height;
  }
  OSMesaMakeCurrent(internals.Context, internals.Buffer.data(), GL_UNSIGNED_BYTE, width, height);
}

bool vtkSilhouetteOSMesaRenderWindow::IsCurrent()
{
  return this->Private->Context && OSMesaGetCurrentContext() == this->Private->Context;
}

void vtkSilhouetteOSMesaRenderWindow::ReleaseCurrent()
{
  if (this->IsCurrent())
  {
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  }
}

int vtkSilhouetteOSMesaRenderWindow::SupportsOpenGL()
{
  this->Initialize();
  return this->Private->Context ? 1 : 0;
}

vtkTypeBool vtkSilhouetteOSMesaRenderWindow::IsDirect()
{
  return 0;
}

void vtkSilhouetteOSMesaRenderWindow::Frame()
{
  this->vtkOpenGLRenderWindow::Frame();
}

void vtkSilhouetteOSMesaRenderWindow::SetSize(int width, int height)
{
  this->Superclass::SetSize(std::max(1, width), std::max(1, height));
}

void* vtkSilhouetteOSMesaRenderWindow::GetGenericContext()
{
  return this->Private->Context;
}

void vtkSilhouetteOSMesaRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Context: " << static_cast<void*>(this->Private->Context) << "\n";
  os << indent << "Buffer: " << this->Private->Width << " x " << this->Private->Height << "\n";
}
