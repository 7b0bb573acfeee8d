// SPDX-License-Identifier: BSD-3-Clause
/**
 * The comparison of pictures itself: broken pictures must fail it, and what rasterisers differ in must not.
 */
#include "RegressionImage.h"

#include "vtkActor.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <functional>
#include <random>

using silhouette::testing::compareImages;
using silhouette::testing::ImageComparison;
using silhouette::testing::ImageTolerance;
using silhouette::testing::matchesBaseline;
using silhouette::testing::pictureOf;

namespace
{

void setResolution(vtkSphereSource* source)
{
  source->SetThetaResolution(48);
  source->SetPhiResolution(48);
  source->Update();
}

/** A sphere that fills most of a window of 200 x 200 pixels; `without` is a cell to leave out, -1 none. */
vtkSmartPointer<vtkImageData> renderSphere(vtkIdType without = -1)
{
  vtkNew<vtkSphereSource> source;
  setResolution(source);
  vtkNew<vtkPolyData> sphere;
  sphere->DeepCopy(source->GetOutput());
  if (without >= 0)
  {
    sphere->BuildLinks();
    sphere->DeleteCell(without);
    sphere->RemoveDeletedCells();
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(sphere);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->BackfaceCullingOn(); // a hole shows the background, not the far side
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  window->SetSize(200, 200);
  renderer->ResetCamera();
  return pictureOf(window);
}

vtkSmartPointer<vtkImageData> copyOf(vtkImageData* picture)
{
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->DeepCopy(picture);
  return copy;
}

void invert(vtkImageData* picture, int column, int row)
{
  auto* pixel = static_cast<unsigned char*>(picture->GetScalarPointer(column, row, 0));
  std::transform(pixel, pixel + 3, pixel, [](unsigned char value) { return 255 - value; });
}

/** The comparison of a picture with a copy that `damage` has changed. */
ImageComparison compareDamaged(const std::function<void(vtkImageData*)>& damage)
{
  vtkSmartPointer<vtkImageData> picture = renderSphere();
  vtkSmartPointer<vtkImageData> damaged = copyOf(picture);
  damage(damaged);
  return compareImages(picture, damaged);
}

const ImageTolerance Default;

} // namespace

TEST(RegressionImage, TheSamePictureMatches)
{
  const ImageComparison comparison = compareDamaged([](vtkImageData*) {});
  EXPECT_EQ(comparison.pixels, 200 * 200);
  EXPECT_EQ(comparison.differing, 0);
  EXPECT_EQ(comparison.mean, 0.0);
  EXPECT_TRUE(comparison.matches(Default));
}

TEST(RegressionImage, AHoleOfThreeByThreePixelsFails)
{
  const ImageComparison comparison = compareDamaged(
      [](vtkImageData* picture)
      {
        for (int pixel = 0; pixel < 9; ++pixel)
        {
          std::fill_n(
              static_cast<unsigned char*>(picture->GetScalarPointer(100 + pixel % 3, 90 + pixel / 3, 0)), 3,
              0);
        }
      });
  EXPECT_EQ(comparison.differing, 9);
  EXPECT_EQ(comparison.clumps, 4);
  EXPECT_FALSE(comparison.matches(Default));
  EXPECT_NE(comparison.describe(Default).find("4 clumps"), std::string::npos);
}

TEST(RegressionImage, ScatteredPixelsFail)
{
  const ImageComparison comparison = compareDamaged(
      [](vtkImageData* picture)
      {
        std::mt19937 random(1);
        for (int pixel = 0; pixel < 413; ++pixel)
        {
          invert(picture, int(random() % 200), int(random() % 200));
        }
      });
  EXPECT_GT(comparison.differing, 300);
  EXPECT_FALSE(comparison.matches(Default));
}

TEST(RegressionImage, AMissingCellFails)
{
  // Cells that face the camera: between the rim and the pole, where cells are slivers narrower than a pixel.
  vtkNew<vtkSphereSource> source;
  setResolution(source);
  vtkPolyData* sphere = source->GetOutput();
  vtkSmartPointer<vtkImageData> whole = renderSphere();
  int tried = 0;
  for (vtkIdType cell = 0; cell < sphere->GetNumberOfCells() && tried < 10; cell += 53)
  {
    double bounds[6];
    sphere->GetCellBounds(cell, bounds);
    if (bounds[4] > 0.25 && bounds[5] < 0.42)
    {
      ++tried;
      EXPECT_FALSE(compareImages(whole, renderSphere(cell)).matches(Default)) << "cell " << cell;
    }
  }
  EXPECT_EQ(tried, 10);
}

TEST(RegressionImage, AChangeOfLightFails)
{
  // Each channel by less than what makes a pixel differ, but everywhere on the sphere.
  const ImageComparison comparison = compareDamaged(
      [](vtkImageData* picture)
      {
        auto* values = static_cast<unsigned char*>(picture->GetScalarPointer());
        std::transform(values, values + 3 * picture->GetNumberOfPoints(), values,
                       [](unsigned char value) { return value > 20 ? value - 10 : value; });
      });
  EXPECT_EQ(comparison.differing, 0);
  EXPECT_GT(comparison.mean, 2.0);
  EXPECT_FALSE(comparison.matches(Default));
}

TEST(RegressionImage, ADifferentSizeFails)
{
  vtkSmartPointer<vtkImageData> picture = renderSphere();
  vtkNew<vtkImageData> other;
  other->SetDimensions(100, 200, 1);
  other->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  EXPECT_FALSE(compareImages(picture, other).matches(Default));
}

TEST(RegressionImage, AFewEdgePixelsAndShadesMatch)
{
  const ImageComparison comparison = compareDamaged(
      [](vtkImageData* picture)
      {
        auto* values = static_cast<unsigned char*>(picture->GetScalarPointer());
        for (vtkIdType value = 0; value < 3 * picture->GetNumberOfPoints(); value += 7)
        {
          values[value] = values[value] < 255 ? values[value] + 1 : 254;
        }
        for (const int column : {90, 92, 97, 100, 109})
        {
          invert(picture, column, 30);
        }
      });
  EXPECT_EQ(comparison.differing, 5);
  EXPECT_TRUE(comparison.matches(Default)) << comparison.describe(Default);
}

TEST(RegressionImage, AMissingBaselineFails)
{
  const char* write = std::getenv("SILHOUETTE_WRITE_BASELINES");
  if (write && std::string(write) == "1")
  {
    GTEST_SKIP() << "baselines are being written";
  }
  const auto result = matchesBaseline(renderSphere().Get(), "NoSuchBaseline");
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("SILHOUETTE_WRITE_BASELINES"), std::string::npos);
}

TEST(RegressionImage, ABrokenPictureFailsItsBaseline)
{
  // The baseline is written for the whole sphere alone, so that writing baselines cannot bless the broken
  // one.
  const char* write = std::getenv("SILHOUETTE_WRITE_BASELINES");
  EXPECT_TRUE(matchesBaseline(renderSphere().Get(), "RegressionImageSphere"));
  if (write && std::string(write) == "1")
  {
    GTEST_SKIP() << "baselines are being written";
  }
  vtkSmartPointer<vtkImageData> broken = renderSphere();
  for (int pixel = 0; pixel < 9; ++pixel)
  {
    invert(broken, 100 + pixel % 3, 90 + pixel / 3);
  }
  const auto result = matchesBaseline(broken.Get(), "RegressionImageSphere");
  EXPECT_FALSE(result);
  const std::string difference =
      std::string(SILHOUETTE_TEMPORARY_DIR) + "/RegressionImageSphere.difference.png";
  EXPECT_TRUE(vtksys::SystemTools::FileExists(difference, true));
}
