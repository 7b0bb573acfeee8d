// SPDX-License-Identifier: BSD-3-Clause
/**
 * Islands: small components of the octants that survived the carving, as salt pixels that meet by chance
 * leave them.
 */
#pragma once

#include "Execution.h"
#include "Octree.h"

namespace silhouette
{

/**
 * The octree without its islands: components of the survivors (26-neighbourhood, the last generation's and
 * all inside octants) that have fewer octants of the last generation's size than `share` times the largest
 * one's; a coarser inside octant counts as those that it holds. 0 keeps all, 1 those as large as the largest;
 * larger gives up larger ones.
 *
 * Their octants become background, in the generation in which they are; nothing else changes, nor does what
 * the statistics say of the carving. An island's neighbours are background or its own, so that no octant that
 * is kept loses an inside corner. `droppedOctants` is how many were given up, in octants of the last
 * generation's size.
 *
 * Throws InvalidInput for a share outside 0 to 1, Cancelled. Cost: a copy, and with a share above 0 a sort of
 * the last generation's corners.
 */
Octree dropIslands(const Octree& octree, double share, std::uint64_t& droppedOctants, Execution& execution);

} // namespace silhouette
