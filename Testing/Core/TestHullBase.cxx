// SPDX-License-Identifier: BSD-3-Clause
#include "HullBase.h"

#include "CarvingTestCaptures.h"
#include "ConvexHull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A field around a surface that is given in a lattice of 32 cells a side; the field's may have a generation more. */
BrickField fieldOf(const std::function<double(const Vector3&)>& surface, int generations = 5)
{
  Execution execution;
  const double finer = double(1 << (generations - 5));
  const auto depth = [&](const Vector3& p) { return finer * surface(p / finer); };
  const Lattice lattice{ { Vector3(-1.0, -2.0, 0.5), 2.0 }, generations };
  std::vector<std::uint64_t> cells;
  for (std::uint64_t cell = 0; cell < std::uint64_t(1) << 3 * generations; ++cell)
  {
    if (std::abs(depth(toVector(fromMorton(cell)))) < 2.0)
    {
      cells.push_back(cell);
    }
  }
  BrickField field(lattice, cells, 3, execution);
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    field.values()[n] = float(depth(toVector(fromMorton(field.code(n)))));
  }
  return field;
}

double ball(const Vector3& p)
{
  return 10.0 - (p - Vector3(16.2, 15.9, 16.1)).norm();
}

/** Small bumps and dents, alike on both sides. */
double roughBall(const Vector3& p)
{
  return ball(p) + 0.15 * std::sin(1.7 * p.x()) * std::sin(1.9 * p.y()) * std::sin(1.6 * p.z());
}

double torus(const Vector3& p)
{
  const Vector3 q = p - Vector3(16.0, 16.0, 16.0);
  return 3.0 - std::hypot(std::hypot(q.x(), q.y()) - 9.0, q.z());
}

/** Root of the mean square difference from the ball's distance, beside its surface. */
double roughness(const BrickField& field)
{
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    const double truth = ball(toVector(fromMorton(field.code(n))));
    if (std::abs(truth) < 0.5)
    {
      sum += (field.values()[n] - truth) * (field.values()[n] - truth);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

} // namespace

TEST(HullBase, SmoothsARoughBallAndStaysWhereItWas)
{
  Execution execution;
  BrickField field = fieldOf(roughBall);
  const double before = roughness(field);
  const HullBase base = applyHullBase(field, field.contourMesh(execution), 0.95, 3.0, execution);
  EXPECT_TRUE(base.applied);
  EXPECT_GT(base.convexity, 0.97);
  EXPECT_LT(base.convexity, 1.0);
  EXPECT_LT(roughness(field), 0.9 * before);
  const double volume = assessMesh(field.contourMesh(execution), execution).volume * std::pow(16.0, 3);
  EXPECT_NEAR(volume, 4.0 / 3.0 * 3.14159265 * 1000.0, 60.0) << "the hull alone would be larger";
}

TEST(HullBase, LeavesTheDistanceFromAConvexSurface)
{
  Execution execution;
  BrickField field = fieldOf(ball);
  EXPECT_TRUE(applyHullBase(field, field.contourMesh(execution), 0.97, 3.0, execution).applied);
  EXPECT_LT(roughness(field), 0.03);
}

TEST(HullBase, LeavesConcaveFieldsAndThoseThatAreNotToHaveIt)
{
  Execution execution;
  BrickField field = fieldOf(torus, 6);
  const std::vector<float> before = field.values();
  const HullBase base = applyHullBase(field, field.contourMesh(execution), 0.97, 3.0, execution);
  EXPECT_FALSE(base.applied);
  const Mesh surface = field.contourMesh(execution);
  const auto hull = convexHull(surface.points);
  ASSERT_TRUE(hull);
  ASSERT_GT(surface.points.size(), 4000u) << "too few for some of them to tell";
  const double share = signedVolume(surface.points, surface.triangles) / signedVolume(hull->points, hull->triangles);
  EXPECT_GE(base.convexity, share) << "some points' hull is smaller";
  EXPECT_LT(base.convexity, share + 0.02);
  EXPECT_GT(base.convexity, 0.5);
  EXPECT_LT(base.convexity, 0.9);
  EXPECT_EQ(field.values(), before);
  BrickField convex = fieldOf(ball);
  const std::vector<float> own = convex.values();
  EXPECT_FALSE(applyHullBase(convex, convex.contourMesh(execution), 1.0, 3.0, execution).applied);
  EXPECT_EQ(convex.values(), own);
  BrickField empty = fieldOf([](const Vector3&) { return -1.0; });
  EXPECT_FALSE(applyHullBase(empty, empty.contourMesh(execution), 0.0, 3.0, execution).applied);
}

TEST(HullBase, SameForAnyNumberOfThreads)
{
  BrickField one = fieldOf(roughBall);
  Execution execution;
  applyHullBase(one, one.contourMesh(execution), 0.9, 3.0, execution);
  for (const int threads : { 2, 8 })
  {
    BrickField many = fieldOf(roughBall);
    ThreadedExecution threaded(threads);
    applyHullBase(many, many.contourMesh(threaded), 0.9, 3.0, threaded);
    EXPECT_EQ(one.values(), many.values());
  }
}
