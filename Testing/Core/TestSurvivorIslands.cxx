// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorIslands.h"

#include "CarvingTestCaptures.h"
#include "CornerShell.h"
#include "LatticeRegions.h"
#include "ParameterRange.h"

#include <gtest/gtest.h>

#include <limits>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/**
 * Three cubes on a diagonal, affine views along the axes: their silhouettes are apart in every view, so that
 * nothing but the cubes survives.
 */
Octree threeCubes(PreparedViews& views)
{
  Mesh mesh = boxMesh(Vector3::Constant(-0.9), Vector3::Constant(-0.1)); // 13 octants of 1/16 a side
  mesh = joined(mesh, boxMesh(Vector3::Constant(0.2), Vector3::Constant(0.5)));
  mesh = joined(mesh, boxMesh(Vector3::Constant(0.7), Vector3::Constant(0.8)));
  views = prepareViews(viewsOf(mesh, axisCameras(200.0, 500), 500));
  return carveViews(views, unitCube(1.0), 5);
}

/** Leaf cells within the box [low, high)^3 that survive: what locate() says of each. */
std::uint64_t survivingCells(const Octree& octree, int low, int high)
{
  std::uint64_t count = 0;
  const int n = high - low;
  for (int c = 0; c < n * n * n; ++c)
  {
    count += octree.locate({ low + c % n, low + c / n % n, low + c / n / n }).state != OctantState::Background;
  }
  return count;
}

/** The number of intersection octants, as which childBlock has to count them. */
std::uint32_t countedBlocks(const Generation& generation)
{
  std::uint32_t blocks = 0;
  for (std::size_t i = 0; i < generation.size(); ++i)
  {
    EXPECT_EQ(generation.childBlock[i], blocks);
    blocks += generation.state[i] == OctantState::Intersection;
  }
  return blocks;
}

/** Codes of the last generation's survivors of `octree` that `less` calls background. */
std::vector<std::uint64_t> leavesOnlyIn(const Octree& octree, const Octree& less)
{
  std::vector<std::uint64_t> codes;
  const Generation& last = octree.generations.back();
  for (std::size_t i = 0; i < last.size(); ++i)
  {
    if (last.state[i] != OctantState::Background && less.generations.back().state[i] == OctantState::Background)
    {
      codes.push_back(last.code[i]);
    }
  }
  return codes;
}

} // namespace

TEST(SurvivorIslands, WhatIsSmallerThanTheShareIsGivenUpAndCounted)
{
  Execution execution;
  PreparedViews views;
  const Octree octree = threeCubes(views);
  ASSERT_EQ(countSurvivorComponents(octree, execution), 3u);
  const std::uint64_t large = survivingCells(octree, 0, 16);
  const std::uint64_t middle = survivingCells(octree, 17, 26);
  const std::uint64_t small = survivingCells(octree, 26, 32);
  ASSERT_EQ(survivingCells(octree, 0, 32), large + middle + small);
  ASSERT_GT(octree.count(OctantState::Inside, 4), 0u) << "a coarser octant is to be counted as its eight";
  ASSERT_TRUE(middle > small && small > 0 && large > middle);

  struct Case
  {
    double share;
    std::uint64_t dropped;
  };
  const double least = double(small) / double(large), second = double(middle) / double(large);
  const Case cases[] = { { 0.0, 0 }, { least * 0.999, 0 }, { least * 1.001, small }, { second * 0.999, small },
    { second * 1.001, small + middle }, { 1.0, small + middle } };
  for (const Case& c : cases)
  {
    DroppedSurvivors dropped;
    const Octree kept = dropIslands(octree, c.share, dropped, execution);
    EXPECT_EQ(dropped.octants, c.dropped) << c.share;
    EXPECT_EQ(dropped.leaves, leavesOnlyIn(octree, kept)) << c.share;
    EXPECT_EQ(survivingCells(kept, 0, 32), large + middle + small - c.dropped) << c.share;
    EXPECT_EQ(survivingCells(kept, 0, 16), large);
    EXPECT_EQ(sameOctants(kept, octree), c.dropped == 0);
    EXPECT_EQ(kept.fingerprint, octree.fingerprint);
  }
}

TEST(SurvivorIslands, TheOctreeStaysConsistent)
{
  Execution execution;
  PreparedViews views;
  const Octree octree = threeCubes(views);
  DroppedSurvivors dropped;
  const Octree kept = dropIslands(octree, 0.5, dropped, execution);
  ASSERT_GT(dropped.octants, 0u);
  EXPECT_EQ(countSurvivorComponents(kept, execution), 1u);
  std::uint64_t leaves = 0;
  for (int g = kept.treeGeneration; g <= kept.lattice.depth; ++g)
  {
    const Generation& generation = kept.generations[g];
    EXPECT_EQ(generation.code, octree.generations[g].code);
    const std::uint32_t blocks = countedBlocks(generation);
    if (g < kept.lattice.depth)
    {
      EXPECT_EQ(kept.generations[g + 1].size(), 8u * blocks);
    }
    leaves += kept.count(OctantState::Inside, g) << 3 * (kept.lattice.depth - g);
  }
  leaves += leafCells(kept, OctantState::Intersection).size();
  EXPECT_EQ(leaves, survivingCells(kept, 0, 32));
  DroppedSurvivors again;
  EXPECT_TRUE(sameOctants(dropIslands(kept, 1.0, again, execution), kept));
  EXPECT_EQ(again.octants, 0u);
}

