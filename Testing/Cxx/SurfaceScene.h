// SPDX-License-Identifier: BSD-3-Clause
/**
 * The scenes of picture tests: surfaces side by side, in soft light, from one fixed camera.
 *
 * The inner side of a surface is red, since VTK lights both sides alike: in the picture of a closed surface
 * that is oriented outwards no pixel is red, in that of an open one red is seen through its holes.
 */
#pragma once

#include "RegressionImage.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

namespace silhouette::testing
{

/** A window of 400 x 300 pixels with `columns` x `rows` viewports, filled from the top left. */
class SurfaceScene
{
public:
  explicit SurfaceScene(int columns = 1, int rows = 1) : Columns(columns), Rows(rows)
  {
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(400, 300);
  }

  /** A surface in the next viewport. Flat shading shows cells as they are. */
  vtkActor* add(vtkPolyData* surface, double red, double green, double blue, bool flat = false)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* property = actor->GetProperty();
    property->SetColor(red, green, blue);
    property->SetAmbient(0.15);
    property->SetDiffuse(0.85);
    flat ? property->SetInterpolationToFlat() : property->SetInterpolationToPhong();
    vtkNew<vtkProperty> inner;
    inner->SetColor(1.0, 0.0, 0.0);
    inner->SetAmbient(1.0);
    inner->SetDiffuse(0.0);
    actor->SetBackfaceProperty(inner);
    this->addViewport()->AddActor(actor);
    return actor;
  }

  vtkRenderWindow* window() { return this->Window; }

private:
  vtkRenderer* addViewport()
  {
    const int column = this->Viewports % this->Columns,
              row = this->Rows - 1 - this->Viewports / this->Columns;
    ++this->Viewports;
    vtkNew<vtkRenderer> renderer;
    renderer->SetViewport(double(column) / this->Columns, double(row) / this->Rows,
                          double(column + 1) / this->Columns, double(row + 1) / this->Rows);
    renderer->SetBackground(1.0, 1.0, 1.0);
    // From the left and above, some from the right: the three sides of a cube differ.
    addLight(renderer, -0.6, 0.8, 0.85);
    addLight(renderer, 0.8, 0.1, 0.35);
    addLight(renderer, 0.0, 0.0, 0.2);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetPosition(3.0, -6.0, 3.0); // a three-quarter view, z upwards
    camera->SetViewUp(0.0, 0.0, 1.0);
    // The shapes of vtkSyntheticCaptureSource lie in the unit ball: it is seen whole in a viewport that is
    // narrower than high as in one that is wider.
    const double shape = 400.0 / this->Columns / (300.0 / this->Rows);
    camera->SetParallelScale(1.0 / std::min(1.0, shape));
    camera->SetClippingRange(1.0, 20.0);
    this->Window->AddRenderer(renderer);
    return renderer;
  }

  static void addLight(vtkRenderer* renderer, double right, double up, double intensity)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(right, up, 1.0);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  }

  vtkNew<vtkRenderWindow> Window;
  int Columns;
  int Rows;
  int Viewports = 0;
};

/** Red pixels of a closed surface that are forgiven: at its rim, where a near and a far side share a pixel. */
constexpr int RimPixels = 10;

/** Pixels that show the inner side of a surface. */
inline int countInnerPixels(vtkImageData* picture)
{
  const auto* pixel = static_cast<const unsigned char*>(picture->GetScalarPointer());
  int count = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i, pixel += 3)
  {
    count += pixel[0] > 250 && pixel[1] < 5 && pixel[2] < 5 ? 1 : 0;
  }
  return count;
}

} // namespace silhouette::testing
