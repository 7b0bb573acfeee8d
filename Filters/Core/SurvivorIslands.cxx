// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorIslands.h"

#include "ChildNumbering.h"
#include "LatticeRegions.h"
#include "ParameterRange.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace silhouette
{
namespace
{

/** The survivors' components: for each surviving octant the number that stands for its own. */
class Components
{
public:
  Components(const Octree& octree, Execution& execution)
    : Source(octree)
    , Regions(connectSurvivors(octree, execution))
  {
  }

  /** The component of a cell of the lattice, by its Morton code; BlockRegions::None where it is of none. */
  std::uint32_t at(std::uint64_t leaf)
  {
    const std::uint32_t number = this->Regions.at(leaf);
    return number != BlockRegions::None ? this->Regions.find(number) : number;
  }

  /** Call `work(generation, index, component)` for every survivor. */
  template <typename Work>
  void forSurvivors(const Work& work)
  {
    const int depth = this->Source.lattice.depth;
    for (int g = this->Source.treeGeneration; g <= depth; ++g)
    {
      const Generation& generation = this->Source.generations[std::size_t(g)];
      for (std::size_t i = 0; i < generation.size(); ++i)
      {
        if (generation.state[i] == OctantState::Inside || (g == depth && generation.state[i] == OctantState::Intersection))
        {
          work(g, i, this->at(generation.code[i] << 3 * (depth - g)));
        }
      }
    }
  }

private:
  const Octree& Source;
  BlockRegions Regions;
};

/** Octants of the last generation's size that an octant of a generation holds. */
std::uint64_t leavesIn(const Octree& octree, int generation)
{
  return std::uint64_t(1) << 3 * (octree.lattice.depth - generation);
}

void giveUp(Octree& octree, int generation, std::size_t index, DroppedSurvivors& dropped)
{
  Generation& own = octree.generations[generation];
  own.state[index] = OctantState::Background;
  dropped.octants += leavesIn(octree, generation);
  if (generation == octree.lattice.depth)
  {
    dropped.leaves.push_back(own.code[index]);
  }
}

/** childBlock counts intersection octants, of which the last generation may have lost some; so have the votes of their corners. */
void settle(Octree& octree, DroppedSurvivors& dropped, Execution& execution)
{
  numberChildren(octree.generations.back(), execution);
  octree.votes.set(nullptr);
  std::sort(dropped.leaves.begin(), dropped.leaves.end());
}

} // namespace

Octree dropIslands(const Octree& octree, double share, DroppedSurvivors& dropped, Execution& execution)
{
  requireRange("island share", share, 0.0, 1.0);
  Octree kept = octree;
  if (share == 0.0 || octree.generations.empty())
  {
    return kept;
  }
  Components components(octree, execution);
  std::unordered_map<std::uint32_t, std::uint64_t> sizes;
  components.forSurvivors(
    [&](int g, std::size_t, std::uint32_t component) { sizes[component] += leavesIn(octree, g); });
  std::uint64_t largest = 0;
  for (const auto& one : sizes)
  {
    largest = std::max(largest, one.second);
  }
  execution.checkpoint(0.8);
  components.forSurvivors(
    [&](int g, std::size_t i, std::uint32_t component)
    {
      if (double(sizes[component]) < share * double(largest))
      {
        giveUp(kept, g, i, dropped);
      }
    });
  settle(kept, dropped, execution);
  execution.checkpoint(1.0);
  return kept;
}

Octree withoutStrangers(const Octree& octree, const Octree& kept, Execution& execution)
{
  Octree own = octree;
  Components components(octree, execution);
  std::unordered_set<std::uint32_t> known;
  Components(kept, execution)
    .forSurvivors(
      [&](int g, std::size_t i, std::uint32_t)
      {
        // In another octree an octant may be subdivided: its cells at the corners tell.
        const int below = 3 * (kept.lattice.depth - g);
        const std::uint64_t first = kept.generations[std::size_t(g)].code[i] << below, step = ((std::uint64_t(1) << below) - 1) / 7;
        for (std::uint64_t corner = 0; corner < (g == kept.lattice.depth ? 1u : 8u); ++corner)
        {
          known.insert(components.at(first + corner * step));
        }
      });
  execution.checkpoint(0.8);
  DroppedSurvivors strangers;
  components.forSurvivors(
    [&](int g, std::size_t i, std::uint32_t component)
    {
      if (known.count(component) == 0)
      {
        giveUp(own, g, i, strangers);
      }
    });
  settle(own, strangers, execution);
  execution.checkpoint(1.0);
  return own;
}

std::vector<std::uint64_t> debrisLeaves(const Octree& octree, const Octree& repaired)
{
  std::vector<std::uint64_t> leaves = leafCells(octree, OctantState::Intersection);
  OctantCursor cursor(repaired);
  const auto stays = [&](std::uint64_t leaf) { return cursor.locate(fromMorton(leaf)).state != OctantState::Background; };
  leaves.erase(std::remove_if(leaves.begin(), leaves.end(), stays), leaves.end());
  return leaves;
}

Octree dropLeaves(const Octree& octree, const std::vector<std::uint64_t>& leaves, DroppedSurvivors& dropped)
{
  Octree kept = octree;
  if (leaves.empty() || octree.generations.empty())
  {
    return kept;
  }
  const Generation& last = octree.generations.back();
  for (std::size_t i = 0; i < last.size(); ++i)
  {
    if (last.state[i] != OctantState::Background && std::binary_search(leaves.begin(), leaves.end(), last.code[i]))
    {
      giveUp(kept, octree.lattice.depth, i, dropped);
    }
  }
  Execution alone;
  settle(kept, dropped, alone);
  return kept;
}

} // namespace silhouette
