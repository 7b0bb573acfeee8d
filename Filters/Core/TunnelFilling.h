// SPDX-License-Identifier: BSD-3-Clause
/**
 * False tunnels: narrow passages through the solid that noise or the pixel grid leaves, filled so that the outside gets
 * the topology of its wide parts (Documentation/method.md, section 4). Filling loses no survivor.
 */
#pragma once

#include "LatticeLabels.h"

#include <vector>

namespace silhouette
{

struct TunnelFillingOptions
{
  bool fillTunnels = true; ///< off: the labels stay as they are
  /** Octants, 1 to 8: a passage is narrow where no cube of this edge fits into it; larger fills wider ones. */
  int width = 3;
  /**
   * Share of the lattice's cells along a side, 0 or more: a narrow passage with a longer loop of solid around it is taken for the object's own
   * and stays; larger fills longer ones. 0 fills none.
   */
  double loop = 1.0 / 3.0;
};

/**
 * The lattice points to be labelled inside, ascending: walls, one corner thick, across the narrow passages.
 *
 * The wide outside is the union of the cubes of `width` octants that hold no inside corner. It grows back into the outside,
 * from the corner with least support on, and takes a corner where that joins nothing of it that is one already: so it never gains a tunnel. What
 * it may not take are walls, one across each narrow passage. A wall whose outline is longer than `loop` allows is opened and the growth goes
 * on. Gaps that are narrow in the middle only are no passages and are opened as well.
 *
 * Throws InvalidInput for an option out of range, Cancelled. Cost: linear in the lattice points within 2 `width` octants of the solid.
 */
std::vector<std::uint64_t> tunnelWalls(const LatticeLabels& labels, const TunnelFillingOptions& options, Execution& execution);

} // namespace silhouette
