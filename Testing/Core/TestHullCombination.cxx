// SPDX-License-Identifier: BSD-3-Clause
#include "HullCombination.h"

#include "CarvingTestCaptures.h"
#include "CellSafety.h"
#include "ConvexHull.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

Lattice latticeOf(int depth)
{
  return { { Vector3(-1.0, 2.0, 0.5), 2.6 }, depth };
}

/** A hull of random points within a ball, in lattice coordinates. */
LocalHull randomHull(Random& random, const Lattice& lattice)
{
  const double n = lattice.cells();
  const Vector3 centre(random.uniform(0.3, 0.7) * n, random.uniform(0.3, 0.7) * n, random.uniform(0.3, 0.7) * n);
  std::vector<Vector3> points;
  for (int p = 0; p < 24; ++p)
  {
    const Vector3 direction(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Vector3 g = centre + 0.22 * n * direction;
    points.emplace_back(lattice.coordinate(0, g[0]), lattice.coordinate(1, g[1]), lattice.coordinate(2, g[2]));
  }
  return { *convexHull(points), {} };
}

/** f of the union: negative inside; least over the hulls of the greatest distance beyond a plane. */
double unionAt(const std::vector<LocalHull>& hulls, const Vector3& p)
{
  double least = 1e300;
  for (const auto& hull : hulls)
  {
    double most = -1e300;
    for (const auto& t : hull.mesh.triangles)
    {
      const Vector3 a = hull.mesh.points[t[0]];
      most = std::max(most, (hull.mesh.points[t[1]] - a).cross(hull.mesh.points[t[2]] - a).normalized().dot(p - a));
    }
    least = std::min(least, most);
  }
  return least;
}

Mesh meshOf(const CombinedSurface& combined, const Lattice& lattice)
{
  Execution execution;
  return placePoints(lattice, combined.shell, combined.surface, combined.fractions, false, execution);
}

} // namespace

TEST(HullCombination, TheUnionOfRandomHullsIsThatOfTheirPlanes)
{
  Random random(23);
  Execution execution;
  const Lattice lattice = latticeOf(4);
  for (int run = 0; run < 20; ++run)
  {
    std::vector<LocalHull> hulls;
    for (int h = 0; h < 1 + run % 5; ++h)
    {
      hulls.push_back(randomHull(random, lattice));
    }
    const auto combined = contourRows(combinedRows(hulls, {}, lattice, execution), lattice, execution);
    const MeshSoundness soundness = assessMesh(meshOf(combined, lattice), execution);
    EXPECT_EQ(soundness.openEdges + soundness.nonManifoldEdges + soundness.nonManifoldVertices, 0u);
    // Every edge that the planes say is crossed, and no other, at the place where they say so.
    std::size_t expected = 0;
    for (std::uint64_t code = 0; code < 4096; ++code)
    {
      const LatticePoint p = fromMorton(code);
      for (int axis = 0; axis < 3; ++axis)
      {
        const LatticePoint q = p + LatticePoint{ axis == 0, axis == 1, axis == 2 };
        const bool a = !lattice.onBorder(p) && unionAt(hulls, lattice.position(p)) < 0;
        const bool b = !lattice.onBorder(q) && unionAt(hulls, lattice.position(q)) < 0;
        expected += a != b;
      }
    }
    EXPECT_EQ(combined.surface.edges.size(), expected);
    for (std::size_t e = 0; e < combined.fractions.size(); ++e)
    {
      const double t = combined.fractions[e];
      ASSERT_GE(t, CrossingMargin);
      ASSERT_LE(t, 1.0 - CrossingMargin);
      const Vector3 p = crossingPosition(lattice, combined.shell, combined.surface.edges[e], t);
      if (t > CrossingMargin && t < 1.0 - CrossingMargin)
      {
        EXPECT_NEAR(unionAt(hulls, p), 0.0, 1e-7);
      }
      // Nothing between the inside end and the crossing is outside.
      for (int step = 0; step < 8; ++step)
      {
        const double s = std::max(0.0, t - CrossingMargin) * step / 8.0;
        EXPECT_LE(unionAt(hulls, crossingPosition(lattice, combined.shell, combined.surface.edges[e], s)), 1e-7);
      }
    }
  }
}

