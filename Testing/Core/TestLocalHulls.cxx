// SPDX-License-Identifier: BSD-3-Clause
#include "LocalHulls.h"

#include "CarvingTestCaptures.h"
#include "LocalHullSurface.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

std::vector<LocalHull> hullsOf(const Mesh& object, std::uint64_t& points, LocalHullOptions options = {})
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(object, swayingRing(16, 300), 300));
  const Octree octree = carveViews(views, unitCube(), 5);
  const auto surface = votingMarchingCubes(octree, views, VotingOptions(), execution);
  points = surface.mesh.points.size();
  return classifyLocalHulls(surface.mesh, octree, &views, options, execution);
}

} // namespace

TEST(LocalHulls, AConvexObjectIsOneHullThatHoldsItsPoints)
{
  std::uint64_t points = 0;
  const auto hulls = hullsOf(boxMesh(-0.7, 0.73), points);
  std::size_t largest = 0;
  for (const auto& hull : hulls)
  {
    largest = std::max(largest, hull.surfacePoints.size());
  }
  EXPECT_GT(double(largest), 0.95 * double(points));
}

TEST(LocalHulls, WhatLiesBeyondTheLatticeMergesWithNothing)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(boxMesh(-0.7, 0.73), swayingRing(16, 300), 300));
  const Octree octree = carveViews(views, unitCube(), 5);
  for (const double size : { 3.0, 1e3, 1e6, 1e9, 1e12 })
  {
    const Mesh far = boxMesh(-size, size); // 12 triangles
    const auto hulls = classifyLocalHulls(far, octree, &views, {}, execution);
    EXPECT_EQ(hulls.size(), 0u) << size << ": triangles that are alone have no volume";
  }
}

TEST(LocalHulls, AConcaveObjectKeepsItsConcavity)
{
  Execution execution;
  std::uint64_t points = 0;
  const auto hulls = hullsOf(torusMesh(64, 32, 0.7, 0.3), points);
  EXPECT_GT(hulls.size(), 4u);
  std::set<std::int32_t> covered;
  double volume = 0.0;
  for (const auto& hull : hulls)
  {
    const MeshSoundness soundness = assessMesh(hull.mesh, execution);
    EXPECT_EQ(soundness.openEdges + soundness.nonManifoldEdges, 0u);
    EXPECT_GT(soundness.volume, 0.0);
    volume = std::max(volume, soundness.volume);
    covered.insert(hull.surfacePoints.begin(), hull.surfacePoints.end());
  }
  const double torus = 2.0 * std::pow(std::acos(-1.0), 2) * 0.7 * 0.09;
  EXPECT_LT(volume, 0.5 * torus) << "no hull spans the hole";
  EXPECT_GT(double(covered.size()), 0.9 * double(points));
}

TEST(LocalHulls, SameHullsForAnyNumberOfThreads)
{
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 160), 160));
  const Octree octree = carveViews(views, unitCube(), 5);
  Execution serial;
  ThreadedExecution threads(8);
  const auto surface = votingMarchingCubes(octree, views, VotingOptions(), serial);
  const auto a = classifyLocalHulls(surface.mesh, octree, &views, {}, serial);
  const auto b = classifyLocalHulls(surface.mesh, octree, &views, {}, threads);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t h = 0; h < a.size(); ++h)
  {
    EXPECT_EQ(a[h].surfacePoints, b[h].surfacePoints);
    EXPECT_EQ(a[h].mesh.triangles, b[h].mesh.triangles);
  }
}

TEST(LocalHulls, ASeedBlockOfNothingIsAnError)
{
  std::uint64_t points = 0;
  LocalHullOptions options;
  options.hulls.seedBlock = 0;
  EXPECT_THROW(hullsOf(boxMesh(-0.7, 0.7), points, options), InvalidInput);
}
