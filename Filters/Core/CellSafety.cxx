// SPDX-License-Identifier: BSD-3-Clause
#include "CellSafety.h"

#include "FirstTouch.h"
#include "LargePages.h"
#include "TriangleIntersection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace silhouette
{
namespace
{

Eigen::Vector3d rounded(const Eigen::Vector3d& p, bool singlePrecision)
{
  return singlePrecision ? roundedToFloat(p) : p;
}

std::uint32_t cellBegin(const LatticeSurface& surface, std::size_t cell)
{
  return cell == 0 ? 0 : surface.cellEnd[cell - 1];
}

bool intersects(const LatticeSurface& surface, const Mesh& mesh, std::size_t cell)
{
  const std::uint32_t begin = cellBegin(surface, cell), end = surface.cellEnd[cell];
  for (std::uint32_t a = begin; a < end; ++a)
  {
    for (std::uint32_t b = a + 1; b < end; ++b)
    {
      if (trianglesIntersect(mesh.points, mesh.triangles[a], mesh.triangles[b]))
      {
        return true;
      }
    }
  }
  return false;
}

/** The shell's cells around the edge of a point. */
void appendCellsOf(const CornerShell& shell, const CrossedEdge& edge, std::vector<std::size_t>& cells)
{
  const LatticePoint a = fromMorton(shell.corners[edge.inside]), b = fromMorton(shell.corners[edge.outside]);
  const LatticePoint lower{ std::min(a.i, b.i), std::min(a.j, b.j), std::min(a.k, b.k) };
  for (int n = 0; n < 8; ++n)
  {
    const LatticePoint o = cornerOffset(n);
    const bool alongEdge = (o.i && a.i != b.i) || (o.j && a.j != b.j) || (o.k && a.k != b.k);
    const auto cell =
      alongEdge ? std::ptrdiff_t(-1) : shell.findCell({ lower.i - o.i, lower.j - o.j, lower.k - o.k });
    if (cell >= 0)
    {
      cells.push_back(std::size_t(cell));
    }
  }
}

} // namespace

void requireSinglePrecision(const Lattice& lattice)
{
  const Eigen::Vector3d far = lattice.root.origin + Eigen::Vector3d::Constant(lattice.root.edge);
  const double largest =
    std::max(lattice.root.origin.cwiseAbs().maxCoeff(), far.cwiseAbs().maxCoeff());
  const auto single = float(largest);
  const double spacing = double(std::nextafter(single, std::numeric_limits<float>::infinity())) - single;
  if (!(spacing * 1024.0 <= lattice.leafEdge()))
  {
    throw InvalidInput("single precision is too coarse for depth " + std::to_string(lattice.depth) +
      ": near coordinate " + std::to_string(largest) + " it resolves " + std::to_string(spacing / lattice.leafEdge()) +
      " of a leaf octant, 1/1024 is needed; write double precision, or move the origin nearer to the object");
  }
}

Mesh placePoints(const Lattice& lattice, const CornerShell& shell, const LatticeSurface& surface,
  const std::vector<double>& fractions, bool singlePrecision, Execution& execution)
{
  if (singlePrecision)
  {
    requireSinglePrecision(lattice);
  }
  Mesh mesh;
  resizeSideBySide(mesh.triangles, surface.triangles.size(), execution);
  execution.forRanges(mesh.triangles.size(), 16384,
    [&](std::size_t first, std::size_t last)
    {
      std::copy(surface.triangles.begin() + std::ptrdiff_t(first), surface.triangles.begin() + std::ptrdiff_t(last),
        mesh.triangles.begin() + std::ptrdiff_t(first));
    });
  resizeSideBySide(mesh.points, surface.edges.size(), execution);
  execution.forRanges(mesh.points.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t e = first; e < last; ++e)
      {
        mesh.points[e] = rounded(crossingPosition(lattice, shell, surface.edges[e], fractions[e]), singlePrecision);
      }
    });
  return mesh;
}

std::uint64_t removeCellIntersections(const Lattice& lattice, const CornerShell& shell,
  const LatticeSurface& surface, bool singlePrecision, Mesh& mesh, Execution& execution)
{
  auto bad = largeVector<std::uint8_t>(shell.cells.size());
  execution.forRanges(bad.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t cell = first; cell < last; ++cell)
      {
        bad[cell] = intersects(surface, mesh, cell);
      }
    });
  std::vector<std::size_t> suspects;
  for (std::size_t cell = 0; cell < bad.size(); ++cell)
  {
    if (bad[cell])
    {
      suspects.push_back(cell);
    }
  }
  std::vector<bool> moved(mesh.points.size(), false);
  std::uint64_t count = 0;
  while (!suspects.empty())
  {
    const std::size_t cell = suspects.back();
    suspects.pop_back();
    if (!intersects(surface, mesh, cell))
    {
      continue;
    }
    for (std::uint32_t t = cellBegin(surface, cell); t < surface.cellEnd[cell]; ++t)
    {
      for (const std::int32_t point : mesh.triangles[t])
      {
        if (!moved[point])
        {
          moved[point] = true;
          ++count;
          mesh.points[point] =
            rounded(crossingPosition(lattice, shell, surface.edges[point], 0.5), singlePrecision);
          appendCellsOf(shell, surface.edges[point], suspects);
        }
      }
    }
  }
  execution.checkpoint(1.0);
  return count;
}

} // namespace silhouette
