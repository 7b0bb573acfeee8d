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

} // namespace

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
