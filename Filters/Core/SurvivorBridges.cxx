// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorBridges.h"

#include "LargePages.h"

#include <algorithm>
#include <unordered_map>

namespace silhouette
{
namespace
{

/** A breadth-first search from the corners of one component to those of any other. */
class BridgeSearch
{
public:
  /** `numbers`: for each corner of the shell one that is in the set of its component. */
  BridgeSearch(const Lattice& lattice, const CornerShell& shell, const std::vector<std::uint32_t>& numbers, BlockRegions& survivors)
    : TheLattice(lattice)
    , Shell(shell)
    , Numbers(numbers)
    , Survivors(survivors)
  {
  }

  /** The bridge, or none within `gap` steps of the 26-neighbourhood. */
  Bridge find(const std::vector<std::uint32_t>& component, int gap)
  {
    const std::uint32_t own = this->componentOf(component.front());
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
          if (corner >= 0 && this->componentOf(std::uint32_t(corner)) != own)
          {
            this->Survivors.unite(own, this->Numbers[std::size_t(corner)]);
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
  std::uint32_t componentOf(std::uint32_t corner) { return this->Survivors.find(this->Numbers[corner]); }

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
  const std::vector<std::uint32_t>& Numbers;
  BlockRegions& Survivors;
};

/** For each corner of the shell, all of whose cells are survivors, what stands for its component. */
std::vector<std::uint32_t> componentsOfCorners(const CornerShell& shell, BlockRegions& survivors, Execution& execution)
{
  const std::vector<std::uint32_t> cells = survivors.numbersOf(shell.cells, execution);
  auto corners = largeVector<std::uint32_t>(shell.corners.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const std::uint32_t component = survivors.find(cells[cell]);
    for (const std::uint32_t corner : shell.cellCorners[cell])
    {
      corners[corner] = component;
    }
  }
  return corners;
}

} // namespace

std::vector<Bridge> bridgeSurvivors(
  const Lattice& lattice, const CornerShell& shell, BlockRegions& survivors, int gap, Execution& execution)
{
  std::vector<Bridge> bridges;
  if (gap <= 0 || survivors.count() < 2)
  {
    return bridges;
  }
  const std::vector<std::uint32_t> numbers = componentsOfCorners(shell, survivors, execution);
  std::vector<std::vector<std::uint32_t>> components; // by their first corners
  constexpr std::uint32_t nowhere = 0xffffffffu;
  auto places = largeVector<std::uint32_t>(survivors.size(), nowhere); // of each number its component
  for (std::uint32_t corner = 0; corner < numbers.size(); ++corner)
  {
    std::uint32_t& place = places[numbers[corner]];
    if (place == nowhere)
    {
      place = std::uint32_t(components.size());
      components.emplace_back();
    }
    components[place].push_back(corner);
  }
  std::stable_sort(components.begin(), components.end(),
    [](const auto& a, const auto& b) { return a.size() < b.size(); });
  BridgeSearch search(lattice, shell, numbers, survivors);
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
