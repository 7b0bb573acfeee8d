// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sets of the lattice points of a block of 4 x 4 x 4, a bit each in Morton order: bit n is the point of code 64 `block` + n.
 */
#pragma once

#include "Lattice.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

constexpr int BlockSide = 4;

/** The points of a block whose coordinate on `axis`, 0 to 3 within it, is `value`. */
constexpr std::uint64_t blockSlab(int axis, int value)
{
  std::uint64_t bits = 0;
  for (int n = 0; n < 64; ++n)
  {
    bits |= std::uint64_t(((n >> axis & 1) | (n >> (axis + 3) & 1) << 1) == value) << n;
  }
  return bits;
}

namespace block_bits
{
inline constexpr std::uint64_t Even[3] = { blockSlab(0, 0) | blockSlab(0, 2), blockSlab(1, 0) | blockSlab(1, 2),
  blockSlab(2, 0) | blockSlab(2, 2) };
inline constexpr std::uint64_t Odd[3] = { blockSlab(0, 1), blockSlab(1, 1), blockSlab(2, 1) };
inline constexpr std::uint64_t Low[3] = { blockSlab(0, 0), blockSlab(1, 0), blockSlab(2, 0) };
inline constexpr std::uint64_t High[3] = { blockSlab(0, 3), blockSlab(1, 3), blockSlab(2, 3) };
}

/** Each point gets the bit of the point one step ahead on an axis; `beyond` is the block there. */
inline std::uint64_t fromAhead(std::uint64_t bits, std::uint64_t beyond, int axis)
{
  const int unit = 1 << axis;
  return (bits >> unit & block_bits::Even[axis]) | (bits >> 7 * unit & block_bits::Odd[axis]) |
    (beyond & block_bits::Low[axis]) << 9 * unit;
}

/** Each point gets the bit of the point one step behind on an axis; `beyond` is the block there. */
inline std::uint64_t fromBehind(std::uint64_t bits, std::uint64_t beyond, int axis)
{
  const int unit = 1 << axis;
  return (bits & block_bits::Even[axis]) << unit | (bits & block_bits::Odd[axis]) << 7 * unit |
    (beyond & block_bits::High[axis]) >> 9 * unit;
}

/** The points of a block whose values, 64 in Morton order, are positive. */
inline std::uint64_t positiveBits(const float* values)
{
  std::uint64_t bits = 0;
  for (int n = 0; n < 64; ++n)
  {
    bits |= std::uint64_t(values[n] > 0.0f) << n;
  }
  return bits;
}

/** The block one step ahead, or with `ahead` false behind, on an axis; false where a coordinate would be negative. */
inline bool besideBlock(std::uint64_t block, int axis, bool ahead, std::uint64_t& other)
{
  const std::uint64_t mine = 0x1249249249249249ULL << axis;
  const std::uint64_t along = ahead ? (block | ~mine) + 1 : (block & mine) - 1;
  other = (along & mine) | (block & ~mine);
  return ahead || (block & mine) != 0;
}

/** For each n of 0 to 7: which points of a block have a cell at the point less cornerOffset(n). `cellsOf(block)`: the cells of a block. */
template <typename CellsOf> std::array<std::uint64_t, 8> cellsBehind(std::uint64_t block, const CellsOf& cellsOf)
{
  std::array<std::uint64_t, 8> words{}; // of the block and those behind it on the axes of n
  for (unsigned n = 0; n < 8; ++n)
  {
    std::uint64_t other = block;
    bool exists = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      exists = exists && ((n >> axis & 1) == 0 || besideBlock(other, axis, false, other));
    }
    words[n] = exists ? cellsOf(other) : 0;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (unsigned n = 0; n < 8; ++n)
    {
      if (n >> axis & 1)
      {
        words[n] = fromBehind(words[n ^ 1u << axis], words[n], axis);
      }
    }
  }
  return words;
}

/**
 * From the points of a block and of those ahead of it on the axes of their numbers, 0 to 7: for each n which points of the block have one of these at the point plus
 * cornerOffset(n), as cells have corners.
 */
inline void bringCorners(std::array<std::uint64_t, 8>& words)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (unsigned n = 0; n < 8; ++n)
    {
      if (n >> axis & 1)
      {
        words[n] = fromAhead(words[n ^ 1u << axis], words[n], axis);
      }
    }
  }
}

/** The points of a block that are corners of cells. */
template <typename CellsOf> std::uint64_t pointsTouching(std::uint64_t block, const CellsOf& cellsOf)
{
  std::uint64_t points = 0;
  for (const std::uint64_t cells : cellsBehind(block, cellsOf))
  {
    points |= cells;
  }
  return points;
}

/** Has a block, given by its lowest point, points on the root cube's border? */
inline bool touchesBorder(const Lattice& lattice, const LatticePoint& lowest)
{
  return lattice.onBorder(lowest) || lattice.onBorder(lowest + LatticePoint{ BlockSide - 1, BlockSide - 1, BlockSide - 1 });
}

/** The points of a block that are the lattice's. */
inline std::uint64_t withinLattice(const Lattice& lattice, std::uint64_t block)
{
  const LatticePoint lowest = fromMorton(64 * block);
  if (isOfLattice(lowest + LatticePoint{ BlockSide - 1, BlockSide - 1, BlockSide - 1 }, lattice.cells()))
  {
    return ~std::uint64_t(0);
  }
  std::uint64_t within = 0;
  for (std::uint64_t n = 0; n < 64; ++n)
  {
    within |= std::uint64_t(isOfLattice(fromMorton(64 * block + n), lattice.cells())) << n;
  }
  return within;
}

/** The points of a block that lie within the root cube and not on its border. */
inline std::uint64_t withinBorder(const Lattice& lattice, std::uint64_t block)
{
  if (!touchesBorder(lattice, fromMorton(64 * block)))
  {
    return ~std::uint64_t(0);
  }
  std::uint64_t within = 0;
  for (std::uint64_t n = 0; n < 64; ++n)
  {
    within |= std::uint64_t(!lattice.onBorder(fromMorton(64 * block + n))) << n;
  }
  return within;
}

} // namespace silhouette
