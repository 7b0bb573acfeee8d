// SPDX-License-Identifier: BSD-3-Clause
#include "SyntheticCapture.h"

#include "ShadedRendering.h"
#include "SyntheticShapes.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <thread>

using namespace silhouette;

namespace
{

constexpr double Pi = 3.14159265358979323846;

/** Cuts every loop in as many parts as there are threads. */
class Threads : public Execution
{
public:
  explicit Threads(int count) : Count(count) {}
  void forRanges(std::size_t count, std::size_t, const Range& work) override
  {
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < std::size_t(this->Count); ++t)
    {
      threads.emplace_back([&, t] { work(count * t / this->Count, count * (t + 1) / this->Count); });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
  }
  int threads() const override { return this->Count; }

private:
  int Count;
};

Mesh coarseShape(SyntheticShape shape)
{
  SyntheticShapeOptions options;
  options.refinement = 0.5;
  return syntheticShape(shape, options);
}

SyntheticCaptureOptions small(int views)
{
  SyntheticCaptureOptions options;
  options.views = views;
  options.width = 160;
  options.height = 120;
  return options;
}

SyntheticCaptureOptions noisy(int views)
{
  SyntheticCaptureOptions options = small(views);
  options.noiseContour = 1.5;
  options.noiseBlobs = 3;
  options.noisePixels = 0.01;
  options.noiseCamera = 1.0;
  options.noiseRotation = 0.2;
  return options;
}

SyntheticCapture capture(const Mesh& mesh, const SyntheticCaptureOptions& options)
{
  Execution execution;
  return synthesizeCapture(mesh, options, execution);
}

void expectSame(const SyntheticCapture& a, const SyntheticCapture& b)
{
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t v = 0; v < a.views.size(); ++v)
  {
    EXPECT_EQ(a.views[v].name, b.views[v].name);
    EXPECT_EQ(a.views[v].projection, b.views[v].projection);
    EXPECT_EQ(a.views[v].mask.pixels, b.views[v].mask.pixels);
    EXPECT_EQ(a.views[v].photograph, b.views[v].photograph);
  }
}

TEST(SyntheticCapture, sphereMasksHaveTheEllipsesAreaAndCentre)
{
  const Mesh sphere = syntheticShape(SyntheticShape::Sphere);
  SyntheticCaptureOptions options = small(12);
  options.width = 500;
  options.height = 400;
  for (const SyntheticView& view : capture(sphere, options).views)
  {
    // The outline's dual conic is the image of the sphere's dual quadric.
    Eigen::Vector4d quadric = Eigen::Vector4d::Constant(sphereRadius * sphereRadius);
    quadric[3] = -1.0;
    const Eigen::Matrix3d dual = view.trueProjection * quadric.asDiagonal() * view.trueProjection.transpose();
    const Eigen::Matrix3d conic = dual.inverse();
    const double minor = conic.topLeftCorner<2, 2>().determinant();
    const double area = Pi * std::abs(conic.determinant()) / std::pow(minor, 1.5);
    const Eigen::Vector2d centre = dual.col(2).head<2>() / dual(2, 2);

    double pixels = 0.0;
    Eigen::Vector2d sum(0, 0);
    for (int row = 0; row < view.mask.height; ++row)
    {
      for (int column = 0; column < view.mask.width; ++column)
      {
        pixels += view.mask.at(column, row);
        sum += view.mask.at(column, row) * Eigen::Vector2d(column, row);
      }
    }
    EXPECT_NEAR(pixels / area, 1.0, 2e-3);
    EXPECT_LT((sum / pixels - centre).norm(), 0.1);
    EXPECT_NEAR(2.0 * std::sqrt(area / Pi), 0.8 * 400, 1.0); // the share of the shorter side that is promised
  }
}

TEST(SyntheticCapture, camerasSeeAnyMeshWhole)
{
  Mesh mesh = coarseShape(SyntheticShape::Jug);
  for (Eigen::Vector3d& p : mesh.points)
  {
    p = 1e-3 * p + Eigen::Vector3d(40.0, -7.0, 300.0);
  }
  for (const int views : {1, 2, 3, 7, 36})
  {
    const std::vector<Projection> cameras = syntheticCameras(mesh, views, 300, 200);
    ASSERT_EQ(int(cameras.size()), views);
    std::set<std::array<long, 3>> centres;
    for (const Projection& camera : cameras)
    {
      EXPECT_GT(camera.leftCols<3>().determinant(), 0.0); // not mirrored
      EXPECT_NEAR(camera.row(2).head<3>().norm(), 1.0, 1e-9);
      EXPECT_LT(camera(1, 2), 0.0); // z is up, v is down
      const Eigen::Vector3d c = -camera.leftCols<3>().inverse() * camera.col(3);
      centres.insert({std::lround(c.x() * 1e6), std::lround(c.y() * 1e6), std::lround(c.z() * 1e6)});
      for (const Eigen::Vector3d& p : mesh.points)
      {
        const Eigen::Vector3d h = camera * p.homogeneous();
        ASSERT_GT(h.z(), 0.0);
        ASSERT_TRUE(h.x() > 0.0 && h.x() < 299.0 * h.z() && h.y() > 0.0 && h.y() < 199.0 * h.z());
      }
    }
    EXPECT_EQ(int(centres.size()), views);
  }
}

