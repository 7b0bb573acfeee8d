// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexHull.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

TEST(ConvexHull, OfACubeWithPointsInsideAndInItsFacesIsTheCube)
{
  Execution execution;
  std::vector<Eigen::Vector3d> points = boxMesh(-1.0, 1.0).points;
  points.emplace_back(0, 0, 0);
  points.emplace_back(1, 0, 0);
  points.emplace_back(0.2, -0.3, -1);
  const auto hull = convexHull(points);
  ASSERT_TRUE(hull.has_value());
  const MeshSoundness soundness = assessMesh(*hull, execution);
  EXPECT_EQ(soundness.openEdges, 0u);
  EXPECT_EQ(soundness.nonManifoldEdges + soundness.inconsistentEdges, 0u);
  EXPECT_NEAR(soundness.volume, 8.0, 1e-12);
}

TEST(ConvexHull, HoldsEveryPointAndIsOrientedOutwards)
{
  Random random(6);
  Execution execution;
  for (int trial = 0; trial < 50; ++trial)
  {
    std::vector<Eigen::Vector3d> points;
    for (int n = 0; n < 4 + random.below(200); ++n)
    {
      points.emplace_back(random.uniform(), random.uniform(-5, 5), random.uniform(10, 11));
    }
    const auto hull = convexHull(points);
    ASSERT_TRUE(hull.has_value());
    EXPECT_TRUE(assessMesh(*hull, execution).sound());
    for (const auto& t : hull->triangles)
    {
      const auto& a = hull->points[t[0]];
      const Eigen::Vector3d normal = (hull->points[t[1]] - a).cross(hull->points[t[2]] - a).normalized();
      for (const auto& p : points)
      {
        EXPECT_LE(normal.dot(p - a), 1e-9);
      }
    }
  }
}

TEST(ConvexHull, FlatPointsHaveNone)
{
  EXPECT_FALSE(convexHull({}).has_value());
  EXPECT_FALSE(convexHull({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }).has_value());
  EXPECT_FALSE(convexHull({ { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 0.3, 0.2, 1 } }).has_value());
  EXPECT_FALSE(convexHull(std::vector<Eigen::Vector3d>(9, Eigen::Vector3d(1, 2, 3))).has_value());
}
