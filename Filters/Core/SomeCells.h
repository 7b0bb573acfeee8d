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
    std::array<std::ptrdiff_t, 8> found;
    bool any = false;
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint b = block + cornerOffset(n);
      found[std::size_t(n)] = std::min({ b.i, b.j, b.k }) < 0 ? -1 : this->Blocks.find(mortonCode(b));
      any = any || found[std::size_t(n)] >= 0;
    }
    constexpr unsigned spread[4] = { 0, 1, 8, 9 }; // the bits of a coordinate within a block, for the first axis
    for (int n = 0; n < 64 && any; ++n)
    {
      const LatticePoint q = lowest + LatticePoint{ n % 4, n / 4 % 4, n / 16 };
      const int beyond = ((q.i >> 2) - block.i) | ((q.j >> 2) - block.j) << 1 | ((q.k >> 2) - block.k) << 2;
      const std::ptrdiff_t at = found[std::size_t(beyond)];
      const std::uint64_t bit = std::uint64_t(1) << (spread[q.i & 3] | spread[q.j & 3] << 1 | spread[q.k & 3] << 2);
      if (at >= 0 && (this->Bits[std::size_t(at)] & bit) != 0)
      {
        work(this->Cells[this->First[std::size_t(at)] + std::size_t(countBits(this->Bits[std::size_t(at)] & (bit - 1)))]);
      }
    }
  }

private:
  const std::vector<std::uint32_t>& Cells;
  BlockIndex Blocks;                 ///< those with such cells
  std::vector<std::uint64_t> Bits;   ///< those of a block
  std::vector<std::uint32_t> First;  ///< of a block, among the cells
};

} // namespace silhouette
