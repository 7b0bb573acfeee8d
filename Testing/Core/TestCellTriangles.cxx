// SPDX-License-Identifier: BSD-3-Clause
#include "CellTriangles.h"

#include "CarvingTestCaptures.h"
#include "CellBoxes.h"
#include "LabelledSolids.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

struct Scene
{
  LabelledSolid solid{ 5, [](const LatticePoint& p) { return 9.3 - std::hypot(p.i - 15.2, p.j - 16.1, p.k - 14.7); } };
  const CornerShell& shell = solid.labels->shell();
  LatticeSurface surface = contour(shell, solid.labels->inside(), solid.execution);
  CellTriangles triangles{ shell, surface };
  const Lattice& lattice = solid.octree.lattice;

  /** The cell that a triangle lies in: that of the middle of its points. */
  LatticePoint cellOf(const Triangle& triangle) const
  {
    Vector3 sum = Vector3::Zero();
    for (const std::int32_t p : triangle)
    {
      sum += crossingPosition(this->lattice, this->shell, this->surface.edges[std::size_t(p)], 0.4);
    }
    const Vector3 x = (sum / 3.0 - this->lattice.root.origin) / this->lattice.leafEdge();
    return { int(x[0]), int(x[1]), int(x[2]) };
  }

  template <typename Is> std::vector<std::int32_t> those(const Is& is) const
  {
    std::vector<std::int32_t> found;
    for (std::size_t t = 0; t < this->surface.triangles.size(); ++t)
    {
      if (is(this->cellOf(this->surface.triangles[t])))
      {
        found.push_back(std::int32_t(t));
      }
    }
    return found;
  }
};

} // namespace

TEST(CellTriangles, AreThoseThatLieInTheCells)
{
  Scene scene;
  Random random(5);
  std::vector<std::uint64_t> cells;
  for (int n = 0; n < 4000; ++n)
  {
    cells.push_back(mortonCode({ random.below(40), random.below(40), random.below(40) })); // some beyond the lattice
  }
  sortUnique(cells);
  const auto expected = scene.those([&](const LatticePoint& cell) { return std::binary_search(cells.begin(), cells.end(), mortonCode(cell)); });
  EXPECT_EQ(scene.triangles.ofCells(cells), expected);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_LT(expected.size(), scene.surface.triangles.size());
}

TEST(CellTriangles, AreThoseOfRows)
{
  Scene scene;
  std::vector<std::uint8_t> rows(32 * 32, 0);
  for (int k = 12; k < 20; k += 3)
  {
    for (int j = 9; j < 25; j += 2)
    {
      rows[std::size_t(32 * k + j)] = 1;
    }
  }
  const auto expected = scene.those([&](const LatticePoint& cell) { return rows[std::size_t(32 * cell.k + cell.j)] != 0; });
  EXPECT_EQ(scene.triangles.inRows(rows, scene.lattice, scene.solid.execution), expected);
  EXPECT_GT(expected.size(), 50u);
  EXPECT_LT(expected.size(), scene.surface.triangles.size() / 2);
}

TEST(CellBoxes, HoldEveryCellThatABoxMeets)
{
  const Lattice lattice{ { Vector3(-1.0, 2.0, 0.5), 3.0 }, 4 };
  Random random(6);
  for (int n = 0; n < 200; ++n)
  {
    Box box;
    for (int end = 0; end < 2; ++end)
    {
      box.extend(Vector3(random.uniform(-1.5, 2.5), random.uniform(1.5, 5.5), random.uniform(0.0, 4.0)));
    }
    const auto cells = cellsMet(lattice, { box });
    EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
    std::size_t met = 0;
    for (std::uint64_t code = 0; code < 16 * 16 * 16; ++code)
    {
      const Vector3 low = lattice.root.origin + toVector(fromMorton(code)) * lattice.leafEdge();
      const bool meets = Box(low, low + Vector3::Constant(lattice.leafEdge())).intersects(box);
      EXPECT_TRUE(!meets || std::binary_search(cells.begin(), cells.end(), code));
      met += meets;
    }
    EXPECT_TRUE(met == 0 || cells.size() <= 27 * met);
  }
}
