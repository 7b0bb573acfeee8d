// SPDX-License-Identifier: BSD-3-Clause
#include "WideOutside.h"

#include "Bits.h"
#include "BlockBits.h"
#include "BrickField.h"
#include "LatticeRegions.h"

#include <algorithm>

namespace silhouette
{
namespace
{

/** All blocks of the bricks with points within `margin` octants of the shell's cells with corners of both labels, ascending. */
std::vector<std::uint64_t> blocksAround(const LatticeLabels& labels, int margin)
{
  const auto& shell = labels.shell();
  std::vector<std::uint64_t> mixed;
  for (std::size_t cell = 0; cell < shell.cells.size(); ++cell)
  {
    const auto& corners = shell.cellCorners[cell];
    const std::uint8_t first = labels.inside()[corners[0]];
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return labels.inside()[c] != first; }))
    {
      mixed.push_back(shell.cells[cell]);
    }
  }
  std::vector<std::uint64_t> blocks;
  for (const std::uint64_t brick : bricksAround(labels.octree().lattice, mixed, margin))
  {
    for (std::uint64_t n = 0; n < 8; ++n)
    {
      blocks.push_back(8 * brick + n);
    }
  }
  return blocks;
}

/** Those of `points` that meet the lowest of them along lattice edges. */
std::uint64_t partOfLowest(std::uint64_t points)
{
  std::uint64_t part = points & (0 - points);
  for (std::uint64_t before = 0; before != part;)
  {
    before = part;
    for (int axis = 0; axis < 3; ++axis)
    {
      part |= (fromAhead(part, 0, axis) | fromBehind(part, 0, axis)) & points;
    }
  }
  return part;
}

} // namespace

WideOutside::WideOutside(const LatticeLabels& labels, const NarrowOutside& narrow, int width, Execution& execution)
  : Blocks(blocksAround(labels, 2 * width))
  , Before(std::uint32_t(narrow.points().size()))
{
  this->findParts(narrow, execution);
  this->joinOctants(labels, width, execution);
  this->joinBlocks(execution);
}

void WideOutside::findParts(const NarrowOutside& narrow, Execution& execution)
{
  constexpr std::size_t RunSize = 1024;
  std::vector<std::vector<std::uint64_t>> parts((this->Blocks.size() + RunSize - 1) / RunSize); ///< of so many blocks each
  std::vector<std::uint8_t> counts(this->Blocks.size());
  execution.forRanges(parts.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t block = first * RunSize; block < std::min(last * RunSize, this->Blocks.size()); ++block)
      {
        for (std::uint64_t left = narrow.wideOfBlock(this->Blocks[block]); left != 0; ++counts[block])
        {
          const std::uint64_t part = ~left == 0 ? left : partOfLowest(left);
          parts[block / RunSize].push_back(part);
          left &= ~part;
        }
      }
    });
  for (const auto& some : parts)
  {
    this->Parts.insert(this->Parts.end(), some.begin(), some.end());
  }
  this->FirstPart.push_back(0);
  for (const std::uint8_t count : counts)
  {
    this->FirstPart.push_back(this->FirstPart.back() + count);
  }
}

std::uint32_t WideOutside::partOf(const LatticePoint& p) const
{
  const std::uint64_t code = std::min({ p.i, p.j, p.k }) < 0 ? 0 : mortonCode(p);
  const std::ptrdiff_t block = std::min({ p.i, p.j, p.k }) < 0 ? -1 : findBlock(this->Blocks, code >> 6);
  for (std::uint32_t part = block < 0 ? 0 : this->FirstPart[std::size_t(block)];
       block >= 0 && part < this->FirstPart[std::size_t(block) + 1]; ++part)
  {
    if (this->Parts[part] >> (code & 63) & 1)
    {
      return this->Before + part;
    }
  }
  return Nowhere;
}

std::uint32_t WideOutside::setOf(const LatticePoint& wide)
{
  const std::uint32_t part = this->partOf(wide);
  return part == Nowhere ? Nowhere : this->Sets.find(part);
}

void WideOutside::join(std::size_t narrow, const LatticePoint& wide)
{
  const std::uint32_t part = this->partOf(wide);
  if (part != Nowhere)
  {
    this->Sets.unite(std::uint32_t(narrow), part);
  }
}

/** Join the parts of a block that hold any of these points to a set. */
void WideOutside::joinPoints(std::size_t block, std::uint64_t points, std::uint32_t set)
{
  for (std::uint32_t part = this->FirstPart[block]; points != 0 && part < this->FirstPart[block + 1]; ++part)
  {
    if (this->Parts[part] & points)
    {
      this->Sets.unite(set, this->Before + part);
      points &= ~this->Parts[part];
    }
  }
}

void WideOutside::joinBlocks(Execution& execution)
{
  execution.forRanges(this->Blocks.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t block = first; block < last; ++block)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          std::uint64_t other = 0;
          besideBlock(this->Blocks[block], axis, true, other);
          const std::ptrdiff_t beside = findBlock(this->Blocks, other);
          for (std::uint32_t part = this->FirstPart[block]; beside >= 0 && part < this->FirstPart[block + 1]; ++part)
          {
            this->joinPoints(std::size_t(beside), fromBehind(0, this->Parts[part], axis), this->Before + part);
          }
        }
      }
    });
}

void WideOutside::joinOctants(const LatticeLabels& labels, int width, Execution& execution)
{
  const Octree& octree = labels.octree();
  LatticeRegions regions = connectWideOutside(labels, width, this->Before + this->Parts.size(), execution);
  this->Sets = std::move(regions.sets);
  execution.forRanges(this->Blocks.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      OctantCursor cursor(octree);
      for (std::size_t block = first; block < last; ++block)
      {
        const std::uint64_t within = withinBorder(octree.lattice, this->Blocks[block]);
        this->joinPoints(block, ~within, regions.beyond);
        // Octants narrower than `width` are in no region, so that mostly one tells about all points.
        for (std::uint64_t left = within; left != 0;)
        {
          const int bit = lowestBit(left);
          const auto location = cursor.locate(fromMorton(64 * this->Blocks[block] + std::uint64_t(bit)));
          const int size = location.generation < 0 ? 0 : std::min(octree.lattice.depth - location.generation, 2);
          const std::uint64_t points = size == 2 ? ~std::uint64_t(0) : size == 1 ? std::uint64_t(0xff) << (bit & 56) : std::uint64_t(1) << bit;
          if (location.generation >= 0 && location.state == OctantState::Background &&
            octree.lattice.cells() >> location.generation >= width)
          {
            this->joinPoints(block, points & left, regions.octant(location.generation, location.index));
          }
          left &= ~points;
          if (size < 2 && width > 2)
          {
            break;
          }
        }
      }
    });
}

} // namespace silhouette
