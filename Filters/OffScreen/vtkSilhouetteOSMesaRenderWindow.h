// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSilhouetteOSMesaRenderWindow
 * @brief a render window in memory, drawn by OSMesa, for a VTK that was built without it
 *
 * Renders with Mesa's software rasteriser into memory: no X server, no DISPLAY, no graphics card. It serves
 * where VTK itself was built for GLX only; where VTK has vtkOSOpenGLRenderWindow that one is used, and this
 * class is not built.
 *
 * | what | value |
 * | --- | --- |
 * | context | OpenGL core profile, version 3.3 or later, 24 depth bits, 8 stencil bits |
 * | size | as set with SetSize(), in pixels; 300 x 300 where never set |
 * | multisampling | off unless SetMultiSamples() asks for it, so that pictures are the same everywhere |
 *
 * The context is made at the first Render() and destroyed by Finalize() or with the window. Pixels are read
 * with vtkWindowToImageFilter or GetPixelData(), as from any window.
 *
 * Cost: one RGBA buffer of the window's size beside VTK's own framebuffers.
 *
 * Limits: VTK's OpenGL loader (GLEW) asks GLX for its functions. The process must therefore answer for GLX
 * with the functions of SilhouetteGLXShim.c, either linked into the executable (CMake:
 * `silhouette_link_offscreen(target)`) or preloaded (`LD_PRELOAD=libsilhouetteglx.so`, which `python3 -m
 * vtksilhouette.offscreen` does). A window in a process without them reports an error and draws nothing. One
 * process renders either here or on X, not both.
 *
 * @sa vtkSilhouetteOffScreenFactory
 */
#ifndef vtkSilhouetteOSMesaRenderWindow_h
#define vtkSilhouetteOSMesaRenderWindow_h

#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkSilhouetteOffScreenModule.h" // for the export macro

#include <memory> // for the private part

class VTKSILHOUETTEOFFSCREEN_EXPORT vtkSilhouetteOSMesaRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkSilhouetteOSMesaRenderWindow* New();
  vtkTypeMacro(vtkSilhouetteOSMesaRenderWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Makes the context if there is none yet. vtkErrorMacro, and nothing made, where that fails. */
  void Initialize() override;

  /** Makes the context, if need be, and draws the scene. Draws nothing where the context cannot be made. */
  void Render() override;

  /** Releases the scene's graphics resources, then the context and its buffer. A later Render() starts anew.
   */
  void Finalize() override;

  /** Makes the context current on a buffer of the window's present size; nothing where there is no context.
   */
  void MakeCurrent() override;

  /** Whether this window's context is the current one of the calling thread. */
  bool IsCurrent() override;

  /** Releases the current context of the calling thread, if it is this window's. */
  void ReleaseCurrent() override;

  /** 1 where the context can be made. */
  int SupportsOpenGL() override;

  /** Software rendering is never direct: 0. */
  vtkTypeBool IsDirect() override;

  /** Ends a picture: what was drawn becomes the front buffer, from which pixels are read. No screen shows it.
   */
  void Frame() override;

  ///@{
  /** Size in pixels, each at least 1. The buffer follows at the next Render(). */
  void SetSize(int width, int height) override;
  void SetSize(int size[2]) override { this->SetSize(size[0], size[1]); }
  ///@}

  /** The OSMesaContext, or null before the first Render(). */
  void* GetGenericContext() override;

  /**
   * Whether this process answers for GLX with OSMesa (see Limits above), without which no context is made.
   */
  static bool IsProcessPrepared();

protected:
  vtkSilhouetteOSMesaRenderWindow();
  ~vtkSilhouetteOSMesaRenderWindow() override;

  void CreateAWindow() override;
  void DestroyWindow() override;

private:
  vtkSilhouetteOSMesaRenderWindow(const vtkSilhouetteOSMesaRenderWindow&) = delete;
  void operator=(const vtkSilhouetteOSMesaRenderWindow&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Private;
};

#endif