TEST(SyntheticCapture, ringsAreAsDocumented)
{
  const std::vector<Projection> cameras = syntheticCameras(coarseShape(SyntheticShape::Sphere), 36, 64, 64);
  int count[3] = {};
  for (const Projection& camera : cameras)
  {
    const Eigen::Vector3d c = -camera.leftCols<3>().inverse() * camera.col(3);
    const double elevation = std::asin(c.normalized().z()) * 180.0 / Pi;
    const double rings[3] = {15.0, 45.0, -20.0};
    for (int r = 0; r < 3; ++r)
    {
      count[r] += std::abs(elevation - rings[r]) < 1e-4 ? 1 : 0;
    }
    EXPECT_NEAR(c.norm(), 4.0 * sphereRadius, 1e-4);
  }
  EXPECT_EQ(count[0], 22);
  EXPECT_EQ(count[1], 9);
  EXPECT_EQ(count[2], 5);
}

TEST(SyntheticCapture, withoutNoiseAllAgrees)
{
  const SyntheticCapture result = capture(coarseShape(SyntheticShape::Jug), small(4));
  EXPECT_EQ(result.width, 160);
  EXPECT_EQ(result.height, 120);
  EXPECT_EQ(result.views[3].name, "view_003.png");
  for (const SyntheticView& view : result.views)
  {
    EXPECT_EQ(view.projection, view.trueProjection);
    EXPECT_EQ(view.mask.pixels, view.cleanMask.pixels);
    for (std::size_t i = 0; i < view.cleanMask.pixels.size(); ++i)
    {
      const std::uint8_t* colour = &view.photograph[3 * i];
      ASSERT_EQ(colour[2] - std::max(colour[0], colour[1]) > 25, view.cleanMask.pixels[i] == 0);
    }
  }
}

TEST(SyntheticCapture, sameSeedSameBytesForAnyNumberOfThreads)
{
  const Mesh mesh = coarseShape(SyntheticShape::Torus);
  const SyntheticCapture one = capture(mesh, noisy(7));
  expectSame(one, capture(mesh, noisy(7)));
  for (const int count : {2, 5})
  {
    Threads threads(count);
    expectSame(one, synthesizeCapture(mesh, noisy(7), threads));
  }
  SyntheticCaptureOptions other = noisy(7);
  other.seed = 1;
  const SyntheticCapture two = capture(mesh, other);
  for (std::size_t v = 0; v < 7; ++v)
  {
    EXPECT_NE(one.views[v].mask.pixels, two.views[v].mask.pixels);
    EXPECT_NE(one.views[v].projection, two.views[v].projection);
    EXPECT_EQ(one.views[v].cleanMask.pixels, two.views[v].cleanMask.pixels);
    EXPECT_EQ(one.views[v].photograph, two.views[v].photograph);
  }
}

TEST(SyntheticCapture, kindsOfNoiseAreIndependent)
{
  const Mesh mesh = coarseShape(SyntheticShape::Torus);
  SyntheticCaptureOptions blobs = small(9);
  blobs.noiseBlobs = 4;
  int cut = 0;
  for (const SyntheticView& view : capture(mesh, blobs).views)
  {
    cut += view.mask.pixels != view.cleanMask.pixels ? 1 : 0;
  }
  EXPECT_EQ(cut, 4);

  SyntheticCaptureOptions cameras = small(9);
  cameras.noiseCamera = 1.0;
  SyntheticCaptureOptions both = cameras;
  both.noiseContour = 2.0;
  const SyntheticCapture first = capture(mesh, cameras);
  const SyntheticCapture second = capture(mesh, both);
  for (std::size_t v = 0; v < 9; ++v)
  {
    EXPECT_EQ(first.views[v].projection, second.views[v].projection);
    EXPECT_EQ(first.views[v].mask.pixels, first.views[v].cleanMask.pixels);
  }
}