TEST(SurvivorIslands, NoiseLeavesTheLargestAlone)
{
  Execution execution;
  for (int kind = 0; kind <= 4; ++kind)
  {
    Random random(90 + kind);
    auto captured = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 120), 120);
    disturb(captured, kind, random);
    const Octree octree = carveViews(prepareViews(captured), unitCube(), 5, kind == 4 ? 3 : 0);
    DroppedSurvivors dropped;
    const Octree kept = dropIslands(octree, 1.0, dropped, execution);
    EXPECT_EQ(survivingCells(kept, 0, 32) + dropped.octants, survivingCells(octree, 0, 32));
    // Of several equally large ones all stay, and nothing is split.
    const std::uint64_t components = countSurvivorComponents(kept, execution);
    EXPECT_GE(components, 1u);
    EXPECT_EQ(survivingCells(kept, 0, 32) % components, 0u);
    EXPECT_LE(components, countSurvivorComponents(octree, execution));
  }
}

TEST(SurvivorIslands, ComponentsThatAnotherOctreeHasNothingOf)
{
  Execution execution;
  PreparedViews views;
  const Octree octree = threeCubes(views);
  for (const double share : { 0.0, 0.1, 0.5 })
  {
    DroppedSurvivors dropped;
    const Octree kept = dropIslands(octree, share, dropped, execution);
    EXPECT_TRUE(sameOctants(withoutStrangers(octree, kept, execution), kept)) << share;
    EXPECT_TRUE(sameOctants(withoutStrangers(kept, octree, execution), kept)) << share << ": nothing is added";
    // Of each component one leaf is enough.
    std::vector<std::uint64_t> leaves = leafCells(kept, OctantState::Intersection);
    leaves.pop_back();
    DroppedSurvivors most;
    const Octree few = dropLeaves(kept, leaves, most);
    const Octree known = withoutStrangers(octree, few, execution);
    EXPECT_EQ(countSurvivorComponents(known, execution) > 0, true);
    EXPECT_LE(countSurvivorComponents(known, execution), countSurvivorComponents(kept, execution));
    EXPECT_TRUE(sameOctants(withoutStrangers(known, few, execution), known));
  }
}

TEST(SurvivorIslands, NothingToGiveUp)
{
  Execution execution;
  DroppedSurvivors dropped;
  EXPECT_TRUE(dropIslands(Octree(), 0.5, dropped, execution).generations.empty());
  EXPECT_EQ(dropped.octants, 0u);
}

TEST(SurvivorIslands, RefusesSharesOutOfRange)
{
  Execution execution;
  DroppedSurvivors dropped;
  for (const double share : { -0.1, 1.5, std::numeric_limits<double>::quiet_NaN() })
  {
    try
    {
      dropIslands(Octree(), share, dropped, execution);
      FAIL() << share;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find("island share " + numberText(share) + " is outside 0 to 1"),
        std::string::npos)
        << error.what();
    }
  }
}

TEST(SurvivorIslands, DebrisIsWhatTheRepairedOctreeHasAsBackground)
{
  Execution execution;
  PreparedViews views;
  const Octree octree = threeCubes(views);
  DroppedSurvivors islands;
  const Octree repaired = dropIslands(octree, 0.5, islands, execution);
  ASSERT_GT(islands.leaves.size(), 0u);
  std::vector<std::uint64_t> expected; // of intersection octants only
  for (const std::uint64_t leaf : islands.leaves)
  {
    if (octree.locate(fromMorton(leaf)).state == OctantState::Intersection)
    {
      expected.push_back(leaf);
    }
  }
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(debrisLeaves(octree, repaired), expected);
  EXPECT_TRUE(debrisLeaves(repaired, octree).empty());
  EXPECT_TRUE(debrisLeaves(octree, octree).empty());
}

TEST(SurvivorIslands, LeavesAreGivenUpWhereTheySurvive)
{
  Execution execution;
  PreparedViews views;
  const Octree octree = threeCubes(views);
  std::vector<std::uint64_t> some, survived;
  for (std::uint64_t leaf = 0; leaf < 32 * 32 * 32; leaf += 3)
  {
    some.push_back(leaf); // background, coarser ones and survivors
    const Octree::Location at = octree.locate(fromMorton(leaf));
    if (at.generation == octree.lattice.depth && at.state != OctantState::Background)
    {
      survived.push_back(leaf);
    }
  }
  ASSERT_FALSE(survived.empty());
  DroppedSurvivors dropped;
  dropped.octants = 7; // added to
  const Octree kept = dropLeaves(octree, some, dropped);
  EXPECT_EQ(dropped.leaves, survived);
  EXPECT_EQ(dropped.octants, 7 + survived.size());
  EXPECT_EQ(leavesOnlyIn(octree, kept), survived);
  EXPECT_EQ(survivingCells(kept, 0, 32) + survived.size(), survivingCells(octree, 0, 32));
  countedBlocks(kept.generations.back());
  DroppedSurvivors none;
  EXPECT_TRUE(sameOctants(dropLeaves(octree, {}, none), octree));
  EXPECT_TRUE(dropLeaves(Octree(), some, none).generations.empty());
  EXPECT_EQ(none.octants, 0u);
}