TEST(HullCombination, TheVolumeTendsToThatOfTheUnion)
{
  Execution execution;
  double previous = 1.0;
  for (const int depth : { 4, 5, 6 })
  {
    const Lattice lattice = latticeOf(depth);
    // Two boxes that share a corner region: 1 + 1 - 0.125.
    const Vector3 low(-0.61, 2.41, 0.83);
    const std::vector<LocalHull> hulls = { { boxMesh(low, low + Vector3::Ones()), {} },
      { boxMesh(low + Vector3::Constant(0.5), low + Vector3::Constant(1.5)), {} } };
    const Mesh mesh = meshOf(contourRows(combinedRows(hulls, {}, lattice, execution), lattice, execution), lattice);
    const MeshSoundness soundness = assessMesh(mesh, execution);
    EXPECT_TRUE(soundness.sound());
    EXPECT_EQ(soundness.genus.value_or(-1), 0);
    const double error = std::abs(soundness.volume - 1.875);
    EXPECT_LT(error, 0.6 * previous);
    previous = error;
  }
  EXPECT_LT(previous, 0.02);
}

/** Two hulls with a common facet in a lattice plane leave no slit. */
TEST(HullCombination, HullsThatTouchInALatticePlaneAreOne)
{
  Execution execution;
  const Lattice lattice{ { Vector3::Zero(), 32.0 }, 5 };
  for (int axis = 0; axis < 3; ++axis)
  {
    Vector3 high = Vector3::Constant(20.5), low = Vector3::Constant(4.5);
    high[axis] = low[axis] = 12.0;
    const std::vector<LocalHull> hulls = { { boxMesh(Vector3::Constant(4.5), high), {} },
      { boxMesh(low, Vector3::Constant(20.5)), {} } };
    const Mesh mesh = meshOf(contourRows(combinedRows(hulls, {}, lattice, execution), lattice, execution), lattice);
    const MeshSoundness soundness = assessMesh(mesh, execution);
    EXPECT_EQ(soundness.components, 1u);
    EXPECT_EQ(soundness.genus.value_or(-1), 0);
    EXPECT_NEAR(soundness.volume, 4096.0, 40.0) << "only edges are cut off";
  }
}

TEST(HullCombination, WhatASurfaceEnclosesIsPartOfTheUnionAndAloneIsTheSurface)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(9, 120), 120));
  const Octree octree = carveViews(views, unitCube(), 5);
  const auto surface = votingMarchingCubes(octree, views, VotingOptions(), execution);
  const auto crossings = locateCrossings(surface.mesh, octree.lattice, CrossingSides::Located, execution);
  const auto combined = contourRows(combinedRows({}, crossings, octree.lattice, execution), octree.lattice, execution);
  const Mesh mesh = meshOf(combined, octree.lattice);
  ASSERT_EQ(mesh.points.size(), surface.mesh.points.size());
  EXPECT_EQ(mesh.triangles, surface.mesh.triangles);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    EXPECT_LT((mesh.points[p] - surface.mesh.points[p]).norm(), 1e-9);
  }
}

TEST(HullCombination, AHullBeyondTheCubeEndsAtItsBorder)
{
  Execution execution;
  const Lattice lattice{ { Vector3::Zero(), 8.0 }, 3 };
  const std::vector<LocalHull> hulls = { { boxMesh(-3.0, 20.0), {} } };
  const auto combined = contourRows(combinedRows(hulls, {}, lattice, execution), lattice, execution);
  const MeshSoundness soundness = assessMesh(meshOf(combined, lattice), execution);
  EXPECT_TRUE(soundness.sound());
  EXPECT_GT(soundness.volume, 450.0);
  EXPECT_LT(soundness.volume, 512.0);
}

TEST(HullCombination, SameForAnyNumberOfThreadsAndNothingFromNothing)
{
  Random random(5);
  const Lattice lattice = latticeOf(5);
  std::vector<LocalHull> hulls;
  for (int h = 0; h < 9; ++h)
  {
    hulls.push_back(randomHull(random, lattice));
  }
  Execution serial;
  const auto one = contourRows(combinedRows(hulls, {}, lattice, serial), lattice, serial);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = contourRows(combinedRows(hulls, {}, lattice, execution), lattice, execution);
    EXPECT_EQ(one.shell.cells, many.shell.cells);
    EXPECT_EQ(one.fractions, many.fractions);
    EXPECT_EQ(one.surface.triangles, many.surface.triangles);
  }
  EXPECT_TRUE(contourRows({}, lattice, serial).surface.triangles.empty());
  CancelledExecution cancelled;
  EXPECT_THROW(combinedRows(hulls, {}, lattice, cancelled), Cancelled);
  EXPECT_THROW(contourRows({}, lattice, cancelled), Cancelled);
}
