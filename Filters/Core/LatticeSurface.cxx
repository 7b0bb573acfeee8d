// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeSurface.h"

#include "MarchingCubesTable.h"

#include <algorithm>

namespace silhouette
{
namespace
{

constexpr std::uint32_t None = 0xffffffffu;

unsigned caseOf(const std::array<std::uint32_t, 8>& corners, const std::vector<std::uint8_t>& inside)
{
  unsigned bits = 0;
  for (int c = 0; c < 8; ++c)
  {
    bits |= unsigned(inside[corners[c]] != 0) << c;
  }
  return bits;
}

} // namespace

LatticeSurface contour(const CornerShell& shell, const std::vector<std::uint8_t>& inside, Execution& execution)
{
  const auto& table = marchingCubesTable();
  const std::size_t cells = shell.cells.size();
  LatticeSurface surface;
  surface.cellEnd.resize(cells);

  // An edge is named by its lower corner and axis. First the upper corners of the crossed ones, ...
  std::vector<std::uint32_t> upper(3 * shell.corners.size(), None);
  std::uint32_t triangles = 0;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    const auto& corners = shell.cellCorners[cell];
    const unsigned bits = caseOf(corners, inside);
    triangles += std::uint32_t(table[bits].triangles.size());
    surface.cellEnd[cell] = triangles;
    if (bits == 0 || bits == 255)
    {
      continue;
    }
    for (int e = 0; e < 12; ++e)
    {
      const auto& ends = edgeCorners[e];
      if ((bits >> ends[0] & 1u) != (bits >> ends[1] & 1u))
      {
        upper[3 * std::size_t(corners[ends[0]]) + edgeAxis(e)] = corners[ends[1]];
      }
    }
  }
  // ... then their numbers, in lattice order, ...
  std::vector<std::uint32_t> number(upper.size(), None);
  for (std::size_t edge = 0; edge < upper.size(); ++edge)
  {
    if (upper[edge] != None)
    {
      number[edge] = std::uint32_t(surface.edges.size());
      const auto lower = std::uint32_t(edge / 3);
      surface.edges.push_back(
        inside[lower] ? CrossedEdge{ lower, upper[edge] } : CrossedEdge{ upper[edge], lower });
    }
  }
  // ... then the triangles, each cell at its own place.
  surface.triangles.resize(triangles);
  execution.forRanges(cells, 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t cell = first; cell < last; ++cell)
      {
        const auto& corners = shell.cellCorners[cell];
        std::size_t at = cell == 0 ? 0 : surface.cellEnd[cell - 1];
        for (const auto& triangle : table[caseOf(corners, inside)].triangles)
        {
          for (int v = 0; v < 3; ++v)
          {
            const int e = triangle[v];
            surface.triangles[at][v] =
              std::int32_t(number[3 * std::size_t(corners[edgeCorners[e][0]]) + edgeAxis(e)]);
          }
          ++at;
        }
      }
    });
  return surface;
}

Eigen::Vector3d crossingPosition(const Lattice& lattice, const CornerShell& shell, const CrossedEdge& edge, double t)
{
  const LatticePoint a = fromMorton(shell.corners[edge.inside]);
  const LatticePoint b = fromMorton(shell.corners[edge.outside]);
  return { lattice.coordinate(0, a.i + t * (b.i - a.i)), lattice.coordinate(1, a.j + t * (b.j - a.j)),
    lattice.coordinate(2, a.k + t * (b.k - a.k)) };
}

} // namespace silhouette
