// SPDX-License-Identifier: BSD-3-Clause
/**
 * Connected regions of labelled lattice corners, across the whole octree: inside corners are joined as our
 * marching-cubes table joins them (18-neighbourhood), outside ones through lattice edges, and octants that are
 * wholly inside or background join what they touch.
 */
#pragma once

#include "ConcurrentUnionFind.h"
#include "LatticeLabels.h"

namespace silhouette
{

/** Sets over the shell's corners (or whatever comes first), then all octants of the octree, then the world beyond the root cube. */
struct LatticeRegions
{
  ConcurrentUnionFind sets;
  std::vector<std::size_t> firstOctant; ///< number of the first octant of each generation
  std::uint32_t beyond = 0;             ///< the world beyond the root cube

  /** Number of an octant among the sets. */
  std::uint32_t octant(int generation, std::size_t index) const
  {
    return std::uint32_t(this->firstOctant[std::size_t(generation)] + index);
  }
  /** The same among the octants alone. */
  std::size_t place(int generation, std::size_t index) const { return this->octant(generation, index) - this->firstOctant[0]; }
  /** How many octants there are. */
  std::size_t octants() const { return this->beyond - this->firstOctant[0]; }
};

/** Regions of the corners with the given label. Numbers of corners and octants with the other label are alone. */
LatticeRegions connectRegions(const LatticeLabels& labels, bool inside, Execution& execution);

/**
 * Regions of the background octants that are at least `width` leaf octants wide, and of the world beyond; nothing else is joined. `others` numbers come
 * before the octants', for the caller to join.
 */
LatticeRegions connectWideOutside(const LatticeLabels& labels, int width, std::size_t others, Execution& execution);

/** Label the cavities, outside regions that do not reach the world beyond, inside; returns their number. */
std::uint64_t fillCavities(LatticeLabels& labels, Execution& execution);

/** Label inside regions that hold neither a corner of a survivor nor an inside octant outside; returns their number. */
std::uint64_t dropUnsupported(LatticeLabels& labels, Execution& execution);

/** Sets of the survivors that touch (26-neighbourhood), each with its corners; `shell` is that of the intersection octants. */
LatticeRegions connectSurvivors(const Octree& octree, const CornerShell& shell, Execution& execution);

/** Number of components of the last generation's and all inside octants in the 26-neighbourhood. */
std::uint64_t countSurvivorComponents(const Octree& octree, Execution& execution);

} // namespace silhouette
