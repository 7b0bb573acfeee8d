// SPDX-License-Identifier: BSD-3-Clause
#include "BlockRegions.h"

#include "Bits.h"
#include "BlockSteps.h"

#include <algorithm>
#include <atomic>

namespace silhouette
{
namespace
{

constexpr int BlockHalvings = 2; ///< from a block to a cell

} // namespace

BlockRegions::BlockRegions(const Octree& octree, OctantState state, Steps steps, BlockIndex blocks, const std::vector<std::uint64_t>& members,
  std::size_t others, Execution& execution)
  : Source(&octree)
  , LastGeneration(std::max(octree.lattice.depth - BlockHalvings, octree.treeGeneration - 1))
  , WithBeyond(state == OctantState::Background)
  , Blocks(std::move(blocks))
{
  this->findParts(steps, members, execution);
  this->findOctants(state, execution);
  this->Beyond = std::uint32_t(this->Parts.size() + this->IsMember.size());
  this->Sets = ConcurrentUnionFind(this->Beyond + 1 + others, execution);
  this->joinOctants(execution);
  this->joinBlocks(steps, execution);
}

void BlockRegions::findParts(Steps steps, const std::vector<std::uint64_t>& members, Execution& execution)
{
  constexpr std::size_t RunSize = 1024;
  std::vector<std::vector<std::uint64_t>> parts((members.size() + RunSize - 1) / RunSize); ///< of so many blocks each
  std::vector<std::uint8_t> counts(members.size());
  execution.forRanges(parts.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t block = first * RunSize; block < std::min(last * RunSize, members.size()); ++block)
      {
        for (std::uint64_t left = members[block]; left != 0; ++counts[block])
        {
          const std::uint64_t part = ~left == 0 ? left : partOfLowest(left, steps);
          parts[block / RunSize].push_back(part);
          left &= ~part;
        }
      }
    });
  for (const auto& some : parts)
  {
    this->Parts.insert(this->Parts.end(), some.begin(), some.end());
  }
  this->FirstPart.reserve(members.size() + 1);
  this->FirstPart.push_back(0);
  for (const std::uint8_t count : counts)
  {
    this->FirstPart.push_back(this->FirstPart.back() + count);
  }
}

void BlockRegions::findOctants(OctantState state, Execution& execution)
{
  this->FirstOctant.assign(std::size_t(this->Source->treeGeneration) + 1, 0);
  for (int g = this->Source->treeGeneration; g <= this->LastGeneration; ++g)
  {
    const Generation& generation = this->Source->generations[std::size_t(g)];
    const std::size_t before = this->IsMember.size();
    this->IsMember.resize(before + generation.size(), 0);
    this->FirstOctant.push_back(this->IsMember.size());
    const int halvings = this->Source->lattice.depth - BlockHalvings - g;
    execution.forRanges(generation.size(), 1024,
      [&, before](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          const std::uint64_t low = generation.code[i] << 3 * halvings, high = (generation.code[i] + 1) << 3 * halvings;
          this->IsMember[before + i] = generation.state[i] == state && this->Blocks.count(low, high) < high - low;
        }
      });
  }
}

std::uint32_t BlockRegions::octant(int generation, std::size_t index) const
{
  if (generation < this->Source->treeGeneration || generation > this->LastGeneration)
  {
    return None;
  }
  const std::size_t place = this->FirstOctant[std::size_t(generation)] + index;
  return this->IsMember[place] != 0 ? std::uint32_t(this->Parts.size() + place) : None;
}

/** The octant at a code of a generation, of which one beside it is known: siblings follow one another. */
Octree::Location BlockRegions::beside(int g, std::size_t known, std::uint64_t code, OctantCursor& cursor) const
{
  const Generation& generation = this->Source->generations[std::size_t(g)];
  if (g > this->Source->treeGeneration && generation.code[known] >> 3 == code >> 3)
  {
    const std::size_t index = (known & ~std::size_t(7)) + std::size_t(code & 7);
    const OctantState state = generation.state[index];
    return { state == OctantState::Intersection ? g + 1 : g, index, state };
  }
  return cursor.locate(code << 3 * (this->Source->lattice.depth - g));
}

