// SPDX-License-Identifier: BSD-3-Clause
/**
 * Connected regions of labelled lattice points, across the whole octree: inside points are joined as our marching-cubes table joins them
 * (18-neighbourhood), outside ones through lattice edges; and of the survivors, which are joined where they touch.
 */
#pragma once

#include "BlockRegions.h"
#include "LatticeLabels.h"
#include "UnionFind.h"

#include <array>
#include <vector>

namespace silhouette
{

/** Regions of the points with the given label. */
BlockRegions connectRegions(const LatticeLabels& labels, bool inside, Execution& execution);

/** Components of the solid, by the shell's corners, while more of these become inside. Not for several threads at once. */
class SolidComponents
{
public:
  SolidComponents(const LatticeLabels& labels, Execution& execution);

  /** Is there but one? */
  bool isOne() const { return this->Count == 1; }
  /** Stands for the component of an inside corner. */
  std::uint32_t of(std::uint32_t corner) { return this->Sets.find(this->Numbers[corner]); }
  /** A corner is inside now; `around`: the corners of its 26 neighbours by neighbourOf(), -1 where there is none. */
  void add(std::uint32_t corner, const std::array<std::ptrdiff_t, 27>& around);

private:
  std::vector<std::uint32_t> Numbers; ///< of each corner; BlockRegions::None for those outside
  UnionFind Sets;
  std::size_t Count = 0; ///< of components
};

/** Label the cavities, outside regions that do not reach the world beyond, inside; returns their number. */
std::uint64_t fillCavities(LatticeLabels& labels, Execution& execution);

/**
 * The points (Morton codes, ascending) of inside regions that hold neither a corner of one of some leaf cells (Morton codes, ascending) nor an inside octant
 * that no field contradicts.
 */
std::vector<std::uint64_t> unsupportedPoints(const LatticeLabels& labels, const std::vector<std::uint64_t>& cells, Execution& execution);

/** Regions of the leaf cells of survivors: of the last generation's intersection and all inside octants, in the 26-neighbourhood. */
BlockRegions connectSurvivors(const Octree& octree, Execution& execution);

/** Number of components of the survivors. */
std::uint64_t countSurvivorComponents(const Octree& octree, Execution& execution);

} // namespace silhouette
