// SPDX-License-Identifier: BSD-3-Clause
#include "Octree.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

TEST(Octree, LocatesEveryCellInTheLeafThatHoldsIt)
{
  const PreparedViews prepared = prepareViews(viewsOf(sphereMesh(3, 0.9), swayingRing(8, 96), 96));
  const Octree octree = carveViews(prepared, unitCube(), 5);
  std::uint64_t cells[3] = { 0, 0, 0 }, expected[3] = { 0, 0, 0 };
  for (int c = 0; c < 32 * 32 * 32; ++c)
  {
    const LatticePoint cell{ c % 32, c / 32 % 32, c / 32 / 32 };
    const auto location = octree.locate(cell);
    const auto& generation = octree.generations[location.generation];
    EXPECT_EQ(generation.code[location.index], mortonCode(cell) >> 3 * (5 - location.generation));
    EXPECT_EQ(generation.state[location.index], location.state);
    EXPECT_TRUE(location.generation == 5 || location.state != OctantState::Intersection);
    ++cells[int(location.state)];
  }
  for (int g = octree.treeGeneration; g <= 5; ++g)
  {
    for (const auto state : { OctantState::Background, OctantState::Intersection, OctantState::Inside })
    {
      const bool leaf = g == 5 || state != OctantState::Intersection;
      expected[int(state)] += leaf ? octree.count(state, g) << 3 * (5 - g) : 0;
    }
  }
  EXPECT_EQ(cells[0], expected[0]);
  EXPECT_EQ(cells[1], expected[1]);
  EXPECT_EQ(cells[2], expected[2]);
  EXPECT_EQ(octree.locate({ -1, 0, 0 }).generation, -1);
  EXPECT_EQ(octree.locate({ 0, 32, 0 }).generation, -1);
}

TEST(Octree, ACursorFindsWhatALookFromTheRootsFinds)
{
  const PreparedViews prepared = prepareViews(viewsOf(sphereMesh(3, 0.9), swayingRing(8, 96), 96));
  const Octree whole = carveViews(prepared, unitCube(), 5);
  Octree some = whole; // only some of the trees
  Generation& roots = some.generations[some.treeGeneration];
  Generation kept;
  for (std::size_t tree = 0; tree < roots.size(); tree += 2)
  {
    kept.code.push_back(roots.code[tree]);
    kept.state.push_back(roots.state[tree]);
    kept.childBlock.push_back(roots.childBlock[tree]);
  }
  roots = kept;
  Random random(9);
  for (const Octree* octree : { &whole, const_cast<const Octree*>(&some) })
  {
    OctantCursor cursor(*octree);
    LatticePoint cell{ 16, 16, 16 };
    int nowhere = 0, deep = 0;
    for (int n = 0; n < 20000; ++n)
    {
      const int far = n % 50 == 0 ? 20 : 1; // a walk, and now and then a leap
      cell = { cell.i + random.below(2 * far + 1) - far, cell.j + random.below(2 * far + 1) - far,
        cell.k + random.below(2 * far + 1) - far };
      if (n % 100 == 99)
      {
        cell = { random.below(32), random.below(32), random.below(32) };
      }
      const auto expected = octree->locate(cell), found = cursor.locate(cell);
      ASSERT_EQ(found.generation, expected.generation) << n;
      ASSERT_EQ(found.index, expected.index) << n;
      ASSERT_EQ(found.state, expected.state) << n;
      nowhere += found.generation < 0;
      deep += found.generation == 5;
    }
    EXPECT_GT(nowhere, 100);
    EXPECT_GT(deep, 300);
  }
}

TEST(Octree, MortonCodesSortByOctant)
{
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const LatticePoint p{ random.below(1 << 17), random.below(1 << 17), random.below(1 << 17) };
    EXPECT_TRUE(fromMorton(mortonCode(p)) == p);
    EXPECT_EQ(mortonCode({ p.i >> 1, p.j >> 1, p.k >> 1 }), mortonCode(p) >> 3);
  }
}
