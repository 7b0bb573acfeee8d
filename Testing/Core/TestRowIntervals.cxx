// SPDX-License-Identifier: BSD-3-Clause
#include "RowIntervals.h"

#include "CarvingTestCaptures.h"
#include "ConvexHull.h"

#include <gtest/gtest.h>

#include <map>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

Lattice latticeOf(int depth)
{
  return { { Vector3::Zero(), std::ldexp(1.0, depth) }, depth }; // world coordinates are lattice coordinates
}

Mesh randomHull(Random& random, int points, double low, double high)
{
  std::vector<Vector3> cloud;
  for (int n = 0; n < points; ++n)
  {
    cloud.emplace_back(random.uniform(low, high), random.uniform(low, high), random.uniform(low, high));
  }
  return *convexHull(cloud);
}

/** How far p is beyond the hull's planes; negative inside. */
double beyond(const Mesh& hull, const Vector3& p)
{
  double most = -1e300;
  for (const auto& t : hull.triangles)
  {
    const Vector3 a = hull.points[t[0]];
    const Vector3 normal = (hull.points[t[1]] - a).cross(hull.points[t[2]] - a).normalized();
    most = std::max(most, normal.dot(p - a));
  }
  return most;
}

} // namespace

TEST(RowIntervals, ARandomHullsRowsAreThoseOfItsPlanes)
{
  Random random(7);
  const Lattice lattice = latticeOf(4);
  for (int run = 0; run < 40; ++run)
  {
    const Mesh hull = randomHull(random, 4 + random.below(30), 0.2, 15.8);
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto rows = convexRows(hull, axis, lattice);
      for (std::size_t n = 1; n < rows.size(); ++n)
      {
        EXPECT_LT(rows[n - 1].row, rows[n].row);
      }
      for (std::uint64_t code = 0; code < 4096; ++code)
      {
        const LatticePoint p = fromMorton(code);
        const double f = beyond(hull, { double(p.i), double(p.j), double(p.k) });
        if (!lattice.onBorder(p) && std::abs(f) > 1e-6)
        {
          EXPECT_EQ(findInterval(rows, rowKey(p, axis), coordinateOf(p, axis)) != nullptr, f < 0.0);
        }
      }
      for (const auto& row : rows)
      {
        for (const double end : { row.from, row.to })
        {
          Vector3 p = Vector3::Zero();
          const LatticePoint origin = pointOnRow(row.row, axis, 0);
          p << origin.i, origin.j, origin.k;
          p[axis] = end;
          EXPECT_NEAR(beyond(hull, p), 0.0, 1e-6);
        }
      }
    }
  }
}

TEST(RowIntervals, ABoxOnLatticePlanesHoldsItsFaces)
{
  const Lattice lattice = latticeOf(3);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto rows = convexRows(boxMesh(2.0, 5.0), axis, lattice);
    ASSERT_EQ(rows.size(), 16u);
    for (const auto& row : rows)
    {
      EXPECT_EQ(row.from, 2.0);
      EXPECT_EQ(row.to, 5.0);
    }
  }
  EXPECT_TRUE(convexRows(boxMesh(2.1, 2.9), 0, lattice).empty()) << "between the rows";
  EXPECT_EQ(convexRows(boxMesh(-3.0, 20.0), 0, lattice).size(), 49u) << "only rows within the border";
}

TEST(RowIntervals, UnitedRowsHoldWhatAnyOfThemHolds)
{
  Random random(3);
  std::vector<RowInterval> rows;
  for (int n = 0; n < 200; ++n)
  {
    const double from = random.uniform(0, 60);
    rows.push_back({ std::uint64_t(random.below(4)), from, from + random.uniform(0, 2) });
  }
  auto united = rows;
  uniteRows(united);
  for (std::size_t n = 1; n < united.size(); ++n)
  {
    EXPECT_TRUE(united[n - 1].row < united[n].row || united[n - 1].to < united[n].from);
  }
  for (int n = 0; n < 4000; ++n)
  {
    const auto row = std::uint64_t(random.below(5));
    const double place = random.uniform(-1, 63);
    const bool held = std::any_of(rows.begin(), rows.end(),
      [&](const RowInterval& r) { return r.row == row && r.from <= place && place <= r.to; });
    EXPECT_EQ(findInterval(united, row, place) != nullptr, held);
  }
}

TEST(RowIntervals, ASurfacesRowsTellItsInsideCorners)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(9, 120), 120));
  const Octree octree = carveViews(views, unitCube(), 4);
  const auto surface = votingMarchingCubes(octree, views, VotingOptions(), execution);
  const auto crossings = locateCrossings(surface.mesh, octree.lattice, CrossingSides::Located, execution);
  const SolidRows rows = surfaceRows(crossings);
  const LatticeViews lattice(views, octree.lattice);
  std::size_t inside = 0;
  for (std::uint64_t code = 0; code < 4096; ++code)
  {
    const LatticePoint p = fromMorton(code);
    const bool in = !octree.lattice.onBorder(p) && lattice.insideVotes(p) == views.size();
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(findInterval(rows[axis], rowKey(p, axis), coordinateOf(p, axis)) != nullptr, in);
    }
    inside += in;
  }
  EXPECT_GT(inside, 50u);
}

TEST(RowIntervals, LatticeCoordinatesSnapToPlanes)
{
  const Lattice lattice{ { Vector3(0.1, -7.3, 1e3), 3.7 }, 5 };
  for (std::uint64_t code = 0; code < 32768; code += 17)
  {
    const LatticePoint p = fromMorton(code);
    EXPECT_EQ(latticeCoordinates(lattice.position(p), lattice, 1e-7), Vector3(p.i, p.j, p.k));
  }
  EXPECT_NEAR(latticeCoordinates(lattice.root.origin + Vector3(0.01, 0, 0) * lattice.leafEdge(), lattice, 1e-3)[0], 0.01, 1e-9);
}
