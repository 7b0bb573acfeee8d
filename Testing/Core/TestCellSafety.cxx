// SPDX-License-Identifier: BSD-3-Clause
#include "CellSafety.h"

#include "CarvingTestCaptures.h"
#include "SelfIntersections.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

struct RandomLabels
{
  explicit RandomLabels(int n)
    : lattice{ { Eigen::Vector3d(0.3, -4, 10), 1.6 }, 4 }
  {
    Random random(9);
    std::vector<std::uint64_t> cells;
    for (int c = 0; c < n * n * n; ++c)
    {
      cells.push_back(mortonCode({ c % n, c / n % n, c / n / n }));
    }
    std::sort(cells.begin(), cells.end());
    this->shell = makeCornerShell(cells, this->execution);
    std::vector<std::uint8_t> inside;
    for (const auto code : this->shell.corners)
    {
      const LatticePoint p = fromMorton(code);
      const bool border = p.i % n == 0 || p.j % n == 0 || p.k % n == 0;
      inside.push_back(!border && random.below(2));
    }
    this->surface = contour(this->shell, inside, this->execution);
    for (std::size_t e = 0; e < this->surface.edges.size(); ++e)
    {
      this->fractions.push_back(random.below(2) ? 0.01 : 0.99);
    }
  }
  Execution execution;
  Lattice lattice;
  CornerShell shell;
  LatticeSurface surface;
  std::vector<double> fractions;
};

} // namespace

TEST(CellSafety, RepairsACellThatWasMadeToIntersectItself)
{
  RandomLabels r(12);
  Mesh mesh = placePoints(r.lattice, r.shell, r.surface, r.fractions, false, r.execution);
  EXPECT_EQ(removeCellIntersections(r.lattice, r.shell, r.surface, false, mesh, r.execution), 0u);
  EXPECT_TRUE(selfIntersections(mesh, r.execution).empty());
  // Push points off their edges, far enough to fold their cells.
  for (std::size_t p = 0; p < mesh.points.size(); p += 97)
  {
    mesh.points[p] += Eigen::Vector3d(0.21, -0.17, 0.13);
  }
  ASSERT_FALSE(selfIntersections(mesh, r.execution).empty());
  EXPECT_GT(removeCellIntersections(r.lattice, r.shell, r.surface, false, mesh, r.execution), 0u);
  for (std::size_t cell = 0; cell < r.shell.cells.size(); ++cell)
  {
    std::vector<std::int32_t> own;
    for (std::uint32_t t = cell ? r.surface.cellEnd[cell - 1] : 0; t < r.surface.cellEnd[cell]; ++t)
    {
      own.push_back(std::int32_t(t));
    }
    EXPECT_TRUE(selfIntersectionsAmong(mesh, own, r.execution).empty());
  }
}

TEST(CellSafety, PointsStayApartInSinglePrecision)
{
  RandomLabels r(12);
  const Mesh mesh = placePoints(r.lattice, r.shell, r.surface, r.fractions, true, r.execution);
  for (const auto& p : mesh.points)
  {
    EXPECT_EQ(p, roundedToFloat(p));
  }
  EXPECT_TRUE(assessMesh(mesh, r.execution).sound());
}

TEST(CellSafety, FloatThatIsTooCoarseForTheDepthIsAnError)
{
  EXPECT_NO_THROW(requireSinglePrecision({ { Eigen::Vector3d(-1, -1, -1), 2.0 }, 12 }));
  EXPECT_THROW(requireSinglePrecision({ { Eigen::Vector3d(-1, -1, -1), 2.0 }, 16 }), InvalidInput);
  EXPECT_THROW(requireSinglePrecision({ { Eigen::Vector3d(5e6, 0, 0), 2.0 }, 6 }), InvalidInput);
}

TEST(CellSafety, RoundedToFloatRounds)
{
  for (int i = 1; i < 1000; ++i)
  {
    const Vector3 p(1.0 / i, 3.0 / (7.0 + i), 1e-9 * i + 1.0);
    const Vector3 q = roundedToFloat(p);
    for (int axis = 0; axis < 3; ++axis)
    {
      const volatile float expected = float(p[axis]);
      EXPECT_EQ(q[axis], double(expected));
    }
  }
}
