// SPDX-License-Identifier: BSD-3-Clause
/**
 * A set of lattice points, kept by blocks of 4 x 4 x 4: neighbours are found for 64 points at a time.
 */
#pragma once

#include "Lattice.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

class PointBlocks
{
public:
  PointBlocks() = default;
  /** `points`: Morton codes, ascending. */
  explicit PointBlocks(const std::vector<std::uint64_t>& points);

  bool empty() const { return this->Blocks.empty(); }
  /** Morton codes of the points, ascending. */
  std::vector<std::uint64_t> points() const;
  /** The lattice's points one step along a lattice edge from one of these, among them such as are in this set. Cost: n log n in the blocks. */
  PointBlocks beside(const Lattice& lattice) const;
  /** These points and those one step before and behind on an axis, none of which is negative. Cost: as beside(). */
  PointBlocks spread(int axis) const;
  /** Take the other set's points out. Cost: linear in the blocks. */
  void remove(const PointBlocks& other);

private:
  struct Block
  {
    std::uint64_t code;
    std::uint64_t points; ///< a bit each, not none
  };

  void dropEmpty();
  static PointBlocks joined(std::vector<Block> within, std::vector<Block>& beyond);

  std::vector<Block> Blocks; ///< ascending
};

} // namespace silhouette
