// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexParts.h"

#include "CarvingTestCaptures.h"
#include "SliceRunsTesting.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

SliceRuns runsOf(const Cells& cells)
{
  SliceRuns runs;
  for (const auto& [v, u] : cells)
  {
    if (!runs.empty() && runs.back().v == v && runs.back().to == u)
    {
      ++runs.back().to;
    }
    else
    {
      runs.push_back({ v, u, u + 1 });
    }
  }
  return runs;
}

template <typename Inside>
SliceRuns paint(int size, const Inside& inside)
{
  Cells cells;
  for (int v = 0; v < size; ++v)
  {
    for (int u = 0; u < size; ++u)
    {
      if (inside(u, v))
      {
        cells.emplace(v, u);
      }
    }
  }
  return runsOf(cells);
}

/** Brute force: how far the part reaches in each of many directions. */
std::vector<double> reachOf(const Cells& part)
{
  std::vector<double> reach(720, -1e300);
  for (std::size_t n = 0; n < reach.size(); ++n)
  {
    const double a = std::acos(-1.0) * double(n) / 360.0;
    for (const auto& [v, u] : part)
    {
      reach[n] = std::max(reach[n], std::cos(a) * u + std::sin(a) * v);
    }
  }
  return reach;
}

double depthBelowHull(const std::vector<double>& reach, int u, int v)
{
  double least = 1e300;
  for (std::size_t n = 0; n < reach.size(); ++n)
  {
    const double a = std::acos(-1.0) * double(n) / 360.0;
    least = std::min(least, reach[n] - std::cos(a) * u - std::sin(a) * v);
  }
  return least;
}

void expectConvexCover(
  const SliceRuns& region, const std::vector<SliceRuns>& parts, double tolerance, const std::string& what)
{
  const Cells whole = cellsOf(region);
  Cells covered;
  for (const auto& runs : parts)
  {
    const Cells part = cellsOf(runs);
    const auto reach = reachOf(part);
    covered.insert(part.begin(), part.end());
    EXPECT_EQ(connectedRegions(runs).size(), 1u);
    for (int v = 0; v < 40; ++v)
    {
      for (int u = 0; u < 40; ++u)
      {
        if (!whole.count({ v, u }))
        {
          EXPECT_LE(depthBelowHull(reach, u, v), tolerance + 0.02) << what << " at " << u << ", " << v;
        }
      }
    }
  }
  EXPECT_EQ(covered, whole) << what;
}

bool inDisc(double u, double v, double cu, double cv, double r)
{
  return std::hypot(u - cu, v - cv) <= r;
}

} // namespace

TEST(ConvexParts, ConvexRegionsStayWhole)
{
  for (const double tolerance : { 0.0, 0.5 })
  {
    for (const double r : { 0.3, 1.0, 3.7, 11.2, 17.0 })
    {
      const SliceRuns disc = paint(40, [&](int u, int v) { return inDisc(u, v, 19.4, 20.1, r); });
      EXPECT_EQ(convexParts(disc, disc, tolerance), std::vector<SliceRuns>{ disc }) << r;
    }
    const SliceRuns slanted = paint(40, [](int u, int v) { return std::abs(u + 0.37 * v - 25) + std::abs(v - 18.0) < 12; });
    EXPECT_EQ(convexParts(slanted, slanted, tolerance), std::vector<SliceRuns>{ slanted });
  }
}

TEST(ConvexParts, ConcaveRegionsAreCutIntoConvexPartsThatCoverThem)
{
  const std::vector<SliceRuns> regions = {
    paint(40, [](int u, int v) { return (u < 8 && v < 36) || (v < 9 && u < 30); }),                // L
    paint(40, [](int u, int v) { return inDisc(u, v, 20, 20, 18) && !inDisc(u, v, 20, 20, 9); }),  // ring
    paint(40, [](int u, int v) { return inDisc(u, v, 10, 12, 9) || inDisc(u, v, 26, 20, 10); }),   // two discs
    paint(40, [](int u, int v) { return (u % 8 < 3 && v < 30) || v < 4; }) };                      // comb
  for (std::size_t n = 0; n < regions.size(); ++n)
  {
    std::size_t previous = 1000;
    for (const double tolerance : { 0.0, 0.5, 1.5 })
    {
      const auto parts = convexParts(regions[n], regions[n], tolerance);
      expectConvexCover(regions[n], parts, tolerance, "region " + std::to_string(n));
      EXPECT_GT(parts.size(), 1u);
      EXPECT_LE(parts.size(), previous) << "a larger tolerance gives no more parts";
      previous = parts.size();
    }
  }
  EXPECT_EQ(convexParts(regions[0], regions[0], 0.5).size(), 2u) << "an L is cut at its inner corner";
  EXPECT_EQ(convexParts(regions[0], regions[0], 40.0).size(), 1u);
}

TEST(ConvexParts, RandomRegionsAreSplitAndCovered)
{
  Random random(11);
  for (int run = 0; run < 12; ++run)
  {
    const double density = random.uniform(0.3, 0.95);
    const SliceRuns slice = paint(16, [&](int, int) { return random.uniform() < density; });
    std::size_t cells = 0;
    for (const auto& region : connectedRegions(slice))
    {
      cells += cellsOf(region).size();
      Cells covered;
      for (const auto& part : convexParts(region, slice, 0.5))
      {
        const Cells some = cellsOf(part);
        covered.insert(some.begin(), some.end());
      }
      EXPECT_EQ(covered, cellsOf(region));
    }
    EXPECT_EQ(cells, cellsOf(slice).size()) << "regions share no cell";
  }
}

TEST(ConvexParts, OverlapAndHalvesCountCells)
{
  Random random(5);
  for (int run = 0; run < 50; ++run)
  {
    const SliceRuns a = paint(12, [&](int, int) { return random.uniform() < 0.6; });
    const SliceRuns b = paint(12, [&](int, int) { return random.uniform() < 0.4; });
    const Cells left = cellsOf(a), right = cellsOf(b);
    const auto common = std::count_if(left.begin(), left.end(), [&](const auto& cell) { return right.count(cell) > 0; });
    EXPECT_EQ(overlap(a, b), common);
    EXPECT_EQ(overlap(b, a), common);
    EXPECT_EQ(cellCount(a), std::int64_t(left.size()));
    Cells covered;
    for (const auto& half : halves(a))
    {
      const Cells cells = cellsOf(half);
      EXPECT_LT(cells.size(), left.size());
      covered.insert(cells.begin(), cells.end());
    }
    EXPECT_EQ(covered, left);
  }
  EXPECT_EQ(halves({ { 3, 4, 5 } }).size(), 1u) << "a cell is not cut";
}
