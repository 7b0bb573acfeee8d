// SPDX-License-Identifier: BSD-3-Clause
#include "PointBlocks.h"

#include "Bits.h"
#include "BlockSteps.h"

#include <algorithm>

namespace silhouette
{
namespace
{

/** The points of a block that are the lattice's. */
std::uint64_t ofLattice(const Lattice& lattice, std::uint64_t block)
{
  const LatticePoint low = fromMorton(64 * block);
  if (isOfLattice(low + LatticePoint{ BlockSide - 1, BlockSide - 1, BlockSide - 1 }, lattice.cells()))
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

} // namespace

PointBlocks::PointBlocks(const std::vector<std::uint64_t>& points)
{
  for (const std::uint64_t point : points)
  {
    if (this->Blocks.empty() || this->Blocks.back().code != point >> 6)
    {
      this->Blocks.push_back({ point >> 6, 0 });
    }
    this->Blocks.back().points |= std::uint64_t(1) << (point & 63);
  }
}

std::vector<std::uint64_t> PointBlocks::points() const
{
  std::vector<std::uint64_t> points;
  for (const Block& block : this->Blocks)
  {
    for (std::uint64_t left = block.points; left != 0; left &= left - 1)
    {
      points.push_back(64 * block.code + std::uint64_t(lowestBit(left)));
    }
  }
  return points;
}

/** Of parts of blocks the first of which are ascending, no code twice; the others are sorted. */
PointBlocks PointBlocks::joined(std::vector<Block> within, std::vector<Block>& beyond)
{
  std::sort(beyond.begin(), beyond.end(), [](const Block& a, const Block& b) { return a.code < b.code; });
  PointBlocks result;
  for (auto own = within.begin(), other = beyond.begin(); own != within.end() || other != beyond.end();)
  {
    const std::uint64_t code = other == beyond.end() || (own != within.end() && own->code < other->code) ? own->code : other->code;
    Block block{ code, 0 };
    if (own != within.end() && own->code == code)
    {
      block.points = (own++)->points;
    }
    for (; other != beyond.end() && other->code == code; ++other)
    {
      block.points |= other->points;
    }
    if (block.points != 0)
    {
      result.Blocks.push_back(block);
    }
  }
  return result;
}

PointBlocks PointBlocks::spread(int axis) const
{
  std::vector<Block> within = this->Blocks, beyond;
  for (Block& block : within)
  {
    const std::uint64_t points = block.points;
    std::uint64_t other = 0;
    block.points = spreadInBlock(points, axis);
    for (const bool ahead : { true, false })
    {
      const std::uint64_t there = ahead ? fromBehind(0, points, axis) : fromAhead(0, points, axis);
      if (there != 0 && besideBlock(block.code, axis, ahead, other))
      {
        beyond.push_back({ other, there });
      }
    }
  }
  return joined(std::move(within), beyond);
}

PointBlocks PointBlocks::beside(const Lattice& lattice) const
{
  std::vector<Block> within = this->Blocks, beyond;
  for (Block& block : within)
  {
    const std::uint64_t points = block.points;
    block.points = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      block.points |= fromAhead(points, 0, axis) | fromBehind(points, 0, axis);
      for (const bool ahead : { true, false })
      {
        const std::uint64_t there = ahead ? fromBehind(0, points, axis) : fromAhead(0, points, axis);
        std::uint64_t other = 0;
        if (there != 0 && besideBlock(block.code, axis, ahead, other))
        {
          beyond.push_back({ other, there });
        }
      }
    }
  }
  PointBlocks result = joined(std::move(within), beyond);
  for (Block& block : result.Blocks)
  {
    block.points &= ofLattice(lattice, block.code);
  }
  result.dropEmpty();
  return result;
}

void PointBlocks::remove(const PointBlocks& other)
{
  auto at = other.Blocks.begin();
  for (Block& block : this->Blocks)
  {
    while (at != other.Blocks.end() && at->code < block.code)
    {
      ++at;
    }
    if (at != other.Blocks.end() && at->code == block.code)
    {
      block.points &= ~at->points;
    }
  }
  this->dropEmpty();
}

void PointBlocks::dropEmpty()
{
  this->Blocks.erase(std::remove_if(this->Blocks.begin(), this->Blocks.end(), [](const Block& b) { return b.points == 0; }),
    this->Blocks.end());
}

} // namespace silhouette
