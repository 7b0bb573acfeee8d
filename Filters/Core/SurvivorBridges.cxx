// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorBridges.h"

#include "LatticeRegions.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace silhouette
{
namespace
{

/** A breadth-first search from the corners of one component to those of any other. */
class BridgeSearch
{
public:
  BridgeSearch(const Octree& octree, const CornerShell& shell, ConcurrentUnionFind& sets)
    : TheLattice(octree.lattice)
    , Shell(shell)
    , Sets(sets)
  {
  }

  /** The bridge, or none within `gap` steps of the 26-neighbourhood. */
  Bridge find(const std::vector<std::uint32_t>& component, int gap)
  {
    const std::uint32_t own = this->Sets.find(component.front());
    std::unordered_map<std::uint64_t, std::uint64_t> from;
    std::vector<std::uint64_t> front;
    for (const std::uint32_t corner : component)
    {
      const std::uint64_t code = this->Shell.corners[corner];
      if (!this->TheLattice.onBorder(fromMorton(code)))
      {
        from.emplace(code, code);
        front.push_back(code);
      }
    }
    for (int step = 0; step < gap; ++step)
    {
      std::vector<std::uint64_t> next;
      for (const std::uint64_t code : front)
      {
        for (int n = 0; n < 27; ++n)
        {
          const LatticePoint p = neighbourOf(fromMorton(code), n);
          if (this->TheLattice.onBorder(p) || !from.emplace(mortonCode(p), code).second)
          {
            continue;
          }
          const auto corner = this->Shell.find(mortonCode(p));
          if (corner >= 0 && this->Sets.find(std::uint32_t(corner)) != own)
          {
            this->Sets.unite(own, std::uint32_t(corner));
            return this->trace(mortonCode(p), from);
          }
          next.push_back(mortonCode(p));
        }
      }
      front = std::move(next);
    }
    return {};
  }

private:
  /** Back to the component; a step along a cube's diagonal gets a point between. */
  static Bridge trace(std::uint64_t code, const std::unordered_map<std::uint64_t, std::uint64_t>& from)
  {
    Bridge bridge = { code };
    for (std::uint64_t before = from.at(code); before != code; code = before, before = from.at(code))
    {
      const LatticePoint p = fromMorton(code), q = fromMorton(before);
      if (p.i != q.i && p.j != q.j && p.k != q.k)
      {
        bridge.push_back(mortonCode({ p.i, p.j, q.k }));
      }
      bridge.push_back(before);
    }
    return bridge;
  }

  const Lattice& TheLattice;
  const CornerShell& Shell;
  ConcurrentUnionFind& Sets;
};

} // namespace

std::vector<Bridge> bridgeSurvivors(const Octree& octree, const CornerShell& shell, int gap, Execution& execution)
{
  std::vector<Bridge> bridges;
  if (gap <= 0)
  {
    return bridges;
  }
  LatticeRegions survivors = connectSurvivors(octree, shell, execution);
  bool several = false;
  for (std::uint32_t corner = 1; corner < shell.corners.size() && !several; ++corner)
  {
    several = survivors.sets.find(corner) == corner;
  }
  if (!several)
  {
    return bridges;
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> byRoot;
  for (std::uint32_t corner = 0; corner < shell.corners.size(); ++corner)
  {
    byRoot[survivors.sets.find(corner)].push_back(corner);
  }
  std::vector<std::vector<std::uint32_t>> components;
  for (auto& one : byRoot)
  {
    components.push_back(std::move(one.second));
  }
  std::stable_sort(components.begin(), components.end(),
    [](const auto& a, const auto& b) { return a.size() < b.size(); });
  BridgeSearch search(octree, shell, survivors.sets);
  for (std::size_t c = 0; c + 1 < components.size(); ++c)
  {
    Bridge bridge = search.find(components[c], gap);
    if (!bridge.empty())
    {
      bridges.push_back(std::move(bridge));
    }
  }
  return bridges;
}

} // namespace silhouette
