// SPDX-License-Identifier: BSD-3-Clause
#include "SliceRegions.h"

#include "CarvingTestCaptures.h"
#include "RowIntervals.h"
#include "SliceRunsTesting.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

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