TEST(SyntheticCapture, camerasAreOffByTheStatedDeviations)
{
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  SyntheticCaptureOptions options = small(400);
  options.width = options.height = 16;
  options.noiseCamera = 2.0;
  double shifts = 0.0;
  for (const SyntheticView& view : capture(mesh, options).views)
  {
    const Eigen::Vector3d t = view.trueProjection * Eigen::Vector4d(0.1, 0.2, 0.3, 1.0);
    const Eigen::Vector3d n = view.projection * Eigen::Vector4d(0.1, 0.2, 0.3, 1.0);
    EXPECT_NEAR(t.z(), n.z(), 1e-9);
    shifts += (t / t.z() - n / n.z()).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(shifts / 800.0), 2.0, 0.2); // four deviations of an estimate from 800 numbers

  options.noiseCamera = 0.0;
  options.noiseRotation = 0.5;
  double turns = 0.0;
  for (const SyntheticView& view : capture(mesh, options).views)
  {
    const Eigen::Matrix3d change =
        view.projection.leftCols<3>().inverse() * view.trueProjection.leftCols<3>();
    EXPECT_NEAR((change * change.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-9);
    const double degrees = Eigen::AngleAxisd(change).angle() * 180.0 / Pi;
    turns += degrees * degrees;
    const Eigen::Vector3d centre = -view.trueProjection.leftCols<3>().inverse() * view.trueProjection.col(3);
    EXPECT_NEAR((view.projection * centre.homogeneous()).norm(), 0.0, 1e-9); // it turns on the spot
  }
  EXPECT_NEAR(std::sqrt(turns / 1200.0), 0.5, 0.05);
}

TEST(SyntheticCapture, tellsItsProgressAndStops)
{
  class Stopping : public Execution
  {
  public:
    bool cancelled() const override { return this->Last >= 0.5; }
    void progress(double fraction) override
    {
      EXPECT_GE(fraction, this->Last);
      this->Last = fraction;
    }
    double Last = 0.0;
  };
  Stopping stopping;
  EXPECT_THROW(synthesizeCapture(coarseShape(SyntheticShape::Sphere), small(4), stopping), Cancelled);
  EXPECT_EQ(stopping.Last, 0.5);
}

void expectRefused(const Mesh& mesh, const SyntheticCaptureOptions& options, const std::string& text)
{
  try
  {
    capture(mesh, options);
    FAIL() << text;
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(SyntheticCapture, refusesOptionsOutOfRange)
{
  const Mesh mesh = coarseShape(SyntheticShape::Sphere);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Options = SyntheticCaptureOptions;
  const auto refused = [&](const std::function<void(Options&)>& change, const std::string& text)
  {
    Options options = small(3);
    change(options);
    expectRefused(mesh, options, text);
  };
  refused([](Options& o) { o.views = 0; }, "views 0 is outside 1 to 10000");
  refused([](Options& o) { o.width = 0; }, "width 0");
  refused([](Options& o) { o.height = -4; }, "height -4");
  refused([](Options& o) { o.noiseContour = -1.0; }, "noise-contour -1");
  refused([nan](Options& o) { o.noiseContour = nan; }, "noise-contour nan");
  refused([](Options& o) { o.noiseBlobs = 4; }, "noise-blobs 4 is outside 0 to 3");
  refused([](Options& o) { o.noiseBlobs = -1; }, "noise-blobs -1");
  refused([](Options& o) { o.noisePixels = 1.5; }, "noise-pixels 1.5");
  refused([nan](Options& o) { o.noiseCamera = nan; }, "noise-camera nan");
  refused([](Options& o) { o.noiseRotation = -0.1; }, "noise-rotation -0.1");
}

TEST(SyntheticCapture, refusesMeshesWithoutExtent)
{
  expectRefused(Mesh(), small(3), "no triangles");
  Mesh point;
  point.points.assign(3, Eigen::Vector3d(1, 2, 3));
  point.triangles = {{0, 1, 2}};
  expectRefused(point, small(3), "radius");
  point.triangles = {{0, 1, 3}};
  expectRefused(point, small(3), "3");
  point.triangles = {{0, 1, 2}};
  point.points[1].x() = std::numeric_limits<double>::infinity();
  expectRefused(point, small(3), "");
}

TEST(SyntheticCapture, noiseDrawnAnewIsThatOfACaptureMadeAnew)
{
  const Mesh mesh = coarseShape(SyntheticShape::Torus);
  SyntheticCaptureOptions options = noisy(5);
  SyntheticCapture again = capture(mesh, options);
  options.seed = 7;
  options.noiseBlobs = 2;
  Threads threads(3);
  redrawNoise(again, mesh, options, threads);
  expectSame(again, capture(mesh, options));
  redrawNoise(again, mesh, small(5), threads);
  expectSame(again, capture(mesh, small(5)));
  EXPECT_THROW(redrawNoise(again, mesh, small(6), threads), InvalidInput);
}

TEST(SyntheticCapture, withoutPhotographsAllElseIsTheSame)
{
  const Mesh mesh = coarseShape(SyntheticShape::Torus);
  SyntheticCaptureOptions options = noisy(3);
  SyntheticCapture whole = capture(mesh, options);
  options.photographs = false;
  const SyntheticCapture bare = capture(mesh, options);
  for (SyntheticView& view : whole.views)
  {
    EXPECT_FALSE(view.photograph.empty());
    view.photograph.clear();
  }
  expectSame(whole, bare);
}

} // namespace
