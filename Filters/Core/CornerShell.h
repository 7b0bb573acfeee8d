// SPDX-License-Identifier: BSD-3-Clause
/**
 * A sparse set of leaf cells with their corners, both in Morton order: what surfaces are made on. Corners are
 * shared by sorting the codes of blocks of 4 x 4 x 4 lattice points, a word of bits each.
 */
#pragma once

#include "Bits.h"
#include "Execution.h"
#include "Lattice.h"
#include "Octree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

struct CornerShell
{
  std::vector<std::uint64_t> cells;                     ///< Morton codes of leaf cells, ascending
  std::vector<std::uint64_t> corners;                   ///< Morton codes of their corners, ascending
  std::vector<std::array<std::uint32_t, 8>> cellCorners; ///< for each cell the indices of its corners

  /** Index of a corner, or -1. Cost: a binary search. */
  std::ptrdiff_t find(std::uint64_t corner) const;
  /** Index of a cell, or -1; its coordinates may lie outside the lattice. Cost: a binary search. */
  std::ptrdiff_t findCell(const LatticePoint& cell) const;
};

/**
 * CornerShell::find() for corners near one another: blocks of 4 x 4 x 4 points found last are remembered, eight, as many as meet
 * in a point. Not for several threads at once. The shell has to outlive it.
 */
class ShellCursor
{
public:
  explicit ShellCursor(const CornerShell& shell)
    : Shell(&shell)
  {
  }

  std::ptrdiff_t find(std::uint64_t corner)
  {
    Block& block = this->Blocks[(corner >> 6) % this->Blocks.size()]; // the oddness of its coordinates: neighbours have other slots
    if (block.code != corner >> 6)
    {
      this->read(corner >> 6, block);
    }
    const std::uint64_t bit = std::uint64_t(1) << (corner & 63);
    return (block.corners & bit) != 0 ? std::ptrdiff_t(block.first) + countBits(block.corners & (bit - 1)) : -1;
  }

private:
  struct Block
  {
    std::uint64_t code = ~std::uint64_t(0); ///< no block's
    std::uint64_t corners = 0;              ///< those of the shell, a bit each
    std::size_t first = 0;                  ///< index of the first of them
  };

  void read(std::uint64_t code, Block& block) const;

  const CornerShell* Shell;
  std::array<Block, 8> Blocks;
};

/** The shell of the given cells (ascending, no code twice). Cost: O(n). */
CornerShell makeCornerShell(std::vector<std::uint64_t> cells, Execution& execution);

/** Codes of the octree's last-generation octants of one state. */
std::vector<std::uint64_t> leafCells(const Octree& octree, OctantState state);

} // namespace silhouette
