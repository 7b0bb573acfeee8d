// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorIslands.h"

#include "LatticeRegions.h"

#include <algorithm>
#include <string>
#include <unordered_map>

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
  {
    const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
    execution.checkpoint(0.5);
    this->Regions = connectSurvivors(octree, shell);
    for (const auto& corners : shell.cellCorners)
    {
      this->ByCell.push_back(this->Regions.sets.find(corners[0]));
    }
  }

  /** Call `work(generation, index, component)` for every survivor. */
  template <typename Work>
  void forSurvivors(const Work& work)
  {
    const int depth = this->Source.lattice.depth;
    std::size_t cell = 0;
    for (int g = this->Source.treeGeneration; g <= depth; ++g)
    {
      const auto& states = this->Source.generations[g].state;
      for (std::size_t i = 0; i < states.size(); ++i)
      {
        if (states[i] == OctantState::Inside)
        {
          work(g, i, this->Regions.sets.find(this->Regions.octant(g, i)));
        }
        else if (g == depth && states[i] == OctantState::Intersection)
        {
          work(g, i, this->ByCell[cell++]);
        }
      }
    }
  }

private:
  const Octree& Source;
  LatticeRegions Regions;
  std::vector<std::uint32_t> ByCell; ///< for each intersection octant of the last generation, in its order
};

/** childBlock counts intersection octants, of which the last generation may have lost some. */
void countIntersections(Generation& generation)
{
  std::uint32_t blocks = 0;
  for (std::size_t i = 0; i < generation.size(); ++i)
  {
    generation.childBlock[i] = blocks;
    blocks += generation.state[i] == OctantState::Intersection;
  }
}

} // namespace

Octree dropIslands(const Octree& octree, double share, std::uint64_t& droppedOctants, Execution& execution)
{
  if (!(share >= 0.0 && share <= 1.0))
  {
    throw InvalidInput("island share " + std::to_string(share) + " is outside 0 to 1");
  }
  droppedOctants = 0;
  Octree kept = octree;
  if (share == 0.0 || octree.generations.empty())
  {
    return kept;
  }
  Components components(octree, execution);
  const auto leaves = [&](int g) { return std::uint64_t(1) << 3 * (octree.lattice.depth - g); };
  std::unordered_map<std::uint32_t, std::uint64_t> sizes;
  components.forSurvivors(
    [&](int g, std::size_t, std::uint32_t component) { sizes[component] += leaves(g); });
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
        kept.generations[g].state[i] = OctantState::Background;
        droppedOctants += leaves(g);
      }
    });
  countIntersections(kept.generations.back());
  execution.checkpoint(1.0);
  return kept;
}

} // namespace silhouette
