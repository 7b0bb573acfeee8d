// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteOffScreenFactory.h"

#include "vtkAutoInit.h"
#include "vtkNew.h"
#include "vtkObjectFactoryCollection.h"
#include "vtkSilhouetteOSMesaRenderWindow.h"
#include "vtkVersion.h"

// VTK's OpenGL classes register themselves with whoever loads this library, and before EnableOffScreen() is
// called.
VTK_MODULE_INIT(vtkRenderingOpenGL2);

namespace
{

const char* const Overridden = "vtkRenderWindow";

vtkObject* MakeWindow()
{
  return vtkSilhouetteOSMesaRenderWindow::New();
}

/** The registered factory of our class, or null. VTK's list is the only record, so that nothing can disagree.
 */
vtkObjectFactory* FindRegistered()
{
  vtkObjectFactoryCollection* factories = vtkObjectFactory::GetRegisteredFactories();
  vtkCollectionSimpleIterator iterator;
  factories->InitTraversal(iterator);
  while (vtkObjectFactory* factory = factories->GetNextObjectFactory(iterator))
  {
    if (vtkSilhouetteOffScreenFactory::SafeDownCast(factory))
    {
      return factory;
    }
  }
  return nullptr;
}

} // namespace

vtkStandardNewMacro(vtkSilhouetteOffScreenFactory);

vtkSilhouetteOffScreenFactory::vtkSilhouetteOffScreenFactory()
{
  this->RegisterOverride(Overridden, "vtkSilhouetteOSMesaRenderWindow", "render window in memory", 1,
                         MakeWindow);
}

void vtkSilhouetteOffScreenFactory::EnableOffScreen()
{
  if (vtkSilhouetteOffScreenFactory::IsOffScreenEnabled())
  {
    return;
  }
  // VTK asks the factories in the order of their registration, and its own is first: switched off, not
  // removed, because the same factory makes mappers and textures.
  vtkObjectFactory::SetAllEnableFlags(0, Overridden);
  vtkNew<vtkSilhouetteOffScreenFactory> factory;
  vtkObjectFactory::RegisterFactory(factory);
}

void vtkSilhouetteOffScreenFactory::DisableOffScreen()
{
  if (vtkObjectFactory* factory = FindRegistered())
  {
    vtkObjectFactory::UnRegisterFactory(factory);
    vtkObjectFactory::SetAllEnableFlags(1, Overridden);
  }
}

bool vtkSilhouetteOffScreenFactory::IsOffScreenEnabled()
{
  return FindRegistered() != nullptr;
}

const char* vtkSilhouetteOffScreenFactory::GetVTKSourceVersion()
{
  return VTK_SOURCE_VERSION;
}

const char* vtkSilhouetteOffScreenFactory::GetDescription()
{
  return "renders in memory with OSMesa";
}

void vtkSilhouetteOffScreenFactory::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
