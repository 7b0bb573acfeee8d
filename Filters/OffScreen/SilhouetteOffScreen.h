// SPDX-License-Identifier: BSD-3-Clause
/**
 * One call for every executable that renders off screen, whichever window it gets: ours over OSMesa, or VTK's
 * own. CMake's `silhouette_link_offscreen(target)` defines what is tested here.
 */
#pragma once

#if defined(SILHOUETTE_OFFSCREEN_MODULE)
#include "vtkSilhouetteOffScreenFactory.h"
#else
#include <cstdlib>
#endif

namespace silhouette
{

/**
 * Makes every later `vtkRenderWindow::New()` a window in memory, with no need of a display. Call it first in
 * main(). Returns whether there is such a window in this build; where it is false, windows are VTK's usual
 * ones.
 */
inline bool useOffScreenWindow()
{
#if defined(SILHOUETTE_OFFSCREEN_MODULE)
  vtkSilhouetteOffScreenFactory::EnableOffScreen();
  return true;
#elif defined(SILHOUETTE_OFFSCREEN_VTK)
  // VTK 9.4 and later choose at run time; an OSMesa build before that has no other window, and ignores this.
  setenv("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow", 0);
  return true;
#else
  return false;
#endif
}

} // namespace silhouette
