// SPDX-License-Identifier: BSD-3-Clause
#include "Pictures.h"

#include "Error.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>

namespace silhouette::experiments
{
namespace
{

constexpr int Samples = 3; // along each side of a pixel; every picture is their mean

void addSurface(vtkRenderer* renderer, vtkPolyData* surface, const Look& look)
{
  if (surface->GetNumberOfPolys() == 0)
  {
    return; // nothing survived: an empty picture
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  look.flat ? mapper->SetInputData(surface) : mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* outer = actor->GetProperty();
  outer->SetColor(look.colour[0], look.colour[1], look.colour[2]);
  outer->SetAmbient(0.18);
  outer->SetDiffuse(0.82);
  look.flat ? outer->SetInterpolationToFlat() : outer->SetInterpolationToPhong();
  if (look.flat)
  {
    outer->EdgeVisibilityOn();
    outer->SetEdgeColor(0.30, 0.28, 0.26);
    outer->SetLineWidth(0.4 * Samples);
  }
  vtkNew<vtkProperty> inner;
  inner->SetColor(0.80, 0.27, 0.22);
  inner->SetAmbient(0.5);
  inner->SetDiffuse(0.5);
  actor->SetBackfaceProperty(inner);
  renderer->AddActor(actor);
}

/** A light that stays with the camera, beside and above it in units of its distance. */
void addLight(vtkRenderer* renderer, double right, double up, double intensity)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(right, up, 1.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

void addText(vtkRenderer* renderer, const std::string& text, const Look& look, int height, bool bold)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(0.5 * Samples * look.side, Samples * height);
  vtkTextProperty* style = actor->GetTextProperty();
  style->SetFontFamilyToArial();
  style->SetFontSize(Samples * 11);
  style->SetBold(bold);
  style->SetColor(0.25, 0.25, 0.25);
  style->SetJustificationToCentered();
  renderer->AddActor2D(actor);
}

void placeCamera(vtkRenderer* renderer, const Look& look)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(4.6, -8.0, 3.75); // 22 degrees above
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetParallelScale(look.halfHeight);
  camera->SetClippingRange(1.0, 30.0);
}

Picture grab(vtkRenderWindow* window, int side)
{
  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput(window);
  pixels->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> mean;
  mean->SetInputConnection(pixels->GetOutputPort());
  mean->SetShrinkFactors(Samples, Samples, 1);
  mean->MeanOn();
  mean->Update();
  const auto* bottom = static_cast<const std::uint8_t*>(mean->GetOutput()->GetScalarPointer());
  Picture picture{side, side, {}};
  for (int row = side - 1; row >= 0; --row)
  {
    picture.pixels.insert(picture.pixels.end(), bottom + std::size_t(3) * side * row,
                          bottom + std::size_t(3) * side * (row + 1));
  }
  return picture;
}

} // namespace

Picture pictureOf(vtkPolyData* surface, const Look& look)
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  addSurface(renderer, surface, look);
  addLight(renderer, -0.7, 0.9, 0.85);
  addLight(renderer, 0.9, 0.2, 0.35);
  addLight(renderer, 0.0, -0.8, 0.20);
  addText(renderer, look.above, look, look.side - 14, true);
  addText(renderer, look.below, look, 4, false);
  placeCamera(renderer, look);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Samples * look.side, Samples * look.side);
  window->AddRenderer(renderer);
  window->Render();
  return grab(window, look.side);
}

Picture sideBySide(const std::vector<Picture>& pictures)
{
  Picture result;
  for (const Picture& picture : pictures)
  {
    result.width += picture.width;
    result.height = std::max(result.height, picture.height);
  }
  result.pixels.assign(std::size_t(3) * result.width * result.height, 255);
  int left = 0;
  for (const Picture& picture : pictures)
  {
    for (int row = 0; row < picture.height; ++row)
    {
      std::copy_n(&picture.pixels[std::size_t(3) * picture.width * row], 3 * picture.width,
                  &result.pixels[3 * (std::size_t(result.width) * row + left)]);
    }
    left += picture.width;
  }
  return result;
}

Picture stacked(const std::vector<Picture>& pictures)
{
  Picture result;
  for (const Picture& picture : pictures)
  {
    result.width = std::max(result.width, picture.width);
  }
  for (const Picture& picture : pictures)
  {
    for (int row = 0; row < picture.height; ++row)
    {
      const auto first = picture.pixels.begin() + std::ptrdiff_t(3) * picture.width * row;
      result.pixels.insert(result.pixels.end(), first, first + std::ptrdiff_t(3) * picture.width);
      result.pixels.resize(std::size_t(3) * result.width * (result.height + row + 1), 255);
    }
    result.height += picture.height;
  }
  return result;
}

} // namespace silhouette::experiments
