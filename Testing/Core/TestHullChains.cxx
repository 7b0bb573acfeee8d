// SPDX-License-Identifier: BSD-3-Clause
#include "HullChains.h"

#include "CarvingTestCaptures.h"
#include "ConvexHull.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

Lattice latticeOf(int depth)
{
  return { { Vector3::Zero(), std::ldexp(1.0, depth) }, depth }; // world coordinates are lattice coordinates
}

/** A block of cells [u0, u1) x [v0, v1). */
SliceRuns block(int u0, int u1, int v0, int v1)
{
  SliceRuns runs;
  for (int v = v0; v < v1; ++v)
  {
    runs.push_back({ v, u0, u1 });
  }
  return runs;
}

/** Rows of the union of boxes along all axes. */
SolidRows rowsOf(const std::vector<Mesh>& boxes, const Lattice& lattice)
{
  SolidRows rows;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const auto& box : boxes)
    {
      const auto some = convexRows(box, axis, lattice);
      rows[axis].insert(rows[axis].end(), some.begin(), some.end());
    }
    uniteRows(rows[axis]);
  }
  return rows;
}

} // namespace

TEST(HullChains, PartsAreLinkedWithWhatTheyOverlapMost)
{
  SlicedVolume volume;
  volume.parts = { { block(0, 8, 0, 8), block(20, 24, 0, 4) },
    { block(0, 3, 0, 8), block(3, 9, 0, 8), block(22, 30, 0, 4), block(40, 41, 0, 1) }, { block(4, 8, 2, 6) } };
  using Link = std::pair<std::uint32_t, std::uint32_t>;
  const auto half = linkParts(volume, 0.5);
  const std::vector<PartChain> expected = { { Link(0, 0), Link(1, 1), Link(2, 0) }, { Link(0, 1), Link(1, 2) },
    { Link(1, 0) }, { Link(1, 3) } };
  EXPECT_EQ(half, expected);
  EXPECT_EQ(linkParts(volume, 0.6).size(), 5u) << "half of the smaller part is not six tenths of it";
}

TEST(HullChains, PointsBelongToEveryPartThatTouchesThem)
{
  SlicedVolume volume;
  volume.axis = 2;
  volume.firstSlice = 4;
  volume.parts = { { block(0, 4, 0, 4), block(4, 8, 0, 4) }, { block(0, 4, 0, 4) } };
  // A point in a cell, one in the face between two parts, one between the slices, one elsewhere.
  const std::vector<Vector3> points = { { 1.5, 1, 4.2 }, { 4, 2.5, 4.5 }, { 1, 1.5, 5 }, { 1.5, 1.5, 3.9 }, { 9, 1, 4.5 } };
  const SlicePoints slicePoints(volume, points);
  EXPECT_EQ(slicePoints.inPart(0, volume.parts[0][0]), (std::vector<std::int32_t>{ 0, 1, 2 }));
  EXPECT_EQ(slicePoints.inPart(0, volume.parts[0][1]), (std::vector<std::int32_t>{ 1 }));
  EXPECT_EQ(slicePoints.inPart(1, volume.parts[1][0]), (std::vector<std::int32_t>{ 2 }));
}

TEST(HullChains, AHullHoldsOutsideJustWhereTheGapIsDeeperThanTheTolerance)
{
  const Lattice lattice = latticeOf(5);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double notch : { 0.3, 0.8, 2.0 })
    {
      // A box from 4 to 20 with a groove across it: deep as the notch, 10 wide.
      std::vector<Mesh> boxes;
      Vector3 low = Vector3::Constant(4.0), high = Vector3::Constant(20.0);
      high[axis] = 20.0 - notch;
      boxes.push_back(boxMesh(low, high));
      high[axis] = 20.0;
      const int other = (axis + 1) % 3;
      high[other] = 7.0;
      boxes.push_back(boxMesh(low, high));
      low[other] = 17.0;
      high[other] = 20.0;
      boxes.push_back(boxMesh(low, high));
      const SolidRows solid = rowsOf(boxes, lattice);
      const Mesh hull = boxMesh(4.0, 20.0);
      EXPECT_TRUE(holdsOutside(hull, solid, lattice, notch - 0.01)) << axis << " " << notch;
      EXPECT_FALSE(holdsOutside(hull, solid, lattice, notch + 0.01)) << axis << " " << notch;
      EXPECT_FALSE(holdsOutside(boxes[0], solid, lattice, 0.0));
    }
  }
}

TEST(HullChains, AChainEndsWhereItsHullWouldHoldTooMuch)
{
  // A narrow stack on a wide one: slices 2 to 9 and 10 to 17 across z.
  const Lattice lattice = latticeOf(5);
  const std::vector<Mesh> boxes = { boxMesh({ 4, 4, 2.5 }, { 20, 20, 10.5 }), boxMesh({ 9, 9, 10.5 }, { 15, 15, 17.5 }) };
  SlicedVolume volume;
  volume.axis = 2;
  volume.firstSlice = 2;
  std::vector<Vector3> points;
  for (int slice = 2; slice < 18; ++slice)
  {
    const bool wide = slice < 11;
    volume.parts.push_back({ wide ? block(4, 20, 4, 20) : block(9, 15, 9, 15) });
    for (int corner = 0; corner < 4; ++corner)
    {
      const double low = wide ? 4.0 : 9.0, high = wide ? 20.0 : 15.0;
      points.emplace_back(corner & 1 ? high : low, corner & 2 ? high : low, slice + 0.4);
      points.emplace_back(corner & 1 ? high : low, corner & 2 ? high : low, slice + 0.6);
    }
  }
  const SolidRows solid = rowsOf({ boxMesh({ 4, 4, 2 }, { 20, 20, 11 }), boxMesh({ 9, 9, 11 }, { 15, 15, 18 }) }, lattice);
  Execution execution;
  ChainOptions tight;
  tight.tolerance = 0.1;
  const auto hulls = hullChains(volume, points, solid, lattice, tight, execution);
  ASSERT_EQ(hulls.size(), 2u);
  EXPECT_EQ(hulls[0].surfacePoints.size(), 72u);
  EXPECT_EQ(hulls[1].surfacePoints.size(), 56u);
  EXPECT_NEAR(assessMesh(hulls[0].mesh, execution).volume, 16 * 16 * 8.2, 1e-6);
  EXPECT_NEAR(assessMesh(hulls[1].mesh, execution).volume, 6 * 6 * 6.2, 1e-6);
  ChainOptions loose;
  loose.tolerance = 20.0;
  EXPECT_EQ(hullChains(volume, points, solid, lattice, loose, execution).size(), 1u);
}

