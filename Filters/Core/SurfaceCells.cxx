// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceCells.h"

#include "FirstTouch.h"

namespace silhouette
{

std::vector<std::uint64_t> surfaceCells(const Mesh& surface, const Lattice& lattice, Execution& execution)
{
  constexpr std::uint64_t nowhere = ~std::uint64_t(0);
  const double cells = 1.0 / lattice.leafEdge(), last = lattice.cells() - 1;
  std::vector<std::uint64_t> codes;
  resizeSideBySide(codes, surface.points.size(), execution);
  execution.forRanges(codes.size(), 4096,
    [&](std::size_t first, std::size_t end)
    {
      for (std::size_t n = first; n < end; ++n)
      {
        const Eigen::Array3d x = (surface.points[n] - lattice.root.origin).array() * cells;
        if (x.isFinite().all())
        {
          const Eigen::Array3i c = x.max(0.0).min(last).cast<int>(); // cut off: none is negative
          codes[n] = mortonCode({ c[0], c[1], c[2] });
        }
        else
        {
          codes[n] = nowhere;
        }
      }
    });
  // Most come in the lattice's order.
  std::vector<std::uint64_t> inOrder, others;
  inOrder.reserve(codes.size());
  for (const std::uint64_t code : codes)
  {
    if (inOrder.empty() || code > inOrder.back())
    {
      inOrder.push_back(code);
    }
    else if (code != inOrder.back())
    {
      others.push_back(code);
    }
  }
  sortUnique(others);
  inOrder = united(inOrder, others);
  if (!inOrder.empty() && inOrder.back() == nowhere)
  {
    inOrder.pop_back();
  }
  return inOrder;
}

std::vector<std::uint64_t> coarserCells(const std::vector<std::uint64_t>& cells, int halvings)
{
  std::vector<std::uint64_t> coarser;
  for (const std::uint64_t cell : cells)
  {
    const std::uint64_t code = cell >> 3 * halvings;
    if (coarser.empty() || coarser.back() != code)
    {
      coarser.push_back(code);
    }
  }
  return coarser;
}

} // namespace silhouette
