// SPDX-License-Identifier: BSD-3-Clause
/**
 * Some cells of a shell, to be found around a lattice point.
 */
#pragma once

#include "BlockBits.h"
#include "BlockIndex.h"
#include "CornerShell.h"

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** By blocks of 4 x 4 x 4 cells. The numbers are not copied and have to outlive it. */
class SomeCells
{
public:
  /** `cells`: numbers among the shell's, ascending. */
  SomeCells(const CornerShell& shell, const std::vector<std::uint32_t>& cells)
    : Cells(cells)
  {
    std::vector<std::uint64_t> blocks;
    for (std::uint32_t n = 0; n < cells.size(); ++n)
    {
      const std::uint64_t code = shell.cells[cells[n]];
      if (blocks.empty() || blocks.back() != code >> 6)
      {
        blocks.push_back(code >> 6);
        this->Bits.push_back(0);
        this->First.push_back(n);
      }
      this->Bits.back() |= std::uint64_t(1) << (code & 63);
    }
    this->Blocks = BlockIndex(std::move(blocks));
  }

  /** Call `work(cell)` for those of the 4 x 4 x 4 cells around a point, in the order of their last, middle and first coordinate.
   * Cost: finding eight blocks. */
  template <typename Work> void forCellsAround(const LatticePoint& p, const Work& work) const
  {
    const LatticePoint lowest{ p.i - BlockSide / 2, p.j - BlockSide / 2, p.k - BlockSide / 2 };
    const LatticePoint block{ lowest.i >> 2, lowest.j >> 2, lowest.k >> 2 };
    const int offsets[3] = { lowest.i & 3, lowest.j & 3, lowest.k & 3 };
    std::array<std::uint32_t, 64> inOrder;
    std::uint64_t found = 0; // of these, a bit each
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint b = block + cornerOffset(n);
      const std::ptrdiff_t at = std::min({ b.i, b.j, b.k }) < 0 ? -1 : this->Blocks.find(mortonCode(b));
      if (at < 0)
      {
        continue;
      }
      const std::uint64_t all = this->Bits[std::size_t(at)];
      std::uint64_t left = all;
      for (int axis = 0; axis < 3; ++axis)
      {
        const std::uint64_t from = pointsFrom(axis, offsets[axis]);
        left &= (n >> axis & 1) == 0 ? from : ~from;
      }
      for (; left != 0; left &= left - 1)
      {
        const LatticePoint q = fromMorton(64 * mortonCode(b) + std::uint64_t(lowestBit(left)));
        const int place = (q.i - lowest.i) + 4 * (q.j - lowest.j) + 16 * (q.k - lowest.k);
        inOrder[std::size_t(place)] = this->Cells[this->First[std::size_t(at)] + std::size_t(countBits(all & ((left & (0 - left)) - 1)))];
        found |= std::uint64_t(1) << place;
      }
    }
    for (; found != 0; found &= found - 1)
    {
      work(inOrder[std::size_t(lowestBit(found))]);
    }
  }

private:
  /** The points of a block whose coordinate on an axis is `value`, 0 to 3 within it, or more. */
  static std::uint64_t pointsFrom(int axis, int value)
  {
    static constexpr std::uint64_t points[3][4] = {
      { ~std::uint64_t(0), ~blockSlab(0, 0), blockSlab(0, 2) | blockSlab(0, 3), blockSlab(0, 3) },
      { ~std::uint64_t(0), ~blockSlab(1, 0), blockSlab(1, 2) | blockSlab(1, 3), blockSlab(1, 3) },
      { ~std::uint64_t(0), ~blockSlab(2, 0), blockSlab(2, 2) | blockSlab(2, 3), blockSlab(2, 3) },
    };
    return points[axis][value];
  }

  const std::vector<std::uint32_t>& Cells;
  BlockIndex Blocks;                 ///< those with such cells
  std::vector<std::uint64_t> Bits;   ///< those of a block
  std::vector<std::uint32_t> First;  ///< of a block, among the cells
};

} // namespace silhouette
