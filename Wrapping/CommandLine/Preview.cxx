// SPDX-License-Identifier: BSD-3-Clause
#include "Preview.h"

#include "ExitCodes.h"
#include "PreviewCamera.h"
#include "SilhouetteOffScreen.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkImageShrink3D.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>

namespace silhouette::program
{
namespace
{

constexpr int LongSide = 1200;    // pixels
constexpr double Margin = 1.1;    // the picture's extent over the object's
constexpr int SamplesAPixel = 2;  // along each side; every picture is the mean of these
constexpr double LeastShape = 0.6; // of the shorter side to the longer one

/** A light that stays with the camera: `right` and `up` of it in degrees. */
void addLight(vtkRenderer* renderer, double right, double up, double intensity)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(std::sin(right * 0.0174533), std::sin(up * 0.0174533), 1.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

void addMesh(vtkRenderer* renderer, vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(0.86, 0.80, 0.72);
  property->SetInterpolationToPhong();
  property->SetAmbient(0.14);
  property->SetDiffuse(0.85);
  property->SetSpecular(0.06);
  property->SetSpecularPower(20.0);
  renderer->AddActor(actor);
}

void placeCamera(vtkRenderer* renderer, const PreviewCamera& view, double shape)
{
  const double distance = 4.0 * view.radius;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(view.target.data());
  camera->SetPosition(view.target[0] + distance * view.back[0], view.target[1] + distance * view.back[1],
    view.target[2] + distance * view.back[2]);
  camera->SetViewUp(view.up.data());
  camera->SetParallelScale(0.5 * Margin * std::max(view.height, view.width / shape));
  camera->SetClippingRange(distance - 1.5 * view.radius, distance + 1.5 * view.radius);
}

} // namespace

void checkPreview()
{
  if (!useOffScreenWindow())
  {
    throw ProgramError(
      ProcessingFailed, "--image: this program was built without off-screen rendering (OSMesa was not found)");
  }
}

void renderPreview(vtkPolyData* mesh, vtkPartitionedDataSetCollection* views, const std::filesystem::path& file)
{
  checkPreview();
  const PreviewCamera view = previewCamera(mesh, views);
  const double shape = std::clamp(view.width / view.height, LeastShape, 1.0 / LeastShape);
  const int width = static_cast<int>(std::lround(LongSide * std::min(1.0, shape)));
  const int height = static_cast<int>(std::lround(LongSide * std::min(1.0, 1.0 / shape)));

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.82, 0.83, 0.85);
  renderer->SetBackground2(0.96, 0.96, 0.97);
  renderer->GradientBackgroundOn();
  addMesh(renderer, mesh);
  addLight(renderer, -35.0, 40.0, 0.72);
  addLight(renderer, 50.0, 5.0, 0.38);
  addLight(renderer, 0.0, -40.0, 0.2);
  placeCamera(renderer, view, shape);

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(SamplesAPixel * width, SamplesAPixel * height);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput(window);
  pixels->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> mean;
  mean->SetInputConnection(pixels->GetOutputPort());
  mean->SetShrinkFactors(SamplesAPixel, SamplesAPixel, 1);
  mean->MeanOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(mean->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw ProgramError(FileFailed, "cannot write image " + file.string() + "; is the disk full?");
  }
}

} // namespace silhouette::program
