// SPDX-License-Identifier: BSD-3-Clause
#include "Octree.h"

#include <algorithm>

namespace silhouette
{

std::size_t Octree::count(OctantState state, int generation) const
{
  if (generation < 0 || std::size_t(generation) >= this->generations.size())
  {
    return 0;
  }
  const auto& states = this->generations[generation].state;
  return std::size_t(std::count(states.begin(), states.end(), state));
}

Octree::Location Octree::locate(const LatticePoint& cell) const
{
  Location location;
  if (!this->lattice.hasCell(cell) || this->generations.empty())
  {
    return location;
  }
  const std::uint64_t leaf = mortonCode(cell);
  const int depth = this->lattice.depth;
  const auto& roots = this->generations[this->treeGeneration];
  const std::uint64_t tree = leaf >> 3 * (depth - this->treeGeneration);
  std::size_t index = std::size_t(tree); // where all trees are there
  if (roots.code.size() != std::size_t(1) << 3 * this->treeGeneration)
  {
    const auto found = std::lower_bound(roots.code.begin(), roots.code.end(), tree);
    if (found == roots.code.end() || *found != tree)
    {
      return location;
    }
    index = std::size_t(found - roots.code.begin());
  }
  for (int g = this->treeGeneration;; ++g)
  {
    const auto& generation = this->generations[g];
    if (g == depth || generation.state[index] != OctantState::Intersection)
    {
      return { g, index, generation.state[index] };
    }
    const int child = int(leaf >> 3 * (depth - g - 1) & 7);
    index = std::size_t(generation.childBlock[index]) * 8 + child;
  }
}

bool Octree::touchesInside(const LatticePoint& p) const
{
  for (int n = 0; n < 8; ++n)
  {
    const LatticePoint o = cornerOffset(n);
    const LatticePoint cell{ p.i - o.i, p.j - o.j, p.k - o.k };
    if (this->lattice.hasCell(cell) && this->locate(cell).state == OctantState::Inside)
    {
      return true;
    }
  }
  return false;
}

} // namespace silhouette
