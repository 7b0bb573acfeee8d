// SPDX-License-Identifier: BSD-3-Clause
/**
 * A sparse set of leaf cells with their corners, both in Morton order: what surfaces are made on. Corners are
 * shared by sorting the codes of blocks of 4 x 4 x 4 lattice points, a word of bits each.
 */
#pragma once

#include "Execution.h"
#include "Lattice.h"
#include "Octree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Indices of a cell's corners, by their numbers; of any value until they are written, so that memory of many is not. */
struct CellCorners : std::array<std::uint32_t, 8>
{
  CellCorners() {}
};

struct CornerShell
{
  std::vector<std::uint64_t> cells;     ///< Morton codes of leaf cells, ascending
  std::vector<std::uint64_t> corners;   ///< Morton codes of their corners, ascending
  std::vector<CellCorners> cellCorners; ///< for each cell

  /** Index of a corner, or -1. Cost: a binary search; for many near one another see CodeCursor. */
  std::ptrdiff_t find(std::uint64_t corner) const;
  /** Index of a cell, or -1; its coordinates may lie outside the lattice. Cost: a binary search. */
  std::ptrdiff_t findCell(const LatticePoint& cell) const;
};

/** The shell of the given cells (ascending, no code twice). Throws InvalidInput where they have more than 2^31 - 1 corners. Cost: O(n). */
CornerShell makeCornerShell(std::vector<std::uint64_t> cells, Execution& execution);

/**
 * The same as of the shell's cells and others (ascending, no code twice), some of which may be the shell's. Cost: linear, but a third of making it anew
 * where these are few.
 */
CornerShell withCells(const CornerShell& shell, const std::vector<std::uint64_t>& others, Execution& execution);

/** Codes of the octree's last-generation octants of one state, ascending; without an execution on this thread. */
std::vector<std::uint64_t> leafCells(const Octree& octree, OctantState state, Execution& execution);
std::vector<std::uint64_t> leafCells(const Octree& octree, OctantState state);

} // namespace silhouette
