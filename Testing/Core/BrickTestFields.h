// SPDX-License-Identifier: BSD-3-Clause
/**
 * Fields in bricks, filled at will, for the tests of fields.
 */
#pragma once

#include "BrickField.h"
#include "View.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace silhouette::test
{

inline Lattice latticeOf(int depth)
{
  return { { Vector3(-1.1, -0.9, -1.0), 2.0 }, depth };
}

inline std::vector<std::uint64_t> allCells(const Lattice& lattice)
{
  std::vector<std::uint64_t> cells(std::size_t(1) << 3 * lattice.depth);
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    cells[c] = c;
  }
  return cells;
}

inline void fill(BrickField& field, const std::function<double(const LatticePoint&)>& value)
{
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    field.values()[n] = float(value(fromMorton(field.code(n))));
  }
}

/** Those of some cells all of whose corners have values, none of them a positive one. */
inline std::vector<std::uint64_t> cellsOutside(const BrickField& field, const std::vector<std::uint64_t>& cells)
{
  std::vector<std::uint64_t> outside;
  for (const std::uint64_t cell : cells)
  {
    bool isOutside = true;
    for (int corner = 0; corner < 8; ++corner)
    {
      const std::ptrdiff_t at = field.find(mortonCode(fromMorton(cell) + cornerOffset(corner)));
      isOutside = isOutside && at >= 0 && field.values()[std::size_t(at)] <= 0.0f;
    }
    if (isOutside)
    {
      outside.push_back(cell);
    }
  }
  return outside;
}

} // namespace silhouette::test
