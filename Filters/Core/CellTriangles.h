// SPDX-License-Identifier: BSD-3-Clause
/**
 * The triangles of some of a shell's cells, each of which lies in its cell, but for rounding.
 */
#pragma once

#include "CodeCursor.h"
#include "IndicesWhere.h"
#include "LatticeSurface.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** Shell and surface, which was contoured on it, are not copied and have to outlive this. */
class CellTriangles
{
public:
  CellTriangles(const CornerShell& shell, const LatticeSurface& surface)
    : Shell(shell)
    , Surface(surface)
  {
  }

  /** Of the shell's cells among those of these Morton codes, ascending; so are the triangles. Cost: finding them. */
  std::vector<std::int32_t> ofCells(const std::vector<std::uint64_t>& codes) const
  {
    std::vector<std::int32_t> triangles;
    CodeCursor cells(this->Shell.cells);
    for (const std::uint64_t code : codes)
    {
      const std::ptrdiff_t cell = cells.find(code);
      if (cell >= 0)
      {
        this->append(std::size_t(cell), triangles);
      }
    }
    return triangles;
  }

  /** Of the cells whose rows along x are marked in `rows`, which has a value for each row, those along y one after another; ascending. Cost: a pass over the cells. */
  std::vector<std::int32_t> inRows(const std::vector<std::uint8_t>& rows, const Lattice& lattice, Execution& execution) const
  {
    std::vector<std::int32_t> triangles;
    const auto isMarked = [&](std::size_t cell)
    {
      const LatticePoint p = fromMorton(this->Shell.cells[cell]);
      return rows[std::size_t(p.k) * std::size_t(lattice.cells()) + std::size_t(p.j)] != 0;
    };
    for (const std::int32_t cell : indicesWhere(this->Shell.cells.size(), 4096, execution, isMarked))
    {
      this->append(std::size_t(cell), triangles);
    }
    return triangles;
  }

private:
  void append(std::size_t cell, std::vector<std::int32_t>& triangles) const
  {
    for (std::uint32_t t = cell == 0 ? 0 : this->Surface.cellEnd[cell - 1]; t < this->Surface.cellEnd[cell]; ++t)
    {
      triangles.push_back(std::int32_t(t));
    }
  }

  const CornerShell& Shell;
  const LatticeSurface& Surface;
};

} // namespace silhouette
