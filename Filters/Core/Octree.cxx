// SPDX-License-Identifier: BSD-3-Clause
#include "Octree.h"

#include "Bits.h"

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
  return OctantCursor(*this).locate(cell);
}

Octree::Location OctantCursor::locate(const LatticePoint& cell)
{
  const Octree& octree = *this->Source;
  if (!octree.lattice.hasCell(cell) || octree.generations.empty())
  {
    return {};
  }
  return this->locate(mortonCode(cell));
}

Octree::Location OctantCursor::locate(std::uint64_t leaf)
{
  const Octree& octree = *this->Source;
  const std::uint64_t differing = leaf ^ this->Leaf;
  const int depth = octree.lattice.depth;
  const int common = differing == 0 ? depth : depth - 1 - highestBit(differing) / 3;
  this->Leaf = leaf;
  int g = std::min(this->Deepest, common);
  if (g < octree.treeGeneration)
  {
    g = octree.treeGeneration;
    this->Deepest = -1;
    const auto& roots = octree.generations[g].code;
    const std::uint64_t tree = leaf >> 3 * (depth - g);
    this->Index[g] = std::size_t(tree); // where all trees are there
    if (roots.size() != std::size_t(1) << 3 * g)
    {
      const auto found = std::lower_bound(roots.begin(), roots.end(), tree);
      if (found == roots.end() || *found != tree)
      {
        return {};
      }
      this->Index[g] = std::size_t(found - roots.begin());
    }
  }
  for (;; ++g)
  {
    const auto& generation = octree.generations[g];
    const std::size_t index = this->Index[g];
    if (g == depth || generation.state[index] != OctantState::Intersection)
    {
      this->Deepest = g;
      return { g, index, generation.state[index] };
    }
    this->Index[g + 1] = std::size_t(generation.childBlock[index]) * 8 + std::size_t(leaf >> 3 * (depth - g - 1) & 7);
  }
}

bool Octree::touchesInside(const LatticePoint& p) const
{
  OctantCursor cursor(*this);
  for (int n = 0; n < 8; ++n)
  {
    const LatticePoint o = cornerOffset(n);
    const LatticePoint cell{ p.i - o.i, p.j - o.j, p.k - o.k };
    if (this->lattice.hasCell(cell) && cursor.locate(cell).state == OctantState::Inside)
    {
      return true;
    }
  }
  return false;
}

} // namespace silhouette
