// SPDX-License-Identifier: BSD-3-Clause
#include "PointBlocks.h"

#include "Bits.h"
#include "BlockBits.h"

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

PointBlocks PointBlocks::beside(const Lattice& lattice) const
{
  std::vector<Block> parts;
  const auto add = [&](std::uint64_t code, std::uint64_t points)
  {
    if (points != 0)
    {
      parts.push_back({ code, points });
    }
  };
  for (const Block& block : this->Blocks)
  {
    std::uint64_t within = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      within |= fromAhead(block.points, 0, axis) | fromBehind(block.points, 0, axis);
      std::uint64_t other = 0;
      besideBlock(block.code, axis, true, other);
      add(other, fromBehind(0, block.points, axis));
      if (besideBlock(block.code, axis, false, other))
      {
        add(other, fromAhead(0, block.points, axis));
      }
    }
    add(block.code, within);
  }
  std::sort(parts.begin(), parts.end(), [](const Block& a, const Block& b) { return a.code < b.code; });
  PointBlocks result;
  for (std::size_t n = 0; n < parts.size();)
  {
    Block block{ parts[n].code, 0 };
    for (; n < parts.size() && parts[n].code == block.code; ++n)
    {
      block.points |= parts[n].points;
    }
    block.points &= ofLattice(lattice, block.code);
    if (block.points != 0)
    {
      result.Blocks.push_back(block);
    }
  }
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
  this->Blocks.erase(std::remove_if(this->Blocks.begin(), this->Blocks.end(), [](const Block& b) { return b.points == 0; }),
    this->Blocks.end());
}

} // namespace silhouette
