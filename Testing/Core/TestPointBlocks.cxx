// SPDX-License-Identifier: BSD-3-Clause
#include "PointBlocks.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <array>
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
  Execution execution;
  return PointBlocks(std::vector<std::uint64_t>(codes.begin(), codes.end()), execution);
}

} // namespace

TEST(PointBlocks, WordsAreThoseOfTheCodes)
{
  Random random(5);
  const Lattice lattice{ unitCube(), 4 };
  for (const int count : { 0, 1, 40, 2000 })
  {
    const auto one = someCodes(lattice, random, count), other = someCodes(lattice, random, count / 2);
    std::set<std::uint64_t> both = one;
    both.insert(other.begin(), other.end());
    const auto listOf = [](const std::set<std::uint64_t>& codes) { return std::vector<std::uint64_t>(codes.begin(), codes.end()); };
    const std::vector<BlockWord> words = wordsOf(listOf(one)), joined = unitedWords(words, wordsOf(listOf(other)));
    EXPECT_EQ(codesOf(words), listOf(one));
    EXPECT_EQ(codesOf(joined), listOf(both));
    for (std::size_t n = 1; n < joined.size(); ++n)
    {
      EXPECT_LT(joined[n - 1].block, joined[n].block);
    }
    ThreadedExecution execution(3);
    EXPECT_EQ(PointBlocks(words).points(execution), listOf(one));
  }
  EXPECT_EQ(codesOf(unitedWords({ { 2, 1 }, { 2, 6 }, { 3, 1 } }, {})), (std::vector<std::uint64_t>{ 128, 129, 130, 192 }));
}

TEST(PointBlocks, NeighboursAreThoseOfThePointsOneByOne)
{
  Random random(3);
  const std::vector<std::array<int, 3>> cases{ { 1, 1, 1 }, { 1, 10, 2 }, { 3, 1, 1 }, { 3, 10, 8 }, { 3, 200, 2 }, { 4, 200, 1 }, { 6, 20000, 1 },
    { 6, 20000, 2 }, { 6, 20000, 8 } };
  for (const auto& [depth, count, threads] : cases)
  {
    const Lattice lattice{ unitCube(), depth };
    ThreadedExecution execution(threads);
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
    EXPECT_EQ(set.points(execution), std::vector<std::uint64_t>(codes.begin(), codes.end()));
    EXPECT_EQ(set.beside(lattice, execution).points(execution), std::vector<std::uint64_t>(expected.begin(), expected.end()));
    for (int axis = 0; axis < 3; ++axis)
    {
      std::set<std::uint64_t> wider = codes, behind = codes;
      for (const std::uint64_t code : codes)
      {
        for (const int step : { -1, 1 })
        {
          const LatticePoint q = fromMorton(code) + LatticePoint{ step * (axis == 0), step * (axis == 1), step * (axis == 2) };
          if (std::min({ q.i, q.j, q.k }) >= 0)
          {
            wider.insert(mortonCode(q));
            if (step < 0)
            {
              behind.insert(mortonCode(q));
            }
          }
        }
      }
      EXPECT_EQ(set.spread(axis, execution).points(execution), std::vector<std::uint64_t>(wider.begin(), wider.end()));
      EXPECT_EQ(set.spreadBehind(axis, execution).points(execution), std::vector<std::uint64_t>(behind.begin(), behind.end()));
    }
    std::set<std::uint64_t> cells;
    for (const std::uint64_t code : codes)
    {
      for (int n = 0; n < 8; ++n)
      {
        const LatticePoint o = cornerOffset(n), p = fromMorton(code), q{ p.i - o.i, p.j - o.j, p.k - o.k };
        if (std::min({ q.i, q.j, q.k }) >= 0)
        {
          cells.insert(mortonCode(q));
        }
      }
    }
    EXPECT_EQ(cellsAround({ codes.rbegin(), codes.rend() }, execution), std::vector<std::uint64_t>(cells.begin(), cells.end()));
    // Less some others.
    const auto others = someCodes(lattice, random, count);
    for (const std::uint64_t code : others)
    {
      expected.erase(code);
    }
    PointBlocks rest = set.beside(lattice, execution);
    rest.remove(blocksOf(others), execution);
    EXPECT_EQ(rest.points(execution), std::vector<std::uint64_t>(expected.begin(), expected.end()));
    EXPECT_EQ(rest.empty(), expected.empty());
    PointBlocks same = set.beside(lattice, execution);
    GrowingPoints growing;
    growing.add(blocksOf(others).words());
    same.remove(growing, execution);
    EXPECT_EQ(same.points(execution), rest.points(execution));
  }
}

TEST(PointBlocks, OfNoPoints)
{
  Execution execution;
  const Lattice lattice{ unitCube(), 3 };
  PointBlocks none;
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(none.beside(lattice, execution).empty());
  PointBlocks one({ 5 }, execution);
  one.remove(none, execution);
  EXPECT_EQ(one.points(execution), std::vector<std::uint64_t>{ 5 });
  one.remove(one, execution);
  EXPECT_TRUE(one.empty());
}