/** Across faces. Every pair of neighbours is met from its smaller octant, those of one size from both. */
void BlockRegions::joinOctants(Execution& execution)
{
  for (int g = this->Source->treeGeneration; g <= this->LastGeneration; ++g)
  {
    const Generation& generation = this->Source->generations[std::size_t(g)];
    execution.forRanges(generation.size(), 1024,
      [&, g](std::size_t first, std::size_t last)
      {
        OctantCursor cursor(*this->Source);
        for (std::size_t i = first; i < last; ++i)
        {
          const std::uint32_t own = this->octant(g, i);
          for (int side = 0; side < 6 && own != None; ++side)
          {
            std::uint64_t code = 0;
            const bool exists = besideBlock(generation.code[i], side / 2, side % 2 != 0, code);
            if (!exists || code >> 3 * g != 0)
            {
              if (this->WithBeyond)
              {
                this->Sets.unite(own, this->Beyond);
              }
              continue;
            }
            const Octree::Location beside = this->beside(g, i, code, cursor);
            const std::uint32_t other = beside.generation <= g ? this->octant(beside.generation, beside.index) : None;
            if (other != None)
            {
              this->Sets.unite(own, other);
            }
          }
        }
      });
  }
}

/** Join the parts of a block that hold any of these points to a number. */
void BlockRegions::joinPoints(std::size_t block, std::uint64_t points, std::uint32_t number)
{
  for (std::uint32_t part = this->FirstPart[block]; points != 0 && part < this->FirstPart[block + 1]; ++part)
  {
    if ((this->Parts[part] & points) != 0)
    {
      this->Sets.unite(number, part);
      points &= ~this->Parts[part];
    }
  }
}

/** The Morton codes of the blocks around one. */
class BlockRegions::BlocksAround
{
public:
  BlocksAround(std::uint64_t block, std::int32_t blocks)
  {
    const LatticePoint p = fromMorton(block);
    const std::int32_t coordinates[3] = { p.i, p.j, p.k };
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int step = 0; step < 3; ++step)
      {
        const std::int32_t x = coordinates[axis] + step - 1;
        this->Codes[axis][step] = spreadBits(std::uint64_t(std::max(x, 0))) << axis;
        this->IsBelow[axis][step] = x < 0;
        this->IsOfCells[axis][step] = x >= 0 && x < blocks;
      }
    }
  }

  std::uint64_t operator[](const LatticePoint& step) const
  {
    return this->Codes[0][step.i + 1] | this->Codes[1][step.j + 1] | this->Codes[2][step.k + 1];
  }
  /** Is a coordinate negative? */
  bool isBelow(const LatticePoint& step) const { return this->IsBelow[0][step.i + 1] || this->IsBelow[1][step.j + 1] || this->IsBelow[2][step.k + 1]; }
  /** Are there cells in that block? */
  bool isOfCells(const LatticePoint& step) const
  {
    return this->IsOfCells[0][step.i + 1] && this->IsOfCells[1][step.j + 1] && this->IsOfCells[2][step.k + 1];
  }

private:
  std::uint64_t Codes[3][3];
  bool IsBelow[3][3];
  bool IsOfCells[3][3];
};

/** Join a block's parts to what lies in a direction where there is no block. */
void BlockRegions::joinElsewhere(std::size_t block, const BlocksAround& around, const BlockDirection& direction, OctantCursor& cursor)
{
  std::uint32_t number = this->WithBeyond ? this->Beyond : None;
  if (around.isOfCells(direction.step))
  {
    const auto location = cursor.locate(around[direction.step] << 3 * BlockHalvings);
    number = this->octant(location.generation, location.index);
  }
  for (std::uint32_t part = this->FirstPart[block]; number != None && part < this->FirstPart[block + 1]; ++part)
  {
    if (direction.moved(this->Parts[part]) != 0)
    {
      this->Sets.unite(part, number);
    }
  }
}

/**
 * Of two blocks the first looks for the second, and joins the two; whom it has found is marked, so that the second looks for nobody there.
 */
