// SPDX-License-Identifier: BSD-3-Clause
#include "ProjectiveCameras.h"

#include "CaptureFolder.h"
#include "CaptureTesting.h"

#include <Eigen/Geometry>

using namespace silhouette;

namespace
{

Eigen::Matrix3d intrinsics(double fx, double fy, double skew)
{
  Eigen::Matrix3d k;
  k << fx, skew, 320, 0, fy, 240, 0, 0, 1;
  return k;
}

/** Cameras on a ring, that look at the origin from distance 5. */
std::vector<Projection> ring(int count, const Eigen::Matrix3d& k)
{
  std::vector<Projection> projections;
  for (int i = 0; i < count; ++i)
  {
    const Eigen::AngleAxisd turn(0.5 + i * 2.0 * EIGEN_PI / count, Vector3(0.1, 1.0, 0.2).normalized());
    Projection pose;
    pose.leftCols<3>() = turn.toRotationMatrix();
    pose.col(3) = Vector3(0.0, 0.0, 5.0);
    projections.push_back(k * pose);
  }
  return projections;
}

std::vector<Projection> mirrored(std::vector<Projection> projections)
{
  for (Projection& p : projections)
  {
    p.col(0) *= -1.0;
  }
  return projections;
}

const std::vector<Vector2> Centres(8, Vector2(320, 240));

} // namespace

TEST(ProjectiveCameras, NegativeDepthIsTurned)
{
  const std::vector<Projection> clean = ring(8, intrinsics(800, 800, 0));
  std::vector<Projection> projections = clean;
  projections[0] *= -1.0;
  projections[3] *= -20.0;
  projections[5] *= 0.1;
  EXPECT_EQ(orientProjections(projections, Centres), 2);
  EXPECT_EQ(projections[0], clean[0]);
  EXPECT_EQ(projections[3], 20.0 * clean[3]);
  EXPECT_EQ(projections[5], 0.1 * clean[5]);
  EXPECT_EQ(orientProjections(projections, Centres), 0);
}

TEST(ProjectiveCameras, MirroredCapturesAreTurnedByDepthNotByDeterminant)
{
  std::vector<Projection> projections = mirrored(ring(8, intrinsics(800, 800, 0)));
  const std::vector<Projection> before = projections;
  EXPECT_EQ(orientProjections(projections, Centres), 0);
  EXPECT_EQ(projections, before);
}

TEST(ProjectiveCameras, OneViewAndNone)
{
  std::vector<Projection> one = ring(1, intrinsics(800, 800, 0));
  const Projection clean = one[0];
  one[0] *= -1.0;
  EXPECT_EQ(orientProjections(one, {Vector2(320, 240)}), 1);
  EXPECT_EQ(one[0], clean);
  std::vector<Projection> none;
  EXPECT_EQ(orientProjections(none, {}), 0);
  EXPECT_EQ(errorOf([&] { orientProjections(one, Centres); }),
            "orienting the projections: 1 projections, but 8 pixels");
}

TEST(ProjectiveCameras, InnerCameraComesBack)
{
  for (const Projection& p : ring(5, intrinsics(800, 700, -13)))
  {
    const InnerCamera camera = innerCamera(-3.0 * p);
    EXPECT_NEAR(camera.fx, 800, 1e-9);
    EXPECT_NEAR(camera.fy, 700, 1e-9);
    EXPECT_NEAR(camera.cx, 320, 1e-9);
    EXPECT_NEAR(camera.cy, 240, 1e-9);
    EXPECT_LT(camera.determinant, 0.0);
    EXPECT_NEAR(std::abs(camera.skew), 13, 1e-9);
    EXPECT_NEAR(innerCamera(p).skew, -13, 1e-9);
    EXPECT_GT(innerCamera(p).determinant, 0.0);
  }
}

TEST(ProjectiveCameras, Warnings)
{
  const std::vector<Projection> clean = ring(3, intrinsics(800, 800, 5));
  EXPECT_EQ(projectiveWarning(clean), "");
  EXPECT_EQ(projectiveWarning({}), "");
  EXPECT_EQ(projectiveWarning(mirrored(clean)), "3 of 3 projections are mirrored (negative determinant); the "
                                                "first is view 0. If the matrices are right, the mesh fits the photographs, "
                                                "but its handedness differs from the object's");
  std::vector<Projection> one = clean;
  one[1] = ring(3, intrinsics(1200, 800, 0))[1];
  EXPECT_EQ(projectiveWarning(one, {"a.png", "b.png", "c.png"}),
            "1 of 3 projections are not metric (fx : fy = 1.5, skew : fx = 0); the first is view 'b.png'. "
            "Where others are as they should be, such a matrix is probably wrong");
  EXPECT_TRUE(holds(projectiveWarning(ring(3, intrinsics(800, 800, 200))), "skew : fx = 0.25"));
  EXPECT_TRUE(
      holds(projectiveWarning(mirrored(ring(3, intrinsics(1200, 800, 0)))), "and 3 of 3 projections"));
}

TEST(ProjectiveCameras, CamerasAtInfinityAreNotJudged)
{
  Projection affine;
  affine << 1, 0, 0, 5, 0, -3, 0, 5, 0, 0, 0, 1;
  EXPECT_EQ(innerCamera(affine).determinant, 0.0);
  EXPECT_EQ(projectiveWarning({affine, affine}), "");
}

TEST(ProjectiveCameras, RealTurntableIsInFrontAndMirrored)
{
  const auto folder = realCapture("vgg-dinosaur");
  SKIP_WITHOUT(folder);
  std::vector<Projection> projections;
  for (const CaptureEntry& entry : describeCapture(folder).entries)
  {
    projections.push_back(entry.projection);
  }
  ASSERT_EQ(projections.size(), 36u);
  const std::vector<Vector2> centres(36, Vector2(359.5, 287.5));
  EXPECT_EQ(orientProjections(projections, centres), 0);
  const Eigen::Vector4d middle(-0.0015, -0.0271, -0.6317, 1.0);
  for (const Projection& p : projections)
  {
    EXPECT_GT(p.row(2).dot(middle), 0.0);
  }
  const std::string warning = projectiveWarning(projections);
  EXPECT_TRUE(holds(warning, "36 of 36 projections are mirrored"));
  EXPECT_TRUE(holds(warning, "36 of 36 projections are not metric (fx : fy = 1.4"));
}

TEST(ProjectiveCameras, RealRingIsMetric)
{
  const auto folder = realCapture("middlebury-dino-sparse-ring");
  SKIP_WITHOUT(folder);
  std::vector<Projection> projections;
  for (const CaptureEntry& entry : describeCapture(folder).entries)
  {
    projections.push_back(entry.projection);
  }
  EXPECT_EQ(projectiveWarning(projections), "");
  const InnerCamera camera = innerCamera(projections.at(0));
  EXPECT_NEAR(camera.fx, 3310.4, 0.01);
  EXPECT_NEAR(camera.cy, 200.55, 0.01);
}
