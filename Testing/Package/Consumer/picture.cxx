// SPDX-License-Identifier: BSD-3-Clause
/** Renders a sphere in memory; exit code 0 where its middle is lit. */
#include "SilhouetteOffScreen.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

int main()
{
  silhouette::useOffScreenWindow();
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  window->SetSize(64, 64);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetPixelData(32, 32, 32, 32, 0, pixel);
  return pixel->GetValue(0) > 200 ? 0 : 1;
}
