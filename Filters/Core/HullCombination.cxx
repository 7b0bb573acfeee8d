// SPDX-License-Identifier: BSD-3-Clause
#include "HullCombination.h"

#include "MarchingCubesTable.h"

#include <algorithm>
#include <cmath>

namespace silhouette
{
namespace
{

constexpr double SnapDistance = 1e-7; ///< octants: far more than rounding moves a hull's point, far less than shows

Mesh inLatticeCoordinates(const Mesh& hull, const Lattice& lattice)
{
  Mesh local = hull;
  for (auto& p : local.points)
  {
    p = latticeCoordinates(p, lattice, SnapDistance);
  }
  return local;
}

/** Add the four cells around the lattice edge from `lower` along `axis`. */
void addCellsAround(const LatticePoint& lower, int axis, const Lattice& lattice, std::vector<std::uint64_t>& cells)
{
  for (int n = 0; n < 4; ++n)
  {
    std::array<std::int32_t, 3> c{ lower.i, lower.j, lower.k };
    c[(axis + 1) % 3] -= n & 1;
    c[(axis + 2) % 3] -= n >> 1;
    if (lattice.hasCell({ c[0], c[1], c[2] }))
    {
      cells.push_back(mortonCode({ c[0], c[1], c[2] }));
    }
  }
}

/** The cells around the edges on which rows begin and end. */
std::vector<std::uint64_t> cellsAtEnds(const SolidRows& rows, const Lattice& lattice)
{
  std::vector<std::uint64_t> cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const auto& interval : rows[axis])
    {
      const auto first = std::max(1, std::int32_t(std::ceil(interval.from - RowTolerance)));
      const auto last = std::min(lattice.cells() - 1, std::int32_t(std::floor(interval.to + RowTolerance)));
      if (first <= last)
      {
        addCellsAround(pointOnRow(interval.row, axis, first - 1), axis, lattice, cells);
        addCellsAround(pointOnRow(interval.row, axis, last), axis, lattice, cells);
      }
    }
  }
  sortUnique(cells);
  return cells;
}

std::vector<std::uint8_t> labelCorners(
  const CornerShell& shell, const SolidRows& rows, const Lattice& lattice, Execution& execution)
{
  std::vector<std::uint8_t> inside(shell.corners.size());
  execution.forRanges(inside.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        const LatticePoint p = fromMorton(shell.corners[c]);
        inside[c] = !lattice.onBorder(p) && findInterval(rows[0], rowKey(p, 0), p.i) != nullptr;
      }
    });
  return inside;
}

/** Cells beside a crossed edge that the shell does not have: where rows of two axes differ in their last bits. */
std::vector<std::uint64_t> missingCells(
  const CornerShell& shell, const std::vector<std::uint8_t>& inside, const Lattice& lattice)
{
  std::vector<std::uint8_t> around(3 * shell.corners.size(), 0);
  for (const auto& corners : shell.cellCorners)
  {
    for (int e = 0; e < 12; ++e)
    {
      const std::uint32_t a = corners[edgeCorners[e][0]], b = corners[edgeCorners[e][1]];
      around[3 * std::size_t(a) + edgeAxis(e)] += inside[a] != inside[b];
    }
  }
  std::vector<std::uint64_t> missing;
  for (std::size_t edge = 0; edge < around.size(); ++edge)
  {
    if (around[edge] > 0 && around[edge] < 4)
    {
      addCellsAround(fromMorton(shell.corners[edge / 3]), int(edge % 3), lattice, missing);
    }
  }
  return missing;
}

double fractionOf(const CornerShell& shell, const CrossedEdge& edge, const SolidRows& rows)
{
  const LatticePoint a = fromMorton(shell.corners[edge.inside]), b = fromMorton(shell.corners[edge.outside]);
  const int axis = a.i != b.i ? 0 : a.j != b.j ? 1 : 2;
  const std::int32_t from = coordinateOf(a, axis);
  const RowInterval* interval = findInterval(rows[axis], rowKey(a, axis), from);
  const double t = !interval ? 0.0 : coordinateOf(b, axis) > from ? interval->to - from : from - interval->from;
  return std::clamp(t, CrossingMargin, 1.0 - CrossingMargin);
}

} // namespace

SolidRows combinedRows(const std::vector<LocalHull>& hulls, const SurfaceCrossings& surface, const Lattice& lattice,
  Execution& execution)
{
  std::vector<SolidRows> ofHull(hulls.size());
  execution.forRanges(hulls.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t h = first; h < last; ++h)
      {
        const Mesh local = inLatticeCoordinates(hulls[h].mesh, lattice);
        for (int axis = 0; axis < 3; ++axis)
        {
          ofHull[h][axis] = convexRows(local, axis, lattice);
        }
      }
    });
  execution.checkpoint(0.5);
  SolidRows rows;
  execution.forRanges(3, 1,
    [&](std::size_t first, std::size_t last)
    {
      for (int axis = int(first); axis < int(last); ++axis)
      {
        rows[axis] = surfaceRows(surface, axis);
        for (const auto& hull : ofHull)
        {
          rows[axis].insert(rows[axis].end(), hull[axis].begin(), hull[axis].end());
        }
        uniteRows(rows[axis]);
      }
    });
  execution.checkpoint(1.0);
  return rows;
}

CombinedSurface contourRows(const SolidRows& rows, const Lattice& lattice, Execution& execution)
{
  CombinedSurface combined;
  std::vector<std::uint64_t> cells = cellsAtEnds(rows, lattice);
  std::vector<std::uint8_t> inside;
  for (;;)
  {
    combined.shell = makeCornerShell(cells, execution);
    inside = labelCorners(combined.shell, rows, lattice, execution);
    const auto missing = missingCells(combined.shell, inside, lattice);
    if (missing.empty())
    {
      break;
    }
    cells.insert(cells.end(), missing.begin(), missing.end());
    sortUnique(cells);
  }
  execution.checkpoint(0.6);
  combined.surface = contour(combined.shell, inside, execution);
  combined.fractions.resize(combined.surface.edges.size());
  execution.forRanges(combined.fractions.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t e = first; e < last; ++e)
      {
        combined.fractions[e] = fractionOf(combined.shell, combined.surface.edges[e], rows);
      }
    });
  execution.checkpoint(1.0);
  return combined;
}

} // namespace silhouette
