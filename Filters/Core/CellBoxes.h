// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which leaf cells do boxes meet?
 */
#pragma once

#include "BoxTree.h"
#include "Lattice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** The leaf cells that a box meets, and one around them for rounding. */
struct CellBox
{
  std::array<std::int32_t, 3> first{}, last{};

  CellBox(const Lattice& lattice, const Box& box)
  {
    const double greatest = lattice.cells() - 1, cells = 1.0 / lattice.leafEdge();
    for (int axis = 0; axis < 3; ++axis)
    {
      // Cutting off what is not negative: floor would be a call.
      const auto cellOf = [&](double x, double beside)
      { return std::int32_t(std::clamp((x - lattice.root.origin[axis]) * cells + beside, 0.0, greatest)); };
      this->first[axis] = cellOf(box.min()[axis], -1.0);
      this->last[axis] = cellOf(box.max()[axis], 1.0);
    }
  }
};

/** The Morton codes, ascending, of the cells of all boxes' CellBox. Cost: n log n in these; boxes that are listed near one another should lie so, too. */
inline std::vector<std::uint64_t> cellsMet(const Lattice& lattice, const std::vector<Box>& boxes)
{
  constexpr std::size_t Together = 1024; // boxes whose cells are sorted at a time: most of them are those of several
  std::vector<std::uint64_t> cells;
  std::ptrdiff_t sorted = 0;
  for (std::size_t n = 0; n < boxes.size(); ++n)
  {
    if (n % Together == 0)
    {
      std::sort(cells.begin() + sorted, cells.end());
      cells.erase(std::unique(cells.begin() + sorted, cells.end()), cells.end());
      sorted = std::ptrdiff_t(cells.size());
    }
    const CellBox range(lattice, boxes[n]);
    for (std::int32_t k = range.first[2]; k <= range.last[2]; ++k)
    {
      for (std::int32_t j = range.first[1]; j <= range.last[1]; ++j)
      {
        for (std::int32_t i = range.first[0]; i <= range.last[0]; ++i)
        {
          cells.push_back(mortonCode({ i, j, k }));
        }
      }
    }
  }
  sortUnique(cells);
  return cells;
}

} // namespace silhouette
