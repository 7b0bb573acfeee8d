// SPDX-License-Identifier: BSD-3-Clause
#include "WideOutside.h"

#include <algorithm>

namespace silhouette
{
namespace
{

BlockRegions wideRegions(const LatticeLabels& labels, const NarrowOutside& narrow, Execution& execution)
{
  BlockIndex blocks(united(labels.blocks(execution).blocks().codes(), narrow.blocks()));
  const std::vector<std::uint64_t> wide = narrow.wideOfBlocks(blocks.codes(), execution);
  return BlockRegions(labels.octree(), OctantState::Background, Steps::Faces, std::move(blocks), wide, narrow.points().size(), execution);
}

} // namespace

WideOutside::WideOutside(const LatticeLabels& labels, const NarrowOutside& narrow, Execution& execution)
  : Regions(wideRegions(labels, narrow, execution))
{
}

std::uint32_t WideOutside::numberOf(const LatticePoint& wide) const
{
  return std::min({ wide.i, wide.j, wide.k }) < 0 ? this->Regions.beyond() : this->Regions.at(mortonCode(wide));
}

std::uint32_t WideOutside::setOf(const LatticePoint& wide)
{
  const std::uint32_t number = this->numberOf(wide);
  return number == Nowhere ? Nowhere : this->Regions.find(number);
}

void WideOutside::join(std::size_t narrow, const LatticePoint& wide)
{
  const std::uint32_t number = this->numberOf(wide);
  if (number != Nowhere)
  {
    this->Regions.unite(this->Regions.other(narrow), number);
  }
}

} // namespace silhouette