void BlockRegions::joinBlocks(Steps steps, Execution& execution)
{
  std::vector<BlockDirection> ahead, behind;
  for (int n = 0; n < 27; ++n)
  {
    const BlockDirection direction(n, steps);
    if (n != 13 && direction.spreads >= 0)
    {
      (n > 13 ? ahead : behind).push_back(direction);
    }
  }
  std::vector<std::atomic<std::uint16_t>> marked(this->Blocks.size()); // a bit for each direction behind
  const std::int32_t blocks = std::max(this->Source->lattice.cells() >> BlockHalvings, std::int32_t(1));
  const auto forBlocks = [&](const auto& work)
  {
    execution.forRanges(this->Blocks.size(), 512,
      [&](std::size_t first, std::size_t last)
      {
        OctantCursor cursor(*this->Source);
        for (std::size_t block = first; block < last; ++block)
        {
          std::uint64_t members = 0;
          for (std::uint32_t part = this->FirstPart[block]; part < this->FirstPart[block + 1]; ++part)
          {
            members |= this->Parts[part];
          }
          if (members != 0)
          {
            work(block, members, BlocksAround(this->Blocks[block], blocks), cursor);
          }
        }
      });
  };
  forBlocks(
    [&](std::size_t block, std::uint64_t members, const BlocksAround& around, OctantCursor& cursor)
    {
      if (this->WithBeyond)
      {
        this->joinPoints(block, ~withinBorder(this->Source->lattice, this->Blocks[block]), this->Beyond);
      }
      for (std::size_t d = 0; d < ahead.size(); ++d)
      {
        if (ahead[d].moved(members) == 0)
        {
          continue;
        }
        const std::ptrdiff_t other = around.isBelow(ahead[d].step) ? -1 : this->Blocks.findNear(block, around[ahead[d].step]);
        if (other < 0)
        {
          this->joinElsewhere(block, around, ahead[d], cursor);
          continue;
        }
        // The directions behind are those ahead, the last first.
        marked[std::size_t(other)].fetch_or(std::uint16_t(1u << (ahead.size() - 1 - d)), std::memory_order_relaxed);
        for (std::uint32_t part = this->FirstPart[block]; part < this->FirstPart[block + 1]; ++part)
        {
          this->joinPoints(std::size_t(other), ahead[d].reached(this->Parts[part]), part);
        }
      }
    });
  forBlocks(
    [&](std::size_t block, std::uint64_t members, const BlocksAround& around, OctantCursor& cursor)
    {
      const unsigned found = marked[block].load(std::memory_order_relaxed);
      for (std::size_t d = 0; d < behind.size(); ++d)
      {
        if ((found >> d & 1) == 0 && behind[d].moved(members) != 0 &&
          (around.isBelow(behind[d].step) || this->Blocks.find(around[behind[d].step]) < 0))
        {
          this->joinElsewhere(block, around, behind[d], cursor);
        }
      }
    });
}

std::uint32_t BlockRegions::partAt(std::size_t block, int bit) const
{
  for (std::uint32_t part = this->FirstPart[block]; part < this->FirstPart[block + 1]; ++part)
  {
    if ((this->Parts[part] >> bit & 1) != 0)
    {
      return part;
    }
  }
  return None;
}

std::uint32_t BlockRegions::at(std::uint64_t point) const
{
  const std::ptrdiff_t block = this->Blocks.find(point >> 6);
  if (block >= 0)
  {
    return this->partAt(std::size_t(block), int(point & 63));
  }
  const LatticePoint p = fromMorton(point);
  if (this->WithBeyond && this->Source->lattice.onBorder(p))
  {
    return this->Beyond;
  }
  const auto location = this->Source->locate(p);
  return this->octant(location.generation, location.index);
}

std::vector<std::uint32_t> BlockRegions::numbersOf(const std::vector<std::uint64_t>& points, Execution& execution) const
{
  std::vector<std::uint32_t> numbers(points.size());
  execution.forRanges(points.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      const auto& codes = this->Blocks.codes();
      auto block = std::lower_bound(codes.begin(), codes.end(), points[first] >> 6);
      for (std::size_t n = first; n < last; ++n)
      {
        while (block != codes.end() && *block < points[n] >> 6)
        {
          ++block;
        }
        numbers[n] = block != codes.end() && *block == points[n] >> 6
          ? this->partAt(std::size_t(block - codes.begin()), int(points[n] & 63))
          : this->at(points[n]);
      }
    });
  return numbers;
}

std::size_t BlockRegions::count()
{
  std::size_t sets = 0;
  for (std::uint32_t number = 0; number < this->Beyond; ++number)
  {
    const bool isMember = number < this->Parts.size() || this->IsMember[number - this->Parts.size()] != 0;
    sets += isMember && this->find(number) == number;
  }
  return sets;
}

std::vector<std::uint64_t> subdividedBlocks(const Octree& octree)
{
  // The octants of the first generation whose octants are smaller: of each that is subdivided all eight are there.
  const int g = std::max(octree.lattice.depth - BlockHalvings + 1, octree.treeGeneration);
  const int halvings = g - (octree.lattice.depth - BlockHalvings);
  std::vector<std::uint64_t> blocks;
  for (const std::uint64_t code : octree.generations[std::size_t(g)].code)
  {
    if (blocks.empty() || blocks.back() != code >> 3 * halvings)
    {
      blocks.push_back(code >> 3 * halvings);
    }
  }
  return blocks;
}

} // namespace silhouette
