// SPDX-License-Identifier: BSD-3-Clause
#include "LabelBlocks.h"

#include "Bits.h"
#include "BlockBits.h"
#include "BlockRegions.h"
#include "BlockWords.h"

#include <algorithm>

namespace silhouette
{
namespace
{

std::vector<std::uint64_t> blocksOf(const BrickField& field)
{
  std::vector<std::uint64_t> blocks;
  for (const std::uint64_t brick : field.bricks())
  {
    for (std::uint64_t n = 0; n < 8; ++n)
    {
      blocks.push_back(8 * brick + n);
    }
  }
  return blocks;
}

} // namespace

std::uint64_t touchingInside(std::uint64_t block, OctantCursor& octants)
{
  return pointsTouching(block,
    [&](std::uint64_t other)
    { return octants.cellsOfBlock(other, [](const Octree::Location& octant) { return octant.state == OctantState::Inside; }); });
}

void FarLabels::fillOctant(int generation, std::size_t index)
{
  const std::pair<int, std::size_t> octant(generation, index);
  this->Filled.insert(std::lower_bound(this->Filled.begin(), this->Filled.end(), octant), octant);
}

bool FarLabels::insideAt(const LatticePoint& p) const
{
  if (this->TheOctree->lattice.onBorder(p))
  {
    return false;
  }
  const std::ptrdiff_t point = this->Field ? this->Field->find(mortonCode(p)) : -1;
  if (point >= 0)
  {
    return this->Field->values()[std::size_t(point)] > 0.0f;
  }
  if (this->Field)
  {
    return this->TheOctree->touchesInside(p);
  }
  // No intersection octant of the last generation touches it: every octant around it tells.
  return this->isInside(this->TheOctree->locate(p));
}

bool FarLabels::isInside(const Octree::Location& octant) const
{
  return octant.state == OctantState::Inside ||
    (!this->Filled.empty() &&
      std::binary_search(this->Filled.begin(), this->Filled.end(), std::make_pair(octant.generation, octant.index)));
}

/**
 * A block lies in one of the field's bricks, or in none. Without a field each point's octant tells, the one that has it for its lowest corner or holds
 * that one.
 */
std::uint64_t FarLabels::insideOfBlock(std::uint64_t block, OctantCursor& octants) const
{
  if (!this->Field)
  {
    return octants.cellsOfBlock(block, [this](const Octree::Location& octant) { return this->isInside(octant); });
  }
  const std::ptrdiff_t first = this->Field->find(64 * block);
  if (first >= 0)
  {
    return positiveBits(&this->Field->values()[std::size_t(first)]);
  }
  return touchingInside(block, octants);
}

LabelBlocks::LabelBlocks(const CornerShell& shell, const FarLabels& far, Execution& execution)
  : TheLattice(far.octree().lattice)
{
  std::vector<std::uint64_t> blocks = united(blocksOf(shell.corners, execution), subdividedBlocks(far.octree()));
  this->Blocks = BlockIndex(far.field() ? united(blocks, blocksOf(*far.field())) : std::move(blocks));
  this->Corners.resize(this->Blocks.size());
  this->FirstCorner.resize(this->Blocks.size());
  this->Others.resize(this->Blocks.size());
  execution.forRanges(this->Blocks.size(), 256,
    [&](std::size_t first, std::size_t last)
    {
      OctantCursor octants(far.octree());
      auto corner = std::lower_bound(shell.corners.begin(), shell.corners.end(), 64 * this->Blocks[first]);
      for (std::size_t place = first; place < last; ++place)
      {
        const std::uint64_t block = this->Blocks[place];
        this->FirstCorner[place] = std::uint32_t(corner - shell.corners.begin());
        for (; corner != shell.corners.end() && *corner >> 6 == block; ++corner)
        {
          this->Corners[place] |= std::uint64_t(1) << (*corner & 63);
        }
        const std::uint64_t others = withinBorder(this->TheLattice, block) & ~this->Corners[place];
        this->Others[place] = others != 0 ? others & far.insideOfBlock(block, octants) : 0;
      }
    });
}

std::uint64_t LabelBlocks::inside(std::size_t place, const std::vector<std::uint8_t>& corners) const
{
  std::uint64_t labels = this->Others[place];
  const std::uint8_t* label = corners.data() + this->FirstCorner[place];
  for (std::uint64_t left = this->Corners[place]; left != 0; left &= left - 1)
  {
    labels |= *label++ != 0 ? left & (0 - left) : 0;
  }
  return labels & withinBorder(this->TheLattice, this->Blocks[place]);
}

bool LabelBlocks::inside(std::size_t place, int bit, const std::vector<std::uint8_t>& corners) const
{
  const std::uint64_t point = std::uint64_t(1) << bit, own = this->Corners[place];
  if ((own & point) == 0)
  {
    return (this->Others[place] & point) != 0;
  }
  return corners[this->FirstCorner[place] + std::size_t(countBits(own & (point - 1)))] != 0 &&
    !this->TheLattice.onBorder(fromMorton(64 * this->Blocks[place] + std::uint64_t(bit)));
}

} // namespace silhouette
