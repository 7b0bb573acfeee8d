// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeRegions.h"

#include "Bits.h"
#include "BlockBits.h"
#include "LabelCache.h"
#include "LargePages.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

namespace silhouette
{
namespace
{

using Sets = std::set<std::uint32_t>;

/** Call `work(generation, index)` for the octants of one state, up to a generation. */
template <typename Work>
void forOctants(const Octree& octree, OctantState state, int last, const Work& work)
{
  for (int g = octree.treeGeneration; g <= last; ++g)
  {
    const auto& states = octree.generations[std::size_t(g)].state;
    for (std::size_t i = 0; i < states.size(); ++i)
    {
      if (states[i] == state)
      {
        work(g, i);
      }
    }
  }
}

/** Label the points of a part inside: corners of the shell themselves, others by their octants. */
void fillPart(LatticeLabels& labels, std::uint64_t block, std::uint64_t points, std::set<std::pair<int, std::size_t>>& octants)
{
  OctantCursor cursor(labels.octree());
  for (; points != 0; points &= points - 1)
  {
    const std::uint64_t point = block << 6 | std::uint64_t(lowestBit(points));
    const std::ptrdiff_t corner = labels.shell().find(point);
    const auto octant = cursor.locate(fromMorton(point));
    if (corner >= 0)
    {
      labels.setInside(std::size_t(corner));
    }
    else if (octant.generation >= 0 && octant.state == OctantState::Background)
    {
      octants.emplace(octant.generation, octant.index);
    }
  }
}

/** The sets with parts in blocks, but for those that hold a corner of one of some cells. Most hold one of the first cells that they touch. */
Sets setsWithout(const std::vector<std::uint64_t>& cells, BlockRegions& regions)
{
  const auto cellsOf = [&](std::uint64_t block)
  {
    std::uint64_t bits = 0;
    for (auto at = std::lower_bound(cells.begin(), cells.end(), block << 6); at != cells.end() && *at >> 6 == block; ++at)
    {
      bits |= std::uint64_t(1) << (*at & 63);
    }
    return bits;
  };
  Sets without;
  std::vector<std::uint8_t> holdsAny(regions.size(), 0);
  for (std::size_t block = 0; block < regions.blocks().size(); ++block)
  {
    std::optional<std::uint64_t> corners;
    for (std::uint32_t part = regions.firstPart(block); part < regions.firstPart(block + 1); ++part)
    {
      const std::uint32_t set = regions.find(part);
      if (holdsAny[set] != 0)
      {
        continue;
      }
      corners = corners ? corners : pointsTouching(regions.blocks()[block], cellsOf);
      if ((regions.part(part) & *corners) != 0)
      {
        holdsAny[set] = 1;
        without.erase(set);
      }
      else
      {
        without.insert(set);
      }
    }
  }
  return without;
}

/** Take out of `sets` those of the inside octants that no field contradicts: the smallest at none of their corners, larger ones not at all of them. */
void removeSupported(const LatticeLabels& labels, BlockRegions& regions, Sets& sets)
{
  const Octree& octree = labels.octree();
  LabelCache cache(labels);
  forOctants(octree, OctantState::Inside, octree.lattice.depth,
    [&](int g, std::size_t i)
    {
      const std::uint32_t octant = regions.octant(g, i);
      if (octant != BlockRegions::None)
      {
        sets.erase(regions.find(octant));
        return;
      }
      const LatticePoint cell = fromMorton(octree.generations[std::size_t(g)].code[i]);
      const std::int32_t size = std::int32_t(1) << (octree.lattice.depth - g);
      int inside = 0;
      std::uint32_t number = BlockRegions::None;
      for (int n = 0; n < 8; ++n)
      {
        const LatticePoint o = cornerOffset(n);
        const LatticePoint p{ size * (cell.i + o.i), size * (cell.j + o.j), size * (cell.k + o.k) };
        if (cache.insideAt(p))
        {
          ++inside;
          number = regions.at(mortonCode(p));
        }
      }
      if (number != BlockRegions::None && (size > 1 || inside == 8))
      {
        sets.erase(regions.find(number));
      }
    });
}

} // namespace

BlockRegions connectRegions(const LatticeLabels& labels, bool inside, Execution& execution)
{
  BlockIndex blocks = labels.blocks(execution).blocks();
  std::vector<std::uint64_t> members = labels.insideOfBlocks(blocks.codes(), execution);
  if (!inside)
  {
    std::transform(members.begin(), members.end(), members.begin(), [](std::uint64_t points) { return ~points; });
  }
  return BlockRegions(labels.octree(), inside ? OctantState::Inside : OctantState::Background, inside ? Steps::Edges : Steps::Faces,
    std::move(blocks), members, 0, execution);
}

SolidComponents::SolidComponents(const LatticeLabels& labels, Execution& execution)
{
  BlockRegions regions = connectRegions(labels, true, execution);
  this->Numbers = regions.numbersOf(labels.shell().corners, execution);
  this->Count = regions.count();
  this->Sets = UnionFind(regions.size());
  for (std::uint32_t number = 0; number < regions.size(); ++number)
  {
    this->Sets.unite(number, regions.find(number));
  }
}

void SolidComponents::add(std::uint32_t corner, const std::array<std::ptrdiff_t, 27>& around)
{
  std::uint32_t& own = this->Numbers[corner];
  for (int n = 0; n < 27; ++n)
  {
    const LatticePoint step = neighbourOf({ 0, 0, 0 }, n);
    const bool isNeighbour = n != 13 && std::abs(step.i) + std::abs(step.j) + std::abs(step.k) <= int(Steps::Edges);
    const std::uint32_t other = isNeighbour && around[std::size_t(n)] >= 0 ? this->Numbers[std::size_t(around[std::size_t(n)])] : BlockRegions::None;
    if (other != BlockRegions::None && own != BlockRegions::None && this->Sets.find(own) != this->Sets.find(other))
    {
      this->Sets.unite(own, other);
      --this->Count;
    }
    own = own == BlockRegions::None ? other : own;
  }
  if (own == BlockRegions::None)
  {
    own = this->Sets.add();
    ++this->Count;
  }
}

std::uint64_t fillCavities(LatticeLabels& labels, Execution& execution)
{
  BlockRegions regions = connectRegions(labels, false, execution);
  const std::uint32_t beyond = regions.find(regions.beyond());
  Sets cavities;
  const std::uint32_t parts = regions.firstPart(regions.blocks().size());
  for (std::uint32_t part = 0; part < parts; ++part)
  {
    const std::uint32_t set = regions.find(part);
    if (set != beyond)
    {
      cavities.insert(set);
    }
  }
  if (cavities.empty())
  {
    return 0;
  }
  std::set<std::pair<int, std::size_t>> octants;
  for (std::size_t block = 0; block < regions.blocks().size(); ++block)
  {
    for (std::uint32_t part = regions.firstPart(block); part < regions.firstPart(block + 1); ++part)
    {
      if (cavities.count(regions.find(part)) != 0)
      {
        fillPart(labels, regions.blocks()[block], regions.part(part), octants);
      }
    }
  }
  forOctants(labels.octree(), OctantState::Background, regions.coarsest(),
    [&](int g, std::size_t i)
    {
      const std::uint32_t octant = regions.octant(g, i);
      if (octant != BlockRegions::None && cavities.count(regions.find(octant)) != 0)
      {
        octants.emplace(g, i);
      }
    });
  for (const auto& [g, i] : octants)
  {
    labels.fillOctant(g, i);
  }
  return cavities.size();
}

std::vector<std::uint64_t> unsupportedPoints(const LatticeLabels& labels, const std::vector<std::uint64_t>& cells, Execution& execution)
{
  BlockRegions regions = connectRegions(labels, true, execution);
  Sets unsupported = setsWithout(cells, regions);
  if (!unsupported.empty())
  {
    removeSupported(labels, regions, unsupported);
  }
  std::vector<std::uint64_t> points;
  for (std::size_t block = 0; block < regions.blocks().size() && !unsupported.empty(); ++block)
  {
    std::uint64_t ofBlock = 0;
    for (std::uint32_t part = regions.firstPart(block); part < regions.firstPart(block + 1); ++part)
    {
      ofBlock |= unsupported.count(regions.find(part)) != 0 ? regions.part(part) : 0;
    }
    for (; ofBlock != 0; ofBlock &= ofBlock - 1)
    {
      points.push_back(regions.blocks()[block] << 6 | std::uint64_t(lowestBit(ofBlock)));
    }
  }
  return points;
}

BlockRegions connectSurvivors(const Octree& octree, Execution& execution)
{
  BlockIndex blocks(subdividedBlocks(octree));
  auto cells = largeVector<std::uint64_t>(blocks.size());
  execution.forRanges(blocks.size(), 512,
    [&](std::size_t first, std::size_t last)
    {
      OctantCursor cursor(octree);
      for (std::size_t block = first; block < last; ++block)
      {
        cells[block] = cursor.cellsOfBlock(blocks[block],
          [](const Octree::Location& octant) { return octant.generation >= 0 && octant.state != OctantState::Background; });
      }
    });
  return BlockRegions(octree, OctantState::Inside, Steps::Corners, std::move(blocks), cells, 0, execution);
}

std::uint64_t countSurvivorComponents(const Octree& octree, Execution& execution)
{
  return connectSurvivors(octree, execution).count();
}

} // namespace silhouette
