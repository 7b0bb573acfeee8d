// SPDX-License-Identifier: BSD-3-Clause
#include "NarrowOutside.h"

#include "Bits.h"
#include "BlockBits.h"
#include "PointBlocks.h"

#include <algorithm>

namespace silhouette
{
namespace
{

constexpr std::uint32_t Nowhere = 0xffffffffu;

/** Blocks that hold cells with corners of both labels, ascending. */
std::vector<std::uint64_t> mixedBlocks(const LatticeLabels& labels, Execution& execution)
{
  constexpr std::size_t RangeSize = 1 << 14; // cells
  const auto& shell = labels.shell();
  std::vector<std::vector<std::uint64_t>> ofRanges((shell.cells.size() + RangeSize - 1) / RangeSize);
  execution.forRanges(ofRanges.size(), 1,
    [&](std::size_t firstRange, std::size_t lastRange)
    {
      for (std::size_t cell = firstRange * RangeSize; cell < std::min(lastRange * RangeSize, shell.cells.size()); ++cell)
      {
        std::vector<std::uint64_t>& blocks = ofRanges[cell / RangeSize];
        const std::uint64_t block = shell.cells[cell] >> 6;
        if (!blocks.empty() && blocks.back() == block)
        {
          continue;
        }
        const auto& corners = shell.cellCorners[cell];
        const std::uint8_t first = labels.inside()[corners[0]];
        if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return labels.inside()[c] != first; }))
        {
          blocks.push_back(block);
        }
      }
    });
  std::vector<std::uint64_t> blocks;
  for (const auto& some : ofRanges)
  {
    const bool isKnown = !some.empty() && !blocks.empty() && blocks.back() == some.front();
    blocks.insert(blocks.end(), some.begin() + isKnown, some.end());
  }
  return blocks;
}

/**
 * All blocks with points within `width` octants of a cell of the given blocks. From an outside point elsewhere no cell with corners of both labels is
 * within a cube's reach: there it is wide.
 */
std::vector<std::uint64_t> blocksNear(const std::vector<std::uint64_t>& blocks, int width, Execution& execution)
{
  const int reach = 1 + width / BlockSide;
  PointBlocks near(blocks, execution);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int step = 0; step < reach; ++step)
    {
      near = near.spread(axis, execution);
    }
  }
  return near.points(execution);
}

} // namespace

NarrowOutside::NarrowOutside(const LatticeLabels& labels, int width, Execution& execution)
  : Labels(&labels)
  , Blocks(blocksNear(mixedBlocks(labels, execution), width, execution))
{
  this->Free = labels.insideOfBlocks(this->Blocks.codes(), execution);
  std::transform(this->Free.begin(), this->Free.end(), this->Free.begin(), [](std::uint64_t inside) { return ~inside; });
  execution.checkpoint(0.5);
  this->openByCubes(width, execution);
  execution.checkpoint(1.0);
}

/** First whether a cube fits that begins in a point, then whether one holds it. What lies in no block is taken for outside. */
void NarrowOutside::openByCubes(int width, Execution& execution)
{
  std::vector<std::uint64_t> bits = this->Free, combined(bits.size());
  for (const bool ahead : { true, false })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<std::uint32_t> beside = this->blocksBeside(axis, ahead, execution);
      for (int step = 0; step < width; ++step)
      {
        execution.forRanges(bits.size(), 4096,
          [&](std::size_t first, std::size_t last)
          {
            for (std::size_t b = first; b < last; ++b)
            {
              const std::uint64_t beyond = beside[b] == Nowhere ? ~std::uint64_t(0) : bits[beside[b]];
              combined[b] =
                ahead ? bits[b] & fromAhead(bits[b], beyond, axis) : bits[b] | fromBehind(bits[b], beyond, axis);
            }
          });
        bits.swap(combined);
      }
    }
  }
  this->findPoints(bits);
}

std::vector<std::uint32_t> NarrowOutside::blocksBeside(int axis, bool ahead, Execution& execution) const
{
  std::vector<std::uint32_t> beside(this->Blocks.size());
  execution.forRanges(beside.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t b = first; b < last; ++b)
      {
        std::uint64_t other = 0;
        const bool exists = besideBlock(this->Blocks[b], axis, ahead, other);
        const std::ptrdiff_t at = exists ? this->Blocks.find(other) : -1;
        beside[b] = at < 0 ? Nowhere : std::uint32_t(at);
      }
    });
  return beside;
}

void NarrowOutside::findPoints(const std::vector<std::uint64_t>& opened)
{
  this->Narrow.resize(this->Blocks.size());
  this->FirstPoint.resize(this->Blocks.size());
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    this->FirstPoint[b] = std::uint32_t(this->Points.size());
    this->Narrow[b] = this->Free[b] & ~opened[b];
    for (std::uint64_t left = this->Narrow[b]; left != 0; left &= left - 1)
    {
      this->Points.push_back(64 * this->Blocks[b] + std::uint64_t(lowestBit(left)));
    }
  }
}

std::ptrdiff_t NarrowCursor::find(const LatticePoint& p) const
{
  return std::min({ p.i, p.j, p.k }) < 0 ? -1 : this->find(mortonCode(p));
}

std::ptrdiff_t NarrowCursor::find(std::uint64_t code) const
{
  const std::uint64_t bit = std::uint64_t(1) << (code & 63);
  const std::ptrdiff_t block = this->placeOf(code >> 6);
  const std::uint64_t narrow = block < 0 ? 0 : this->Outside->Narrow[std::size_t(block)];
  return (narrow & bit) == 0 ? -1 : std::ptrdiff_t(this->Outside->FirstPoint[std::size_t(block)]) + countBits(narrow & (bit - 1));
}

NarrowOutside::Label NarrowCursor::at(const LatticePoint& p) const
{
  return std::min({ p.i, p.j, p.k }) < 0 ? NarrowOutside::Label::Wide : this->at(mortonCode(p));
}

NarrowOutside::Label NarrowCursor::at(std::uint64_t code) const
{
  using Label = NarrowOutside::Label;
  const std::ptrdiff_t block = this->placeOf(code >> 6);
  if (block < 0)
  {
    return this->Outside->Labels->insideAt(fromMorton(code)) ? Label::Solid : Label::Wide;
  }
  const auto has = [&](const std::vector<std::uint64_t>& bits) { return (bits[std::size_t(block)] >> (code & 63) & 1) != 0; };
  return !has(this->Outside->Free) ? Label::Solid : has(this->Outside->Narrow) ? Label::Narrow : Label::Wide;
}

std::vector<std::uint64_t> NarrowOutside::wideOfBlocks(const std::vector<std::uint64_t>& blocks, Execution& execution) const
{
  std::vector<std::uint64_t> others, wide(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const std::ptrdiff_t at = this->Blocks.find(blocks[b]);
    wide[b] = at >= 0 ? this->Free[std::size_t(at)] & ~this->Narrow[std::size_t(at)] : 0;
    if (at < 0)
    {
      others.push_back(blocks[b]);
    }
  }
  const std::vector<std::uint64_t> inside = this->Labels->insideOfBlocks(others, execution);
  for (std::size_t b = 0, other = 0; other < others.size(); ++b)
  {
    if (blocks[b] == others[other])
    {
      wide[b] = ~inside[other++];
    }
  }
  return wide;
}

} // namespace silhouette
