// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceCells.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

TEST(SurfaceCells, HoldThePointsInWhateverOrderTheyCome)
{
  const Lattice lattice{ { Vector3(-1.0, 2.0, 0.5), 3.0 }, 5 };
  Random random(4);
  for (int trial = 0; trial < 10; ++trial)
  {
    Mesh surface;
    std::set<std::uint64_t> expected, coarser;
    for (int n = 0; n < 20000; ++n)
    {
      const Vector3 x(random.uniform(-3.0, 35.0), random.uniform(-3.0, 35.0), random.uniform(-3.0, 35.0)); // some beyond
      surface.points.push_back(lattice.root.origin + x * lattice.leafEdge());
      const auto cell = [](double value) { return std::int32_t(std::clamp(std::floor(value), 0.0, 31.0)); };
      expected.insert(mortonCode({ cell(x[0]), cell(x[1]), cell(x[2]) }));
      coarser.insert(mortonCode({ cell(x[0]) / 4, cell(x[1]) / 4, cell(x[2]) / 4 }));
    }
    if (trial % 2 == 0) // as surfaces have them
    {
      std::sort(surface.points.begin(), surface.points.end(), [](const Vector3& a, const Vector3& b) { return a[2] < b[2]; });
    }
    surface.points.push_back(Vector3::Constant(std::nan("")));
    surface.points.insert(surface.points.begin(), Vector3(0.0, std::numeric_limits<double>::infinity(), 0.0));
    surface.points.insert(surface.points.begin() + 1000, Vector3::Constant(-std::numeric_limits<double>::infinity()));
    ThreadedExecution execution(1 + trial % 3);
    const auto cells = surfaceCells(surface, lattice, execution);
    EXPECT_EQ(cells, std::vector<std::uint64_t>(expected.begin(), expected.end())) << trial;
    EXPECT_EQ(coarserCells(cells, 2), std::vector<std::uint64_t>(coarser.begin(), coarser.end())) << trial;
    EXPECT_EQ(coarserCells(cells, 0), cells);
  }
}

TEST(SurfaceCells, OfNoPointsThereAreNone)
{
  Execution execution;
  EXPECT_TRUE(surfaceCells({}, Lattice{ unitCube(), 3 }, execution).empty());
  EXPECT_TRUE(coarserCells({}, 1).empty());
}
