// SPDX-License-Identifier: BSD-3-Clause
#include "OctantsAround.h"

#include "UnionFind.h"

namespace silhouette
{
namespace
{

/** For each set of the cells around a point, a bit each: the first of those that meet across faces. */
struct FirstOfParts
{
  std::uint8_t cells[256];

  FirstOfParts()
  {
    for (unsigned members = 0; members < 256; ++members)
    {
      UnionFind sets(8);
      for (unsigned n = 0; n < 8; ++n)
      {
        for (unsigned step = 1; step < 8; step *= 2)
        {
          if ((members >> n & 1) != 0 && (n & step) == 0 && (members >> (n + step) & 1) != 0)
          {
            sets.unite(n, n + step);
          }
        }
      }
      this->cells[members] = 0;
      for (unsigned n = 0; n < 8; ++n)
      {
        this->cells[members] |= std::uint8_t(unsigned((members >> n & 1) != 0 && sets.find(n) == n) << n);
      }
    }
  }
};

} // namespace

CursorsAround cursorsAround(const Octree& octree)
{
  const OctantCursor c(octree);
  return { c, c, c, c, c, c, c, c };
}

std::uint8_t tellingCells(std::uint8_t intersection)
{
  static const FirstOfParts first;
  return first.cells[std::uint8_t(~intersection)];
}

bool isWhole(const Octree& octree)
{
  return octree.generations[std::size_t(octree.treeGeneration)].size() == std::size_t(1) << 3 * octree.treeGeneration;
}

} // namespace silhouette