/** Longer stretches first, then halved steps, end where one slice at a time does. */
TEST(HullChains, TheStretchFoundIsTheLongestThatFits)
{
  const Lattice lattice = latticeOf(6);
  Execution execution;
  for (int bend = 4; bend < 40; bend += 3)
  {
    // A staircase of blocks two cells thick that begins to run aslant at slice `bend`.
    SlicedVolume volume;
    volume.axis = 2;
    volume.firstSlice = 1;
    std::vector<Vector3> points;
    std::vector<Mesh> boxes;
    for (int slice = 1; slice < 44; ++slice)
    {
      const int u = 2 + std::max(0, slice - bend);
      volume.parts.push_back({ block(u, u + 8, 4, 10) });
      boxes.push_back(boxMesh(Vector3(u, 4, slice), Vector3(u + 8, 10, slice + 1)));
      points.insert(points.end(), boxes.back().points.begin(), boxes.back().points.end());
    }
    const SolidRows solid = rowsOf(boxes, lattice);
    ChainOptions options;
    options.tolerance = 1.0;
    const auto hulls = hullChains(volume, points, solid, lattice, options, execution);
    // The first chain, one slice at a time.
    std::vector<Vector3> stretch;
    std::size_t slices = 0;
    for (; slices < boxes.size(); ++slices)
    {
      auto longer = stretch;
      longer.insert(longer.end(), boxes[slices].points.begin(), boxes[slices].points.end());
      if (holdsOutside(*convexHull(longer), solid, lattice, options.tolerance))
      {
        break;
      }
      stretch = std::move(longer);
    }
    Vector3 top = hulls.at(0).mesh.points.front();
    for (const auto& p : hulls[0].mesh.points)
    {
      top = top.cwiseMax(p);
    }
    EXPECT_GT(hulls.size(), 1u);
    EXPECT_EQ(top.z(), double(slices + 1)) << bend;
  }
}

TEST(HullChains, PartsAreHalvedUntilTheirHullsFit)
{
  // An L one slice thick whose 2D parts were not cut.
  const Lattice lattice = latticeOf(5);
  const std::vector<Mesh> legs = { boxMesh({ 4, 4, 6 }, { 8, 24, 7 }), boxMesh({ 4, 4, 6 }, { 24, 8, 7 }) };
  SlicedVolume volume;
  volume.axis = 2;
  volume.firstSlice = 6;
  SliceRuns part = block(4, 24, 4, 8);
  const SliceRuns leg = block(4, 8, 8, 24);
  part.insert(part.end(), leg.begin(), leg.end());
  volume.parts = { { part } };
  std::vector<Vector3> points;
  for (int n = 4; n <= 24; ++n)
  {
    for (const double z : { 6.0, 7.0 })
    {
      points.insert(points.end(), { Vector3(n, 4, z), Vector3(4, n, z), Vector3(std::max(8, n), 8, z), Vector3(8, std::max(8, n), z) });
    }
  }
  const SolidRows solid = rowsOf(legs, lattice);
  Execution execution;
  refineParts(volume, SlicePoints(volume, points), points, solid, lattice, 0.5, execution);
  EXPECT_GT(volume.parts[0].size(), 1u);
  const SlicePoints slicePoints(volume, points);
  std::int64_t cells = 0;
  for (const auto& piece : volume.parts[0])
  {
    std::vector<Vector3> corners;
    for (const auto p : slicePoints.inPart(0, piece))
    {
      corners.push_back(points[p]);
    }
    const auto hull = convexHull(corners);
    EXPECT_TRUE(!hull || !holdsOutside(*hull, solid, lattice, 0.5));
    cells = std::max(cells, cellCount(piece));
  }
  EXPECT_GE(cells, 30) << "not cut to pieces";
}

TEST(HullChains, OptionsOutOfRangeAreErrors)
{
  Execution execution;
  ChainOptions options;
  for (const double tolerance : { -1e-9, std::nan("") })
  {
    options.tolerance = tolerance;
    EXPECT_THROW(hullChains({}, {}, {}, latticeOf(3), options, execution), InvalidInput);
  }
  options = {};
  for (const double overlap : { 0.0, 1.01, std::nan("") })
  {
    options.overlap = overlap;
    EXPECT_THROW(hullChains({}, {}, {}, latticeOf(3), options, execution), InvalidInput);
  }
  CancelledExecution cancelled;
  EXPECT_THROW(hullChains({}, {}, {}, latticeOf(3), {}, cancelled), Cancelled);
}
