// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorBridges.h"

#include "CarvingTestCaptures.h"
#include "LatticeRegions.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Two boxes with a gap between; three affine views along the axes. */
Octree twoBoxes(double gap, PreparedViews& views)
{
  const Mesh mesh = joined(boxMesh({ -0.8, -0.3, -0.3 }, { -0.5 * gap, 0.3, 0.3 }),
    boxMesh({ 0.5 * gap, -0.3, -0.3 }, { 0.8, 0.3, 0.3 }));
  views = prepareViews(viewsOf(mesh, axisCameras(200.0, 500), 500));
  return carveViews(views, unitCube(1.0), 5); // leaves of 1/16
}

} // namespace

TEST(SurvivorBridges, JoinWhatTheGapAllowsAndNoMore)
{
  Execution execution;
  PreparedViews views;
  const Octree octree = twoBoxes(2.9 / 16.0, views);
  const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
  BlockRegions survivors = connectSurvivors(octree, execution);
  ASSERT_EQ(survivors.count(), 2u);
  EXPECT_TRUE(bridgeSurvivors(octree.lattice, shell, survivors, 0, execution).empty());
  EXPECT_TRUE(bridgeSurvivors(octree.lattice, shell, survivors, 1, execution).empty());
  EXPECT_EQ(survivors.count(), 2u);
  const auto bridges = bridgeSurvivors(octree.lattice, shell, survivors, 2, execution);
  EXPECT_EQ(survivors.count(), 1u);
  ASSERT_EQ(bridges.size(), 1u);
  EXPECT_GE(shell.find(bridges[0].front()), 0);
  EXPECT_GE(shell.find(bridges[0].back()), 0);
  for (std::size_t n = 1; n < bridges[0].size(); ++n)
  {
    const LatticePoint p = fromMorton(bridges[0][n]), q = fromMorton(bridges[0][n - 1]);
    const int dx = std::abs(p.i - q.i), dy = std::abs(p.j - q.j), dz = std::abs(p.k - q.k);
    EXPECT_LE(std::max({ dx, dy, dz }), 1);
    EXPECT_LE(dx + dy + dz, 2) << "18-neighbours, which the surface joins";
  }
}
