// SPDX-License-Identifier: BSD-3-Clause
#include "ThinSolid.h"

#include "CarvingTestCaptures.h"
#include "ThinHullScene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

const Lattice TheLattice{ { Vector3(-1.0, -2.0, 0.5), 3.0 }, 5 };

Vector3 world(const Vector3& p) { return TheLattice.root.origin + p * TheLattice.leafEdge(); }

/** A hull of two balls, lattice coordinates, as the world has it. */
ThinHull hullOf(const Vector3& a, const Vector3& b, double radius)
{
  ThinHull hull;
  hull.centre[0] = world(a);
  hull.centre[1] = world(b);
  hull.radius[0] = hull.radius[1] = radius * TheLattice.leafEdge();
  return hull;
}

double distanceToSegment(const Vector3& p, const Vector3& a, const Vector3& b)
{
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

} // namespace

TEST(ThinSolid, TheSurfaceLiesOnTheHullOnTheWayToThePointBeyond)
{
  Random random(3);
  const double radius = 0.4;
  int beyond = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    const Vector3 inside(10 + random.below(5), 11 + random.below(5), 12 + random.below(5));
    const Vector3 outside = inside + Vector3::Unit(random.below(3)) * (random.below(2) == 0 ? 1.0 : -1.0);
    const Vector3 a = inside + Vector3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
    const Vector3 b = a + Vector3(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), 0.9);
    const ThinSolid solid({ hullOf(a, b, radius) }, TheLattice, nullptr);
    Vector3 target;
    ASSERT_TRUE(solid.surfaceBetween(inside, outside, target)) << trial;
    EXPECT_LE(distanceToSegment(target, a, b), radius + 1e-6) << trial;
    // Seven halvings; but no further than 0.3 octants behind the point.
    const bool isBeyond = (target - inside - 0.85 * (outside - inside)).norm() > 0.29;
    EXPECT_TRUE(isBeyond || distanceToSegment(target, a, b) >= radius - 0.01) << trial;
    beyond += isBeyond && distanceToSegment(target, a, b) < radius - 0.01;
    EXPECT_TRUE(solid.isBetter(target, inside)); // without silhouettes, always
  }
  EXPECT_LT(beyond, 10);
}

TEST(ThinSolid, NoHullIsNearOrAnotherOneIs)
{
  const Vector3 inside(10, 10, 10), outside(11, 10, 10);
  const ThinHull far = hullOf(Vector3(20, 20, 20), Vector3(21, 20, 20), 0.3), near = hullOf(Vector3(10, 10, 9.6), Vector3(10, 10, 10.4), 0.3);
  Vector3 target, alone;
  EXPECT_FALSE(ThinSolid({ far }, TheLattice, nullptr).surfaceBetween(inside, outside, target));
  EXPECT_FALSE(ThinSolid({}, TheLattice, nullptr).surfaceBetween(inside, outside, target));
  ASSERT_TRUE(ThinSolid({ near }, TheLattice, nullptr).surfaceBetween(inside, outside, alone));
  ASSERT_TRUE(ThinSolid({ far, near }, TheLattice, nullptr).surfaceBetween(inside, outside, target));
  EXPECT_EQ(target, alone);
}
