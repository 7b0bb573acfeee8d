// SPDX-License-Identifier: BSD-3-Clause
#include "IntersectionAround.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

/** In a shell that holds cells beside the intersection octants too. */
TEST(IntersectionAround, IsWhatTheOctreeSaysOfEachCell)
{
  Execution execution;
  const auto views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 120), 120));
  const Octree octree = carveViews(views, unitCube(), 5, 0);
  std::vector<std::uint64_t> cells = leafCells(octree, OctantState::Intersection);
  cells.push_back(mortonCode({ 0, 0, 0 }));
  cells.push_back(mortonCode({ 31, 31, 31 }));
  cells.push_back(mortonCode({ 16, 16, 16 }));
  sortUnique(cells);
  const CornerShell shell = makeCornerShell(cells, execution);
  const auto around = intersectionAround(octree, shell, execution);
  ASSERT_EQ(around.size(), shell.corners.size());
  std::size_t surrounded = 0, bare = 0;
  for (std::size_t c = 0; c < around.size(); ++c)
  {
    const LatticePoint p = fromMorton(shell.corners[c]);
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint o = cornerOffset(n), cell{ p.i - o.i, p.j - o.j, p.k - o.k };
      const auto location = octree.locate(cell);
      const bool expected = std::min({ cell.i, cell.j, cell.k }) >= 0 && std::max({ cell.i, cell.j, cell.k }) < 32 &&
        location.generation == 5 && location.state == OctantState::Intersection;
      ASSERT_EQ((around[c] >> n & 1) != 0, expected) << c << " " << n;
    }
    surrounded += around[c] == 0xff;
    bare += around[c] == 0;
  }
  EXPECT_GT(surrounded, 20u);
  EXPECT_GT(bare, 10u);
}
