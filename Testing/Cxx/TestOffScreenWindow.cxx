// SPDX-License-Identifier: BSD-3-Clause
/**
 * The window in memory: that it really is OSMesa, that it draws what it should, again and again, in any size.
 */
#include "RegressionImage.h"
#include "SilhouetteOffScreen.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <cmath>

using silhouette::testing::compareImages;
using silhouette::testing::matchesBaseline;
using silhouette::testing::pictureOf;

namespace
{

/** A sphere of radius 0.5 seen without perspective, 1 unit high in half the window, on dark blue. */
struct SphereScene
{
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;

  explicit SphereScene(int width = 200, int height = 200)
  {
    this->addSphere(0.0, 1.0, 1.0, 1.0);
    this->renderer->SetBackground(0.0, 0.0, 0.2);
    this->window->AddRenderer(this->renderer);
    this->window->SetSize(width, height);
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetPosition(0, 0, 10);
    camera->SetFocalPoint(0, 0, 0);
    camera->SetParallelScale(1.0); // half the window's height
    this->renderer->ResetCameraClippingRange();
  }

  vtkActor* addSphere(double z, double red, double green, double blue)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(96);
    sphere->SetPhiResolution(96);
    sphere->SetCenter(0, 0, z);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(red, green, blue);
    this->renderer->AddActor(actor);
    return actor;
  }
};

const unsigned char* pixelAt(vtkImageData* picture, int column, int row)
{
  return static_cast<const unsigned char*>(picture->GetScalarPointer(column, row, 0));
}

/** Pixels that are not background: green is only on the sphere. */
int countForeground(vtkImageData* picture)
{
  const auto* values = static_cast<const unsigned char*>(picture->GetScalarPointer());
  int count = 0;
  for (vtkIdType pixel = 0; pixel < picture->GetNumberOfPoints(); ++pixel)
  {
    count += values[3 * pixel + 1] > 0 ? 1 : 0;
  }
  return count;
}

} // namespace

TEST(OffScreenWindow, IsOSMesa)
{
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr) << "the test is run without a display";
  SphereScene scene;
  scene.window->Render();
  const std::string name = scene.window->GetClassName();
  EXPECT_TRUE(name == "vtkSilhouetteOSMesaRenderWindow" || name == "vtkOSOpenGLRenderWindow") << name;
  const std::string capabilities = scene.window->ReportCapabilities();
  EXPECT_NE(capabilities.find("llvmpipe"), std::string::npos) << capabilities.substr(0, 200);
  EXPECT_NE(capabilities.find("Core Profile"), std::string::npos) << capabilities.substr(0, 200);
  EXPECT_EQ(scene.window->GetMultiSamples(), 0);
}

TEST(OffScreenWindow, DrawsASphere)
{
  SphereScene scene;
  vtkSmartPointer<vtkImageData> picture = pictureOf(scene.window);
  ASSERT_EQ(picture->GetDimensions()[0], 200);
  ASSERT_EQ(picture->GetDimensions()[1], 200);
  const unsigned char* corner = pixelAt(picture, 2, 2);
  EXPECT_EQ(corner[0], 0);
  EXPECT_EQ(corner[1], 0);
  EXPECT_EQ(corner[2], 51); // 0.2 * 255
  EXPECT_GT(pixelAt(picture, 100, 100)[0], 240) << "the middle faces the light";
  EXPECT_LT(pixelAt(picture, 100, 148)[0], 120) << "the rim does not";

  // The disc's area in closed form; the tolerance is half a pixel along its edge.
  const double radius = 50.0;
  EXPECT_NEAR(countForeground(picture), vtkMath::Pi() * radius * radius, 0.5 * 2.0 * vtkMath::Pi() * radius);
}

TEST(OffScreenWindow, MatchesItsBaseline)
{
  SphereScene scene;
  EXPECT_TRUE(matchesBaseline(scene.window, "OffScreenSphere"));
}

TEST(OffScreenWindow, NearerHidesFarther)
{
  SphereScene scene;
  scene.addSphere(2.0, 1.0, 0.0, 0.0); // towards the camera
  scene.renderer->ResetCameraClippingRange();
  vtkSmartPointer<vtkImageData> picture = pictureOf(scene.window);
  EXPECT_EQ(countForeground(picture), 0) << "the white sphere is behind the red one";
  EXPECT_GT(pixelAt(picture, 100, 100)[0], 240);
}

TEST(OffScreenWindow, FollowsItsSize)
{
  SphereScene scene;
  pictureOf(scene.window);
  scene.window->SetSize(320, 240);
  vtkSmartPointer<vtkImageData> larger = pictureOf(scene.window);
  EXPECT_EQ(larger->GetDimensions()[0], 320);
  EXPECT_EQ(larger->GetDimensions()[1], 240);
  EXPECT_NEAR(countForeground(larger), vtkMath::Pi() * 60.0 * 60.0, vtkMath::Pi() * 60.0);

  SphereScene fresh(320, 240);
  EXPECT_EQ(compareImages(larger, pictureOf(fresh.window), {0}).differing, 0);
}

TEST(OffScreenWindow, RepeatsItselfBitForBit)
{
  SphereScene scene;
  SphereScene other;
  vtkSmartPointer<vtkImageData> first = pictureOf(scene.window);
  vtkSmartPointer<vtkImageData> otherFirst = pictureOf(other.window);
  vtkSmartPointer<vtkImageData> second = pictureOf(scene.window);
  EXPECT_EQ(compareImages(first, second, {0}).differing, 0);
  EXPECT_EQ(compareImages(first, otherFirst, {0}).differing, 0) << "two windows at once";
}

TEST(OffScreenWindow, RendersAgainAfterFinalize)
{
  SphereScene scene;
  vtkSmartPointer<vtkImageData> before = pictureOf(scene.window);
  scene.window->Finalize();
  vtkSmartPointer<vtkImageData> after = pictureOf(scene.window);
  EXPECT_EQ(compareImages(before, after, {0}).differing, 0);
}

TEST(OffScreenWindow, FrontAndBackBufferShowTheSame)
{
  SphereScene scene;
  vtkSmartPointer<vtkImageData> back = pictureOf(scene.window);
  vtkNew<vtkWindowToImageFilter> grab; // as ordinary scripts use it: the front buffer
  grab->SetInput(scene.window);
  grab->Update();
  EXPECT_EQ(compareImages(back, grab->GetOutput(), {0}).differing, 0);
}

#if defined(SILHOUETTE_OFFSCREEN_MODULE)
TEST(OffScreenWindow, FactoryIsSwitchedOffAndOn)
{
  EXPECT_TRUE(vtkSilhouetteOffScreenFactory::IsOffScreenEnabled());
  vtkSilhouetteOffScreenFactory::DisableOffScreen();
  EXPECT_FALSE(vtkSilhouetteOffScreenFactory::IsOffScreenEnabled());
  {
    vtkNew<vtkRenderWindow> usual;
    EXPECT_STRNE(usual->GetClassName(), "vtkSilhouetteOSMesaRenderWindow");
  }
  vtkSilhouetteOffScreenFactory::EnableOffScreen();
  vtkSilhouetteOffScreenFactory::EnableOffScreen(); // once more changes nothing
  vtkNew<vtkRenderWindow> window;
  EXPECT_STREQ(window->GetClassName(), "vtkSilhouetteOSMesaRenderWindow");
}
#endif
