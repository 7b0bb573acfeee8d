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

  Parts(const std::vector<BlockWord>& words, Steps steps)
  {
    std::vector<std::uint64_t> found;
    for (const BlockWord& word : words)
    {
      found.push_back(word.block);
      this->points.push_back(word.bits);
      for (std::uint64_t left = word.bits; left != 0;)
      {
        this->parts.push_back(partOfLowest(left, steps));
        left &= ~this->parts.back();
      }
      this->first.push_back(std::uint32_t(this->parts.size()));
    }
    this->blocks = BlockIndex(std::move(found));
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

/** Join cubes, numbered from the parts' end on, with one another and with the parts: a cube of the same side beside one is in one other that meets it, if in any. */
void joinCubes(const Parts& all, const std::vector<PointCube>& cubes, Steps steps, UnionFind& sets)
{
  const auto numberOf = [&](const LatticePoint& low, std::int32_t side)
  {
    const PointCube* cube = std::min({ low.i, low.j, low.k }) < 0 ? nullptr : cubeOf(cubes, mortonCode(low));
    return cube == nullptr || cube->side < side ? -1 : std::ptrdiff_t(all.parts.size()) + (cube - cubes.data());
  };
  for (int n = 0; n < 27; ++n)
  {
    const BlockDirection direction(n, steps);
    if (n == 13 || direction.spreads < 0)
    {
      continue;
    }
    for (std::size_t c = 0; c < cubes.size(); ++c)
    {
      const LatticePoint low = fromMorton(cubes[c].corner), step = direction.step;
      const std::int32_t side = cubes[c].side;
      const std::ptrdiff_t other = numberOf({ low.i + side * step.i, low.j + side * step.j, low.k + side * step.k }, side);
      if (other >= 0)
      {
        sets.unite(std::uint32_t(all.parts.size() + c), std::uint32_t(other));
      }
    }
    for (std::size_t block = 0; block < all.blocks.size() && !cubes.empty(); ++block)
    {
      const LatticePoint at = fromMorton(all.blocks[block]) + direction.step;
      const std::ptrdiff_t other =
        direction.reached(all.points[block]) == 0 ? -1 : numberOf({ BlockSide * at.i, BlockSide * at.j, BlockSide * at.k }, BlockSide);
      for (std::uint32_t part = all.first[block]; part < all.first[block + 1] && other >= 0; ++part)
      {
        if (direction.reached(all.parts[part]) != 0)
        {
          sets.unite(part, std::uint32_t(other));
        }
      }
    }
  }
}

} // namespace

std::vector<PointComponent> pointComponents(const std::vector<BlockWord>& words, const std::vector<PointCube>& cubes, Steps steps, std::size_t least)
{
  const Parts all(words, steps);
  UnionFind sets(all.parts.size() + cubes.size());
  joinBlocks(all, steps, sets);
  joinCubes(all, cubes, steps, sets);
  constexpr std::size_t Nowhere = ~std::size_t(0);
  std::vector<std::uint64_t> sizes(all.parts.size() + cubes.size(), 0); // by the numbers that stand for the sets
  std::vector<std::size_t> places(sizes.size(), Nowhere);
  for (std::uint32_t number = 0; number < sizes.size(); ++number)
  {
    sizes[sets.find(number)] += number < all.parts.size() ? std::uint64_t(countBits(all.parts[number])) : cubes[number - all.parts.size()].size();
  }
  std::vector<PointComponent> components;
  const auto componentOf = [&](std::uint32_t number) -> PointComponent*
  {
    const std::uint32_t set = sets.find(number);
    if (sizes[set] >= least && places[set] == Nowhere)
    {
      places[set] = components.size();
      components.emplace_back().size = sizes[set];
    }
    return places[set] == Nowhere ? nullptr : &components[places[set]];
  };
  for (std::size_t block = 0; block < all.blocks.size(); ++block)
  {
    for (std::uint32_t part = all.first[block]; part < all.first[block + 1]; ++part)
    {
      if (PointComponent* component = componentOf(part))
      {
        append(component->words, { all.blocks[block], all.parts[part] });
      }
    }
  }
  for (std::size_t c = 0; c < cubes.size(); ++c)
  {
    if (PointComponent* component = componentOf(std::uint32_t(all.parts.size() + c)))
    {
      component->cubes.push_back(cubes[c]);
    }
  }
  return components;
}

} // namespace silhouette
