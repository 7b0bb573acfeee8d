// SPDX-License-Identifier: BSD-3-Clause
#include "CrossingPlacer.h"

#include "CarvingTestCaptures.h"
#include "LabelledSolids.h"
#include "VotingMarchingCubes.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

/** By the surface's crossings, and where these are taken away by the views: both are marching cubes' own. */
TEST(CrossingPlacer, SurfaceAndViewsSayTheSame)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 120), 120));
  const Octree octree = carveViews(views, unitCube(), 5, 0);
  const LatticeLabels labels(octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), views, execution);
  const LatticeSurface contoured = contour(labels.shell(), labels.inside(), execution);
  const Mesh mesh = votingMarchingCubes(octree, views, VotingOptions(), execution).mesh;
  ASSERT_EQ(mesh.points.size(), contoured.edges.size());
  const SurfaceCrossings crossings = locateCrossings(mesh, octree.lattice, CrossingSides::NotLocated, execution);
  const SurfaceCrossings none;
  const std::uint64_t added = labels.shell().corners[contoured.edges[40].inside];
  const auto known = CrossingPlacer(labels, crossings, &views, { added }, 0.125).fractions(labels.shell(), contoured, execution);
  const auto asked = CrossingPlacer(labels, none, &views, { added }, 0.125).fractions(labels.shell(), contoured, execution);
  const auto nobody = CrossingPlacer(labels, none, nullptr, { added }, 0.125).fractions(labels.shell(), contoured, execution);
  std::size_t covering = 0;
  for (std::size_t e = 0; e < known.size(); ++e)
  {
    const bool isAdded = labels.shell().corners[contoured.edges[e].inside] == added;
    covering += isAdded;
    EXPECT_NEAR(known[e], asked[e], 1e-9);
    EXPECT_EQ(nobody[e], isAdded ? 0.125 : 0.5);
    if (isAdded)
    {
      EXPECT_EQ(known[e], 0.125);
    }
    else
    {
      const Vector3 p = crossingPosition(octree.lattice, labels.shell(), contoured.edges[e], known[e]);
      EXPECT_LT((p - mesh.points[e]).norm(), 1e-9);
    }
  }
  EXPECT_GE(covering, 1u);
  EXPECT_LE(covering, 6u);
}

/** A field that is linear along x: its zero, whatever surface and views say. */
TEST(CrossingPlacer, AFieldHasTheSayWhereThereIsOne)
{
  LabelledSolid solid(3, [](const LatticePoint& p) { return std::min(within(p.i, 1.8, 5.3), boxField(p, { 1, 1, 1 }, { 7, 7, 7 })); });
  const auto& shell = solid.labels->shell();
  const LatticeSurface contoured = contour(shell, solid.labels->inside(), solid.execution);
  const SurfaceCrossings none;
  const auto fractions = CrossingPlacer(*solid.labels, none, nullptr, {}, 0.1).fractions(shell, contoured, solid.execution);
  std::size_t low = 0, high = 0;
  for (std::size_t e = 0; e < fractions.size(); ++e)
  {
    const LatticePoint a = fromMorton(shell.corners[contoured.edges[e].inside]), b = fromMorton(shell.corners[contoured.edges[e].outside]);
    if (a.j == 4 && a.k == 4 && b.j == 4 && b.k == 4)
    {
      const double x = a.i + fractions[e] * (b.i - a.i);
      EXPECT_NEAR(x, x < 4 ? 1.8 : 5.3, 1e-6);
      (x < 4 ? low : high) += 1;
    }
  }
  EXPECT_EQ(low, 1u);
  EXPECT_EQ(high, 1u);
}
