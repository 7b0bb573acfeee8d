// SPDX-License-Identifier: BSD-3-Clause
#include "PointBlocks.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

std::set<std::uint64_t> someCodes(const Lattice& lattice, Random& random, int count)
{
  std::set<std::uint64_t> codes;
  const int points = lattice.cells() + 1;
  for (int n = 0; n < count; ++n)
  {
    codes.insert(mortonCode({ random.below(points), random.below(points), random.below(points) }));
  }
  return codes;
}

PointBlocks blocksOf(const std::set<std::uint64_t>& codes)
{
  return PointBlocks(std::vector<std::uint64_t>(codes.begin(), codes.end()));
}

} // namespace

TEST(PointBlocks, NeighboursAreThoseOfThePointsOneByOne)
{
  Random random(3);
  for (const int depth : { 1, 3, 4 })
  {
    const Lattice lattice{ unitCube(), depth };
    for (const int count : { 1, 10, 200 })
    {
      const auto codes = someCodes(lattice, random, count);
      std::set<std::uint64_t> expected;
      for (const std::uint64_t code : codes)
      {
        for (const int n : EdgeNeighbours)
        {
          const LatticePoint q = neighbourOf(fromMorton(code), n);
          if (isOfLattice(q, lattice.cells()))
          {
            expected.insert(mortonCode(q));
          }
        }
      }
      const PointBlocks set = blocksOf(codes);
      EXPECT_EQ(set.points(), std::vector<std::uint64_t>(codes.begin(), codes.end()));
      EXPECT_EQ(set.beside(lattice).points(), std::vector<std::uint64_t>(expected.begin(), expected.end()));
      for (int axis = 0; axis < 3; ++axis)
      {
        std::set<std::uint64_t> wider = codes;
        for (const std::uint64_t code : codes)
        {
          for (const int step : { -1, 1 })
          {
            const LatticePoint q = fromMorton(code) + LatticePoint{ step * (axis == 0), step * (axis == 1), step * (axis == 2) };
            if (std::min({ q.i, q.j, q.k }) >= 0)
            {
              wider.insert(mortonCode(q));
            }
          }
        }
        EXPECT_EQ(set.spread(axis).points(), std::vector<std::uint64_t>(wider.begin(), wider.end()));
      }
      // Less some others.
      const auto others = someCodes(lattice, random, count);
      for (const std::uint64_t code : others)
      {
        expected.erase(code);
      }
      PointBlocks rest = set.beside(lattice);
      rest.remove(blocksOf(others));
      EXPECT_EQ(rest.points(), std::vector<std::uint64_t>(expected.begin(), expected.end()));
      EXPECT_EQ(rest.empty(), expected.empty());
    }
  }
}

TEST(PointBlocks, OfNoPoints)
{
  const Lattice lattice{ unitCube(), 3 };
  PointBlocks none;
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(none.beside(lattice).empty());
  PointBlocks one({ 5 });
  one.remove(none);
  EXPECT_EQ(one.points(), std::vector<std::uint64_t>{ 5 });
  one.remove(one);
  EXPECT_TRUE(one.empty());
}
