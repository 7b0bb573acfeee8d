// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where the outside of a solid is narrow: no cube of outside points of a given width fits. Few points are.
 */
#pragma once

#include "BlockIndex.h"
#include "LatticeLabels.h"

#include <array>
#include <vector>

namespace silhouette
{

/** The outside around a solid, by words of bits for the blocks of 4 x 4 x 4 lattice points near its surface. */
class NarrowOutside
{
public:
  enum class Label : std::uint8_t
  {
    Solid,
    Wide,  ///< outside, and a cube fits
    Narrow ///< outside, and none does
  };

  /**
   * `width`: octants, 1 or more, along an edge of the cubes. The labels have to outlive this, and their shell to hold each cell with corners of both
   * labels. A cube that begins below the lattice is taken to fit, so that a point less than `width` from there is wide. Cost: linear in the lattice
   * points within some `width` octants of the surface, a word for 64 of them.
   */
  NarrowOutside(const LatticeLabels& labels, int width, Execution& execution);

  /** Morton codes of the narrow points, ascending. */
  const std::vector<std::uint64_t>& points() const { return this->Points; }
  /** Morton codes, ascending, of the blocks of 4 x 4 x 4 points outside of which no point is narrow. */
  const std::vector<std::uint64_t>& blocks() const { return this->Blocks.codes(); }
  /** The wide points of many blocks, ascending: of each a bit each, the lowest for the point of Morton code 64 `block`. */
  std::vector<std::uint64_t> wideOfBlocks(const std::vector<std::uint64_t>& blocks, Execution& execution) const;

private:
  friend class NarrowCursor;

  void openByCubes(int width, Execution& execution);
  std::vector<std::uint32_t> blocksBeside(int axis, bool ahead, Execution& execution) const;
  void findPoints(const std::vector<std::uint64_t>& opened);

  const LatticeLabels* Labels;
  BlockIndex Blocks;
  std::vector<std::uint64_t> Free;   ///< of each, its outside points
  std::vector<std::uint64_t> Narrow; ///< of these, the narrow ones
  std::vector<std::uint32_t> FirstPoint; ///< of each block, the number of the first of its narrow points
  std::vector<std::uint64_t> Points;
};

/**
 * Asks about points near one another: the blocks found last are remembered, 64: a block and all around it have places of their own. Not for several
 * threads at once. What it asks has to outlive it. Cost: finding each block that is not remembered.
 */
class NarrowCursor
{
public:
  explicit NarrowCursor(const NarrowOutside& outside)
    : Outside(&outside)
  {
    this->Blocks.fill(~std::uint64_t(0));
  }

  /** Of any lattice point. */
  NarrowOutside::Label at(const LatticePoint& p) const;
  /** Index of a narrow point, or -1. Its coordinates may lie outside the lattice. */
  std::ptrdiff_t find(const LatticePoint& p) const;
  /** The same of a point with coordinates of 0 and more, by its Morton code. */
  NarrowOutside::Label at(std::uint64_t code) const;
  std::ptrdiff_t find(std::uint64_t code) const;

private:
  std::ptrdiff_t placeOf(std::uint64_t block) const
  {
    const std::size_t slot = block % this->Blocks.size(); // by its coordinates' two lowest bits
    if (this->Blocks[slot] != block)
    {
      this->Blocks[slot] = block;
      this->Places[slot] = this->Outside->Blocks.find(block);
    }
    return this->Places[slot];
  }

  const NarrowOutside* Outside;
  mutable std::array<std::uint64_t, 64> Blocks;
  mutable std::array<std::ptrdiff_t, 64> Places{};
};

} // namespace silhouette
