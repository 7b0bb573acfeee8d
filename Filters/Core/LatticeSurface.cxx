// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeSurface.h"

#include "FirstTouch.h"
#include "LargePages.h"
#include "LeastNumbers.h"
#include "MarchingCubesTable.h"
#include "NumberedCount.h"

#include <numeric>

namespace silhouette
{
namespace
{

unsigned caseOf(const std::array<std::uint32_t, 8>& corners, const std::vector<std::uint8_t>& inside)
{
  unsigned bits = 0;
  for (int c = 0; c < 8; ++c)
  {
    bits |= unsigned(inside[corners[c]] != 0) << c;
  }
  return bits;
}

/** Contours a shell. An edge is named by its lower corner and axis: 3 times the corner plus the axis. */
class Contourer
{
public:
  Contourer(const CornerShell& shell, const std::vector<std::uint8_t>& inside, Execution& execution)
    : Shell(shell)
    , Inside(inside)
    , Exec(execution)
    , EdgeCell(3 * shell.corners.size(), execution)
    , FirstEdge(shell.corners.size() + 1, 0)
  {
  }

  LatticeSurface contour()
  {
    this->findEdges();
    this->numberEdges();
    this->makeTriangles();
    return std::move(this->Surface);
  }

private:
  template <typename Work>
  void forEach(std::size_t count, const Work& work)
  {
    this->Exec.forRanges(count, 4096,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          work(i);
        }
      });
  }

  /** The cells' cases, where their triangles end, and which edges are crossed. */
  void findEdges()
  {
    const auto& table = marchingCubesTable();
    resizeLarge(this->Surface.cellCase, this->Shell.cells.size());
    resizeLarge(this->Surface.cellEnd, this->Shell.cells.size());
    this->forEach(this->Shell.cells.size(),
      [&](std::size_t cell)
      {
        const auto& corners = this->Shell.cellCorners[cell];
        const unsigned bits = caseOf(corners, this->Inside);
        this->Surface.cellCase[cell] = std::uint8_t(bits);
        this->Surface.cellEnd[cell] = std::uint32_t(table[bits].triangles.size());
        for (int e = 0; bits != 0 && bits != 255 && e < 12; ++e)
        {
          const auto& ends = edgeCorners[e];
          if (((bits >> ends[0] ^ bits >> ends[1]) & 1u) != 0)
          {
            this->EdgeCell.lower(3 * std::size_t(corners[ends[0]]) + edgeAxis(e), std::uint32_t(cell));
          }
        }
      });
    numberedCount(std::accumulate(this->Surface.cellEnd.begin(), this->Surface.cellEnd.end(), std::size_t(0)), "triangles");
    std::partial_sum(this->Surface.cellEnd.begin(), this->Surface.cellEnd.end(), this->Surface.cellEnd.begin());
  }

  bool crossed(std::size_t edge) const { return this->EdgeCell[edge] != LeastNumbers::None; }

  /** Number the edges in lattice order. */
  void numberEdges()
  {
    this->forEach(this->Shell.corners.size(),
      [&](std::size_t c)
      { this->FirstEdge[c + 1] = this->crossed(3 * c) + this->crossed(3 * c + 1) + this->crossed(3 * c + 2); });
    std::partial_sum(this->FirstEdge.begin(), this->FirstEdge.end(), this->FirstEdge.begin());
    resizeSideBySide(this->Surface.edges, this->FirstEdge.back(), this->Exec);
    this->forEach(this->Shell.corners.size(),
      [&](std::size_t c)
      {
        std::uint32_t at = this->FirstEdge[c];
        for (int axis = 0; at < this->FirstEdge[c + 1] && axis < 3; ++axis)
        {
          if (this->crossed(3 * c + axis))
          {
            this->Surface.edges[at++] = this->edge(std::uint32_t(c), axis);
          }
        }
      });
  }

  CrossedEdge edge(std::uint32_t lower, int axis) const
  {
    const std::uint32_t cell = this->EdgeCell[3 * std::size_t(lower) + axis];
    const auto& corners = this->Shell.cellCorners[cell];
    int e = 4 * axis;
    while (corners[edgeCorners[e][0]] != lower)
    {
      ++e;
    }
    const std::uint32_t upper = corners[edgeCorners[e][1]];
    return this->Inside[lower] ? CrossedEdge{ lower, upper, cell } : CrossedEdge{ upper, lower, cell };
  }

  std::uint32_t number(std::uint32_t lower, int axis) const
  {
    const std::size_t edge = 3 * std::size_t(lower);
    return this->FirstEdge[lower] + (axis > 0 && this->crossed(edge)) + (axis > 1 && this->crossed(edge + 1));
  }

  void makeTriangles()
  {
    const auto& table = marchingCubesTable();
    resizeSideBySide(
      this->Surface.triangles, this->Shell.cells.empty() ? 0 : this->Surface.cellEnd.back(), this->Exec);
    this->forEach(this->Shell.cells.size(),
      [&](std::size_t cell)
      {
        const auto& corners = this->Shell.cellCorners[cell];
        std::size_t at = cell == 0 ? 0 : this->Surface.cellEnd[cell - 1];
        for (const auto& triangle : table[this->Surface.cellCase[cell]].triangles)
        {
          for (int v = 0; v < 3; ++v)
          {
            const int e = triangle[v];
            this->Surface.triangles[at][v] = std::int32_t(this->number(corners[edgeCorners[e][0]], edgeAxis(e)));
          }
          ++at;
        }
      });
  }

  const CornerShell& Shell;
  const std::vector<std::uint8_t>& Inside;
  Execution& Exec;
  LatticeSurface Surface;
  LeastNumbers EdgeCell;                ///< for each edge that is crossed the first cell that has it
  std::vector<std::uint32_t> FirstEdge; ///< for each corner the number of the first edge of which it is the lower end
};

} // namespace

LatticeSurface contour(const CornerShell& shell, const std::vector<std::uint8_t>& inside, Execution& execution)
{
  return Contourer(shell, inside, execution).contour();
}

Eigen::Vector3d crossingPosition(const Lattice& lattice, const CornerShell& shell, const CrossedEdge& edge, double t)
{
  const LatticePoint a = fromMorton(shell.corners[edge.inside]);
  const LatticePoint b = fromMorton(shell.corners[edge.outside]);
  return { lattice.coordinate(0, a.i + t * (b.i - a.i)), lattice.coordinate(1, a.j + t * (b.j - a.j)),
    lattice.coordinate(2, a.k + t * (b.k - a.k)) };
}

} // namespace silhouette
