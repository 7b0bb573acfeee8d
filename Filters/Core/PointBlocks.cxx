// SPDX-License-Identifier: BSD-3-Clause
#include "PointBlocks.h"

#include "Bits.h"
#include "BlockSteps.h"

#include <algorithm>

namespace silhouette
{
namespace
{

struct Part
{
  BlockWord word;
};

/** The points that leave a block by a step on an axis, in the block there. */
template <typename Add>
void addBeyond(const BlockWord& block, int axis, bool ahead, const Add& add)
{
  const std::uint64_t there = ahead ? fromBehind(0, block.bits, axis) : fromAhead(0, block.bits, axis);
  std::uint64_t other = 0;
  if (there != 0 && besideBlock(block.block, axis, ahead, other))
  {
    add(Part{ { other, there } });
  }
}

/** What `forParts(block, add)` adds for all blocks, joined. */
template <typename ForParts>
std::vector<BlockWord> joinedParts(const std::vector<BlockWord>& blocks, const ForParts& forParts, Execution& execution)
{
  std::vector<Part> parts = collectParts<Part>(blocks.size(), [&](std::size_t n, const auto& add) { forParts(blocks[n], add); }, execution);
  // A step on any axis may carry into that axis's next bit, three above.
  const int bits = blocks.empty() ? 0 : highestBit(blocks.back().block | 1) + 1;
  return joinParts(parts, bits + 3, [](const Part&, std::size_t) {}, execution);
}

} // namespace

PointBlocks::PointBlocks(const std::vector<std::uint64_t>& points, Execution& execution)
  : Blocks(blockWords(points, blockStarts(points, execution), execution))
{
}

std::vector<std::uint64_t> PointBlocks::points(Execution& execution) const
{
  const auto forPoints = [&](std::size_t n, const auto& add)
  {
    forCodes(this->Blocks[n], add);
  };
  return collectParts<std::uint64_t>(this->Blocks.size(), forPoints, execution);
}

PointBlocks PointBlocks::spread(int axis, Execution& execution) const
{
  const auto forParts = [axis](const BlockWord& block, const auto& add)
  {
    add(Part{ { block.block, spreadInBlock(block.bits, axis) } });
    addBeyond(block, axis, true, add);
    addBeyond(block, axis, false, add);
  };
  PointBlocks result;
  result.Blocks = joinedParts(this->Blocks, forParts, execution);
  return result;
}

PointBlocks PointBlocks::spreadBehind(int axis, Execution& execution) const
{
  const auto forParts = [axis](const BlockWord& block, const auto& add)
  {
    add(Part{ { block.block, block.bits | fromAhead(block.bits, 0, axis) } });
    addBeyond(block, axis, false, add);
  };
  PointBlocks result;
  result.Blocks = joinedParts(this->Blocks, forParts, execution);
  return result;
}

PointBlocks PointBlocks::beside(const Lattice& lattice, Execution& execution) const
{
  const auto forParts = [](const BlockWord& block, const auto& add)
  {
    std::uint64_t within = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      within |= fromAhead(block.bits, 0, axis) | fromBehind(block.bits, 0, axis);
      addBeyond(block, axis, true, add);
      addBeyond(block, axis, false, add);
    }
    add(Part{ { block.block, within } });
  };
  PointBlocks result;
  result.Blocks = joinedParts(this->Blocks, forParts, execution);
  execution.forRanges(result.Blocks.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t b = first; b < last; ++b)
      {
        result.Blocks[b].bits &= withinLattice(lattice, result.Blocks[b].block);
      }
    });
  result.dropEmpty(execution);
  return result;
}

void PointBlocks::remove(const PointBlocks& other, Execution& execution)
{
  execution.forRanges(this->Blocks.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      auto at = std::lower_bound(other.Blocks.begin(), other.Blocks.end(), this->Blocks[first].block, [](const BlockWord& word, std::uint64_t block) { return word.block < block; });
      for (std::size_t b = first; b < last && at != other.Blocks.end(); ++b)
      {
        BlockWord& block = this->Blocks[b];
        while (at != other.Blocks.end() && at->block < block.block)
        {
          ++at;
        }
        if (at != other.Blocks.end() && at->block == block.block)
        {
          block.bits &= ~at->bits;
        }
      }
    });
  this->dropEmpty(execution);
}

void PointBlocks::remove(const GrowingPoints& other, Execution& execution)
{
  execution.forRanges(this->Blocks.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t b = first; b < last; ++b)
      {
        this->Blocks[b].bits &= ~other.ofBlock(this->Blocks[b].block);
      }
    });
  this->dropEmpty(execution);
}

void PointBlocks::dropEmpty(Execution& execution)
{
  this->Blocks = selected(
    this->Blocks.size(), [this](std::size_t b) { return this->Blocks[b].bits != 0; }, [this](std::size_t b) { return this->Blocks[b]; }, execution);
}

std::vector<std::uint64_t> cellsAround(std::vector<std::uint64_t> points, Execution& execution)
{
  if (!std::is_sorted(points.begin(), points.end()))
  {
    std::sort(points.begin(), points.end());
  }
  PointBlocks cells(points, execution);
  for (int axis = 0; axis < 3; ++axis)
  {
    cells = cells.spreadBehind(axis, execution);
  }
  return cells.points(execution);
}

} // namespace silhouette
