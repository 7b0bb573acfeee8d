// SPDX-License-Identifier: BSD-3-Clause
#include "OctantsAround.h"

#include "CarvingTestCaptures.h"
#include "IntersectionAround.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

using Octants = std::set<std::pair<int, std::size_t>>;

struct Scene
{
  Execution execution;
  PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 120), 120));
  Octree octree = carveViews(views, unitCube(), 5, 0);
  CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
};

/** One by one. */
Octants octantsAt(const Octree& octree, const LatticePoint& p, OctantState state)
{
  Octants octants;
  for (int n = 0; n < 8; ++n)
  {
    const LatticePoint o = cornerOffset(n);
    const auto at = octree.locate({ p.i - o.i, p.j - o.j, p.k - o.k });
    if (at.generation >= 0 && at.state == state)
    {
      octants.emplace(at.generation, at.index);
    }
  }
  return octants;
}

} // namespace

TEST(OctantsAround, AreThoseOfTheCellsOneByOne)
{
  Scene scene;
  for (const OctantState state : { OctantState::Inside, OctantState::Background })
  {
    std::size_t met = 0;
    forCorners(scene.octree, scene.shell, scene.execution,
      [&]
      {
        return [&](std::size_t c, CursorsAround& cursors)
        {
          Octants octants;
          const std::uint8_t others = forOctantsAround(cursors, scene.octree, scene.shell.corners[c], 0xff, state,
            [&](const Octree::Location& at) { octants.emplace(at.generation, at.index); });
          EXPECT_EQ(octants, octantsAt(scene.octree, fromMorton(scene.shell.corners[c]), state));
          EXPECT_NE(others, 0) << "a corner of the shell touches an intersection octant";
          met += octants.size();
        };
      });
    EXPECT_GT(met, 100u);
  }
}

/** What the telling cells meet is joined, across faces, to all that the corner touches. */
TEST(OctantsAround, SomeTellOfAll)
{
  Scene scene;
  ASSERT_TRUE(isWhole(scene.octree));
  const auto around = intersectionAround(scene.octree, scene.shell, scene.execution);
  CursorsAround cursors = cursorsAround(scene.octree);
  std::size_t fewer = 0;
  for (std::size_t c = 0; c < scene.shell.corners.size(); ++c)
  {
    for (const OctantState state : { OctantState::Inside, OctantState::Background })
    {
      const LatticePoint p = fromMorton(scene.shell.corners[c]);
      const Octants all = octantsAt(scene.octree, p, state);
      Octants reached;
      const std::uint8_t telling = tellingCells(around[c]);
      EXPECT_EQ(telling & around[c], 0);
      const std::uint8_t others = forOctantsAround(cursors, scene.octree, scene.shell.corners[c], telling, state,
        [&](const Octree::Location& at) { reached.emplace(at.generation, at.index); });
      EXPECT_TRUE(all.empty() || others == 0) << "inside and background octants share no point";
      fewer += reached.size() < all.size();
      // Spread from cell to cell across faces, among the cells around the corner.
      for (std::size_t before = 0; before != reached.size();)
      {
        before = reached.size();
        for (int n = 0; n < 8; ++n)
        {
          for (int step = 1; step < 8; step *= 2)
          {
            const LatticePoint a = cornerOffset(n), b = cornerOffset(n ^ step);
            const auto from = scene.octree.locate({ p.i - a.i, p.j - a.j, p.k - a.k });
            const auto to = scene.octree.locate({ p.i - b.i, p.j - b.j, p.k - b.k });
            if (reached.count({ from.generation, from.index }) && to.generation >= 0 && to.state == state)
            {
              reached.emplace(to.generation, to.index);
            }
          }
        }
      }
      EXPECT_EQ(reached, all);
    }
  }
  EXPECT_GT(fewer, 50u);
}

TEST(OctantsAround, APieceOfAnOctreeIsNotWhole)
{
  Scene scene;
  Octree piece = scene.octree;
  auto& trees = piece.generations[std::size_t(piece.treeGeneration)];
  ASSERT_GT(trees.size(), 0u);
  trees.code.pop_back();
  trees.state.pop_back();
  EXPECT_FALSE(isWhole(piece));
}
