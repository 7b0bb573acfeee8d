// SPDX-License-Identifier: BSD-3-Clause
#include "SubPixelLabels.h"

#include "Carving.h"

#include <algorithm>
#include <array>

namespace silhouette
{
namespace
{

/** Which of the eight octants around each corner are in the shell; number c is the one whose corner c it is. */
using OctantsAround = std::vector<std::array<std::uint8_t, 8>>;

OctantsAround octantsAround(const CornerShell& shell, Execution& execution)
{
  OctantsAround around(shell.corners.size(), { 0, 0, 0, 0, 0, 0, 0, 0 });
  execution.forRanges(shell.cells.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t cell = first; cell < last; ++cell)
      {
        for (int c = 0; c < 8; ++c)
        {
          around[shell.cellCorners[cell][c]][c] = 1;
        }
      }
    });
  return around;
}

/** Knows which octants of the last generation are intersection octants, of trees that the octree lacks too. */
class Labeller
{
public:
  Labeller(const Octree& octree, const LatticeViews& views, const SubPixelCrossing& distances)
    : TheOctree(octree)
    , Views(views)
    , Distances(distances)
    , Below(octree.lattice.depth - octree.treeGeneration)
    , Whole(this->trees().size() == std::size_t(1) << 3 * octree.treeGeneration)
  {
  }

  /** The label of a corner that is labelled `voted` by its votes. */
  std::uint8_t label(const LatticePoint& p, const std::array<std::uint8_t, 8>& around, std::uint8_t voted) const
  {
    if (this->TheOctree.lattice.onBorder(p) || !this->mayBeSurrounded(p, around))
    {
      return voted;
    }
    const std::uint8_t other = this->Distances.inside(p, this->TheOctree.backgroundVotes);
    return other != voted && this->surrounded(p, around) ? other : voted;
  }

private:
  const std::vector<std::uint64_t>& trees() const
  {
    return this->TheOctree.generations[std::size_t(this->TheOctree.treeGeneration)].code;
  }

  static LatticePoint octant(const LatticePoint& p, int c)
  {
    const LatticePoint o = cornerOffset(c);
    return { p.i - o.i, p.j - o.j, p.k - o.k };
  }

  /** Are all octants around the corner that the octree has in the shell? */
  bool mayBeSurrounded(const LatticePoint& p, const std::array<std::uint8_t, 8>& around) const
  {
    for (int c = 0; c < 8; ++c)
    {
      if (!around[c] && (this->Whole || this->hasTree(octant(p, c))))
      {
        return false;
      }
    }
    return true;
  }

  bool hasTree(const LatticePoint& octant) const
  {
    return std::binary_search(this->trees().begin(), this->trees().end(), mortonCode(octant) >> 3 * this->Below);
  }

  /** Are all octants around such a corner intersection octants? */
  bool surrounded(const LatticePoint& p, const std::array<std::uint8_t, 8>& around) const
  {
    for (int c = 0; c < 8; ++c)
    {
      if (!around[c] &&
        leafState(this->Views, this->TheOctree.backgroundVotes, octant(p, c)) != OctantState::Intersection)
      {
        return false;
      }
    }
    return true;
  }

  const Octree& TheOctree;
  const LatticeViews& Views;
  const SubPixelCrossing& Distances;
  int Below;  ///< generations from a tree's root to the leaves
  bool Whole; ///< the octree has all trees
};

} // namespace

std::vector<std::uint8_t> subPixelLabels(const Octree& octree, const CornerShell& shell, const LatticeViews& views,
  const SubPixelCrossing& distances, const std::vector<std::uint8_t>& inside, Execution& execution)
{
  if (shell.cells.empty())
  {
    return inside;
  }
  const OctantsAround around = octantsAround(shell, execution);
  const Labeller labeller(octree, views, distances);
  std::vector<std::uint8_t> labels(inside.size());
  execution.forRanges(labels.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        labels[c] = labeller.label(fromMorton(shell.corners[c]), around[c], inside[c]);
      }
    });
  return labels;
}

} // namespace silhouette
