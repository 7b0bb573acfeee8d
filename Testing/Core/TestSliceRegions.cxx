// SPDX-License-Identifier: BSD-3-Clause
#include "SliceRegions.h"

#include "CarvingTestCaptures.h"
#include "RowIntervals.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

using Cells = std::set<std::pair<int, int>>; ///< (row, place)

Cells cellsOf(const SliceRuns& runs)
{
  Cells cells;
  for (const auto& run : runs)
  {
    for (int u = run.from; u < run.to; ++u)
    {
      EXPECT_TRUE(cells.emplace(run.v, u).second) << "runs of one row do not touch";
    }
  }
  return cells;
}

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

TEST(SliceRegions, ConvexRegionsStayWhole)
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

TEST(SliceRegions, ConcaveRegionsAreCutIntoConvexPartsThatCoverThem)
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

TEST(SliceRegions, RandomRegionsAreSplitAndCovered)
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

TEST(SliceRegions, OverlapAndHalvesCountCells)
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

TEST(SliceRegions, TheVolumesPartsAreTheSurvivorsCells)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(9, 120), 120));
  const Octree octree = carveViews(views, unitCube(), 5);
  const std::vector<std::uint64_t> further = { mortonCode({ 1, 1, 1 }), mortonCode({ 1, 2, 1 }) };
  for (int axis = 0; axis < 3; ++axis)
  {
    SliceOptions options;
    options.axis = axis;
    const auto volume = sliceVolume(octree, further, options, execution);
    EXPECT_EQ(volume.axis, axis);
    std::set<std::uint64_t> found;
    for (std::size_t s = 0; s < volume.parts.size(); ++s)
    {
      for (const auto& part : volume.parts[s])
      {
        for (const auto& [v, u] : cellsOf(part))
        {
          const auto row = std::uint64_t(v) << 32 | std::uint64_t(u);
          found.insert(mortonCode(pointOnRow(row, axis, volume.firstSlice + std::int32_t(s))));
        }
      }
    }
    std::set<std::uint64_t> expected(further.begin(), further.end());
    for (std::uint64_t code = 0; code < 32768; ++code)
    {
      if (octree.locate(fromMorton(code)).state != OctantState::Background)
      {
        expected.insert(code);
      }
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(SliceRegions, TheAxisFoundIsThatOfTheFewestPartsThenTheLongest)
{
  Execution execution;
  const auto axisOf = [&](const Mesh& mesh)
  {
    const PreparedViews views = prepareViews(viewsOf(mesh, axisCameras(50, 160), 160));
    return sliceVolume(carveViews(views, unitCube(), 5), {}, {}, execution).axis;
  };
  // Slices across the dumbbell's axis are convex, the others are not.
  EXPECT_EQ(axisOf(joined(joined(boxMesh({ -0.3, -0.8, -0.3 }, { 0.3, -0.3, 0.3 }), boxMesh({ -0.3, 0.3, -0.3 }, { 0.3, 0.8, 0.3 })),
              boxMesh({ -0.1, -0.4, -0.1 }, { 0.1, 0.4, 0.1 }))), 1);
  EXPECT_EQ(axisOf(boxMesh({ -0.3, -0.4, -0.9 }, { 0.3, 0.4, 0.9 })), 2);
}

TEST(SliceRegions, SameForAnyNumberOfThreads)
{
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(9, 120), 120));
  const Octree octree = carveViews(views, unitCube(), 5);
  Execution serial;
  const auto one = sliceVolume(octree, {}, {}, serial);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = sliceVolume(octree, {}, {}, execution);
    EXPECT_EQ(one.parts, many.parts);
    EXPECT_EQ(one.axis, many.axis);
    EXPECT_EQ(one.regions, many.regions);
  }
}

TEST(SliceRegions, OptionsOutOfRangeAreErrors)
{
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(2, 0.5), swayingRing(5, 60), 60));
  const Octree octree = carveViews(views, unitCube(), 3);
  Execution execution;
  for (const int axis : { -2, 3 })
  {
    SliceOptions options;
    options.axis = axis;
    EXPECT_THROW(sliceVolume(octree, {}, options, execution), InvalidInput);
  }
  SliceOptions options;
  for (const double tolerance : { -0.1, std::nan("") })
  {
    options.tolerance = tolerance;
    EXPECT_THROW(sliceVolume(octree, {}, options, execution), InvalidInput);
  }
  CancelledExecution cancelled;
  EXPECT_THROW(sliceVolume(octree, {}, {}, cancelled), Cancelled);
}
