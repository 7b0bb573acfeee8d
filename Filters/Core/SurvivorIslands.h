// SPDX-License-Identifier: BSD-3-Clause
/**
 * Survivors of the carving that are given up: islands, small components, as salt pixels that meet by chance leave them, and debris, which
 * only pixels uphold that the repair of the silhouettes finds false.
 */
#pragma once

#include "Execution.h"
#include "Octree.h"

#include <vector>

namespace silhouette
{

/** Which survivors were given up. */
struct DroppedSurvivors
{
  std::uint64_t octants = 0;         ///< in octants of the last generation's size; a coarser one counts as those that it holds
  std::vector<std::uint64_t> leaves; ///< Morton codes of those of the last generation, ascending
};

/**
 * The octree without its islands: components of the survivors (26-neighbourhood, the last generation's and
 * all inside octants) that have fewer octants of the last generation's size than `share` times the largest
 * one's. 0 keeps all, 1 those as large as the largest; larger gives up larger ones.
 *
 * Their octants become background, in the generation in which they are; nothing else changes, nor does what
 * the statistics say of the carving. An island's neighbours are background or its own, so that no octant that
 * is kept loses an inside corner. What is given up is added to `dropped`.
 *
 * Throws InvalidInput for a share outside 0 to 1, Cancelled. Cost: a copy, and with a share above 0 a sort of
 * the last generation's corners.
 */
Octree dropIslands(const Octree& octree, double share, DroppedSurvivors& dropped, Execution& execution);

/**
 * Morton codes, ascending, of the last generation's intersection octants that are background in `repaired`, an octree of the same
 * lattice: debris, where that was carved from repaired silhouettes. Cost: linear in the last generation.
 */
std::vector<std::uint64_t> debrisLeaves(const Octree& octree, const Octree& repaired);

/**
 * The octree in which those of these octants of the last generation (Morton codes, ascending) that survived are background. What is given
 * up is added to `dropped`. Cost: a copy.
 */
Octree dropLeaves(const Octree& octree, const std::vector<std::uint64_t>& leaves, DroppedSurvivors& dropped);

/**
 * The octree without its components that hold no survivor of `kept`, an octree of the same lattice: what of a more generous octree belongs
 * to islands that another one has given up. Cost: a copy, and the components.
 */
Octree withoutStrangers(const Octree& octree, const Octree& kept, Execution& execution);

} // namespace silhouette
