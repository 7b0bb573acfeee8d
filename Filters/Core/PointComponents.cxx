// SPDX-License-Identifier: BSD-3-Clause
#include "PointComponents.h"

#include "Bits.h"
#include "BlockIndex.h"
#include "UnionFind.h"

#include <algorithm>

namespace silhouette
{
namespace
{

/** Points by blocks, and of each block the parts that meet within it. */
struct Parts
{
  BlockIndex blocks;
  std::vector<std::uint64_t> points;    ///< of each block
  std::vector<std::uint32_t> first{ 0 }; ///< part of each block, and the end
  std::vector<std::uint64_t> parts;     ///< points, a bit each

  Parts(const std::vector<std::uint64_t>& codes, Steps steps)
  {
    std::vector<std::uint64_t> found;
    for (const std::uint64_t code : codes)
    {
      if (found.empty() || found.back() != code >> 6)
      {
        found.push_back(code >> 6);
        this->points.push_back(0);
      }
      this->points.back() |= std::uint64_t(1) << (code & 63);
    }
    for (std::uint64_t left : this->points)
    {
      while (left != 0)
      {
        this->parts.push_back(partOfLowest(left, steps));
        left &= ~this->parts.back();
      }
      this->first.push_back(std::uint32_t(this->parts.size()));
    }
    this->blocks = BlockIndex(std::move(found));
  }

  std::uint32_t partOf(std::size_t block, int bit) const
  {
    std::uint32_t part = this->first[block];
    while ((this->parts[part] >> bit & 1) == 0)
    {
      ++part;
    }
    return part;
  }
};

void joinBlocks(const Parts& all, Steps steps, UnionFind& sets)
{
  for (int n = 14; n < 27; ++n) // the thirteen blocks that follow 13, the block itself
  {
    const BlockDirection direction(n, steps);
    for (std::size_t block = 0; block < all.blocks.size() && direction.spreads >= 0; ++block)
    {
      const std::uint64_t leaving = direction.reached(all.points[block]);
      const LatticePoint other = fromMorton(all.blocks[block]) + direction.step;
      const std::ptrdiff_t at =
        leaving == 0 || std::min({ other.i, other.j, other.k }) < 0 ? -1 : all.blocks.find(mortonCode(other));
      if (at < 0 || (leaving & all.points[std::size_t(at)]) == 0)
      {
        continue;
      }
      for (std::uint32_t own = all.first[block]; own < all.first[block + 1]; ++own)
      {
        const std::uint64_t reached = direction.reached(all.parts[own]);
        for (std::uint32_t its = all.first[std::size_t(at)]; its < all.first[std::size_t(at) + 1]; ++its)
        {
          if ((reached & all.parts[its]) != 0)
          {
            sets.unite(own, its);
          }
        }
      }
    }
  }
}

} // namespace

std::vector<std::vector<std::uint64_t>> pointComponents(const std::vector<std::uint64_t>& points, Steps steps, std::size_t least)
{
  const Parts all(points, steps);
  UnionFind sets(all.parts.size());
  joinBlocks(all, steps, sets);
  constexpr std::size_t Nowhere = ~std::size_t(0);
  std::vector<std::size_t> sizes(all.parts.size(), 0), places(all.parts.size(), Nowhere); // by the parts that stand for the sets
  for (std::uint32_t part = 0; part < all.parts.size(); ++part)
  {
    sizes[sets.find(part)] += std::size_t(countBits(all.parts[part]));
  }
  std::vector<std::vector<std::uint64_t>> components;
  for (std::size_t block = 0; block < all.blocks.size(); ++block)
  {
    for (std::uint64_t left = all.points[block]; left != 0; left &= left - 1)
    {
      const int bit = lowestBit(left);
      const std::uint32_t set = sets.find(all.partOf(block, bit));
      if (sizes[set] < least)
      {
        continue;
      }
      if (places[set] == Nowhere)
      {
        places[set] = components.size();
        components.emplace_back().reserve(sizes[set]);
      }
      components[places[set]].push_back(64 * all.blocks[block] + std::uint64_t(bit));
    }
  }
  return components;
}

} // namespace silhouette
