// SPDX-License-Identifier: BSD-3-Clause
#include "BlockRegions.h"

#include "CarvingTestCaptures.h"
#include "LatticeRegions.h"
#include "UnionFind.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A carved octree, its blocks and some more, with random members. */
struct Scene
{
  Execution execution;
  Octree octree;
  BlockIndex blocks;
  std::vector<std::uint64_t> members;

  explicit Scene(int seed)
  {
    const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 120), 120));
    this->octree = carveViews(views, unitCube(), 5);
    Random random(seed);
    std::vector<std::uint64_t> codes = subdividedBlocks(this->octree);
    // Of larger octants one block, and not of all: what is left of them is in one piece.
    for (int g = this->octree.treeGeneration; g <= 3; ++g)
    {
      const Generation& generation = this->octree.generations[std::size_t(g)];
      for (std::size_t i = 0; i < generation.size(); ++i)
      {
        if (generation.state[i] != OctantState::Intersection && random.below(3) == 0)
        {
          const std::uint64_t count = std::uint64_t(1) << 3 * (3 - g);
          codes.push_back(generation.code[i] * count + std::uint64_t(random.below(int(count))));
        }
      }
    }
    sortUnique(codes);
    this->blocks = BlockIndex(codes);
    for (std::size_t b = 0; b < codes.size(); ++b)
    {
      const int density = random.below(4);
      std::uint64_t points = density == 3 ? ~std::uint64_t(0) : random.next();
      for (int n = 0; n < density && density < 3; ++n)
      {
        points &= random.next();
      }
      this->members.push_back(points);
    }
  }

  bool isBlock(const LatticePoint& p) const { return this->blocks.find(mortonCode(p) >> 6) >= 0; }
  bool isOfLattice(const LatticePoint& p) const { return this->octree.lattice.hasCell(p); }
  bool isMember(const LatticePoint& p, OctantState state) const
  {
    if (!this->isOfLattice(p))
    {
      return state == OctantState::Background;
    }
    const std::uint64_t code = mortonCode(p);
    const std::ptrdiff_t block = this->blocks.find(code >> 6);
    return block >= 0 ? (this->members[std::size_t(block)] >> (code & 63) & 1) != 0 : this->octree.locate(p).state == state;
  }
};

/** Sets by joining every pair of neighbours; the last number is the world beyond. */
UnionFind joinedOneByOne(const Scene& scene, OctantState state, Steps steps)
{
  const int n = scene.octree.lattice.cells();
  UnionFind sets(std::size_t(n) * n * n + 1);
  for (int at = 0; at < n * n * n; ++at)
  {
    const LatticePoint p = fromMorton(std::uint64_t(at));
    for (int d = 0; d < 27 && scene.isMember(p, state); ++d)
    {
      const LatticePoint q = neighbourOf(p, d), step = neighbourOf({ 0, 0, 0 }, d);
      const int differing = std::abs(step.i) + std::abs(step.j) + std::abs(step.k);
      const bool octants = scene.isOfLattice(q) && !scene.isBlock(p) && !scene.isBlock(q);
      if (differing <= (octants ? 1 : int(steps)) && scene.isMember(q, state))
      {
        sets.unite(std::uint32_t(at), scene.isOfLattice(q) ? std::uint32_t(mortonCode(q)) : std::uint32_t(n * n * n));
      }
    }
  }
  return sets;
}

} // namespace

TEST(BlockRegions, AreThoseOfTheirPointsOneByOne)
{
  for (int seed = 1; seed <= 6; ++seed)
  {
    Scene scene(seed);
    for (const auto& [state, steps] : { std::make_pair(OctantState::Inside, Steps::Faces), std::make_pair(OctantState::Inside, Steps::Edges),
           std::make_pair(OctantState::Inside, Steps::Corners), std::make_pair(OctantState::Background, Steps::Faces) })
    {
      UnionFind expected = joinedOneByOne(scene, state, steps);
      BlockRegions regions(scene.octree, state, steps, scene.blocks, scene.members, 2, scene.execution);
      std::map<std::uint32_t, std::uint32_t> of, back;
      const int n = scene.octree.lattice.cells();
      std::vector<std::uint64_t> all;
      for (int at = 0; at <= n * n * n; ++at)
      {
        const bool isBeyond = at == n * n * n;
        if (!isBeyond)
        {
          all.push_back(std::uint64_t(at));
        }
        const bool isMember = isBeyond ? state == OctantState::Background : scene.isMember(fromMorton(std::uint64_t(at)), state);
        const std::uint32_t number = isBeyond ? regions.beyond() : regions.at(std::uint64_t(at));
        ASSERT_EQ(number != BlockRegions::None, isMember || isBeyond);
        if (isMember)
        {
          const std::uint32_t mine = regions.find(number), truth = expected.find(std::uint32_t(at));
          EXPECT_EQ(of.emplace(truth, mine).first->second, mine) << "apart: " << at;
          EXPECT_EQ(back.emplace(mine, truth).first->second, truth) << "joined: " << at;
        }
      }
      EXPECT_GT(of.size(), 10u) << "little to tell apart";
      EXPECT_EQ(regions.count(), of.size());
      const auto numbers = regions.numbersOf(all, scene.execution);
      for (const std::uint64_t at : all)
      {
        ASSERT_EQ(numbers[at], regions.at(at));
      }
      EXPECT_EQ(regions.find(regions.other(1)), regions.other(1));
      EXPECT_EQ(regions.size(), regions.other(1) + 1u);
      regions.unite(regions.other(0), regions.other(1));
      EXPECT_EQ(regions.find(regions.other(0)), regions.find(regions.other(1)));
    }
  }
}

/** Where roots are smaller than blocks all is in blocks. */
TEST(BlockRegions, OfSmallLatticesAreInBlocks)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(3, 0.6), axisCameras(40.0, 120), 120));
  for (const int depth : { 1, 2, 3, 4 })
  {
    const Octree octree = carveViews(views, unitCube(), depth);
    const auto blocks = subdividedBlocks(octree);
    EXPECT_EQ(blocks.size(), std::size_t(depth < 3 ? 1 : depth == 3 ? 8 : 64)) << depth;
    const std::vector<std::uint64_t> cells(blocks.size(), depth == 1 ? 0xff : ~std::uint64_t(0));
    BlockRegions regions(octree, OctantState::Inside, Steps::Faces, BlockIndex(blocks), cells, 0, execution);
    EXPECT_EQ(regions.count(), 1u) << depth;
    EXPECT_EQ(regions.octant(octree.treeGeneration, 0), BlockRegions::None);
    EXPECT_EQ(connectSurvivors(octree, execution).count(), 1u);
  }
}
