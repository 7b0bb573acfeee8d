// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSilhouetteOffScreenFactory
 * @brief makes every vtkRenderWindow::New() an OSMesa window
 *
 * After EnableOffScreen() ordinary code and scripts that say `vtkRenderWindow::New()` get a
 * vtkSilhouetteOSMesaRenderWindow, without a change to them.
 *
 * Cost: none. Limits: windows that are made before it stay what they are. A program that should also build
 * where VTK has its own OSMesa window calls useOffScreenWindow() of SilhouetteOffScreen.h instead.
 *
 * @sa vtkSilhouetteOSMesaRenderWindow
 */
#ifndef vtkSilhouetteOffScreenFactory_h
#define vtkSilhouetteOffScreenFactory_h

#include "vtkObjectFactory.h"
#include "vtkSilhouetteOffScreenModule.h" // for the export macro

class VTKSILHOUETTEOFFSCREEN_EXPORT vtkSilhouetteOffScreenFactory : public vtkObjectFactory
{
public:
  static vtkSilhouetteOffScreenFactory* New();
  vtkTypeMacro(vtkSilhouetteOffScreenFactory, vtkObjectFactory);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  const char* GetVTKSourceVersion() override;
  const char* GetDescription() override;

  ///@{
  /**
   * From now on a new vtkRenderWindow is an OSMesa window; DisableOffScreen() ends that. Calling either twice
   * does no more than calling it once.
   */
  static void EnableOffScreen();
  static void DisableOffScreen();
  ///@}

  /** Whether a new vtkRenderWindow is an OSMesa window now. */
  static bool IsOffScreenEnabled();

protected:
  vtkSilhouetteOffScreenFactory();
  ~vtkSilhouetteOffScreenFactory() override = default;

private:
  vtkSilhouetteOffScreenFactory(const vtkSilhouetteOffScreenFactory&) = delete;
  void operator=(const vtkSilhouetteOffScreenFactory&) = delete;
};

#endif
