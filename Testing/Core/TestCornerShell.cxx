// SPDX-License-Identifier: BSD-3-Clause
#include "CornerShell.h"

#include "CarvingTestCaptures.h"
#include "CodeCursor.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

TEST(CornerShell, SharesTheCornersOfItsCells)
{
  Random random(4);
  std::set<std::uint64_t> cells, corners;
  for (int n = 0; n < 9000; ++n)
  {
    const LatticePoint p{ random.below(40), random.below(40), random.below(40) };
    cells.insert(mortonCode(p));
    for (int c = 0; c < 8; ++c)
    {
      corners.insert(mortonCode(p + cornerOffset(c)));
    }
  }
  ThreadedExecution execution(3);
  const CornerShell shell = makeCornerShell({ cells.begin(), cells.end() }, execution);
  EXPECT_TRUE(std::equal(corners.begin(), corners.end(), shell.corners.begin(), shell.corners.end()));
  for (std::size_t cell = 0; cell < shell.cells.size(); ++cell)
  {
    for (int c = 0; c < 8; ++c)
    {
      EXPECT_EQ(shell.corners[shell.cellCorners[cell][c]], mortonCode(fromMorton(shell.cells[cell]) + cornerOffset(c)));
    }
  }
  for (std::size_t cell = 0; cell < shell.cells.size(); ++cell)
  {
    EXPECT_EQ(shell.findCell(fromMorton(shell.cells[cell])), std::ptrdiff_t(cell));
  }
  EXPECT_EQ(shell.findCell({ -1, 3, 3 }), -1);
  EXPECT_EQ(shell.findCell({ 41, 3, 3 }), -1);
  for (std::size_t c = 0; c < shell.corners.size(); ++c)
  {
    EXPECT_EQ(shell.find(shell.corners[c]), std::ptrdiff_t(c));
  }
  EXPECT_EQ(shell.find(mortonCode({ 100, 100, 100 })), -1);
  CodeCursor cursor(shell.corners);
  for (int n = 0; n < 20000; ++n)
  {
    const LatticePoint p{ random.below(44), random.below(44), random.below(44) };
    for (int around = 0; around < 27; around += 1 + random.below(5))
    {
      const LatticePoint q = neighbourOf({ p.i + 1, p.j + 1, p.k + 1 }, around);
      ASSERT_EQ(cursor.find(mortonCode(q)), shell.find(mortonCode(q)));
    }
  }
}

TEST(CornerShell, OfNoCellsAndOfTheFurthestOnes)
{
  Execution execution;
  const CornerShell none = makeCornerShell({}, execution);
  EXPECT_TRUE(none.cells.empty() && none.corners.empty() && none.cellCorners.empty());
  const std::int32_t last = (std::int32_t(1) << MaximumDepth) - 1;
  const CornerShell two = makeCornerShell({ 0, mortonCode({ last, last, last }) }, execution);
  ASSERT_EQ(two.corners.size(), 16u);
  for (std::size_t cell = 0; cell < 2; ++cell)
  {
    for (int c = 0; c < 8; ++c)
    {
      EXPECT_EQ(two.corners[two.cellCorners[cell][c]], mortonCode(fromMorton(two.cells[cell]) + cornerOffset(c)));
    }
  }
}

/** A step may carry into a bit that no cell's code has, in a cell before the last one too. */
TEST(CornerShell, SortsWhatCarriesBeyondTheLastCell)
{
  Execution execution;
  Random random(7);
  for (int run = 0; run < 3000; ++run)
  {
    std::set<std::uint64_t> cells, corners;
    for (int n = 0; n < 3; ++n)
    {
      // Just before a power of two, where steps carry.
      const auto coordinate = [&] { return std::max(0, (1 << random.below(9)) - random.below(3)); };
      const LatticePoint p{ coordinate(), coordinate(), coordinate() };
      cells.insert(mortonCode(p));
      for (int c = 0; c < 8; ++c)
      {
        corners.insert(mortonCode(p + cornerOffset(c)));
      }
    }
    const CornerShell shell = makeCornerShell({ cells.begin(), cells.end() }, execution);
    ASSERT_TRUE(std::equal(corners.begin(), corners.end(), shell.corners.begin(), shell.corners.end())) << run;
  }
}

TEST(CornerShell, SameBytesForAnyNumberOfThreads)
{
  Random random(6);
  std::set<std::uint64_t> cells;
  for (int n = 0; n < 30000; ++n)
  {
    cells.insert(mortonCode({ random.below(60), random.below(60), random.below(500) }));
  }
  Execution execution;
  const CornerShell one = makeCornerShell({ cells.begin(), cells.end() }, execution);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution threaded(threads);
    const CornerShell many = makeCornerShell({ cells.begin(), cells.end() }, threaded);
    EXPECT_EQ(many.corners, one.corners);
    EXPECT_EQ(many.cellCorners, one.cellCorners);
  }
}

TEST(CornerShell, LeafCellsAreTheLastGenerationOfOneState)
{
  const PreparedViews prepared = prepareViews(viewsOf(sphereMesh(3, 0.9), swayingRing(8, 96), 96));
  const Octree octree = carveViews(prepared, unitCube(), 5);
  const auto cells = leafCells(octree, OctantState::Intersection);
  EXPECT_EQ(cells.size(), octree.count(OctantState::Intersection, 5));
  EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
  EXPECT_TRUE(leafCells(Octree(), OctantState::Inside).empty());
}

TEST(CornerShell, WithMoreCellsIsAsMadeAnew)
{
  Random random(8);
  const auto someCells = [&](int count)
  {
    std::vector<std::uint64_t> cells;
    for (int n = 0; n < count; ++n)
    {
      cells.push_back(mortonCode({ random.below(20), random.below(20), random.below(20) }));
    }
    sortUnique(cells);
    return cells;
  };
  for (const int threads : { 1, 3 })
  {
    ThreadedExecution execution(threads);
    for (const auto& [count, more] : { std::make_pair(3000, 100), std::make_pair(3000, 0), std::make_pair(500, 400), std::make_pair(0, 5), std::make_pair(0, 0) })
    {
      const CornerShell shell = makeCornerShell(someCells(count), execution);
      std::vector<std::uint64_t> others = someCells(more);
      if (count > 0 && more > 0)
      {
        others = united(others, { shell.cells.front(), shell.cells.back() });
      }
      const CornerShell wider = withCells(shell, others, execution), anew = makeCornerShell(united(shell.cells, others), execution);
      EXPECT_EQ(wider.cells, anew.cells);
      EXPECT_EQ(wider.corners, anew.corners);
      EXPECT_EQ(wider.cellCorners, anew.cellCorners);
    }
  }
}
