// SPDX-License-Identifier: BSD-3-Clause
/**
 * Walls of lattice points, and the opening of those that are too long: what is then left of a wall may be several.
 */
#pragma once

#include "Execution.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace silhouette
{

/** Takes a point from a wall, and of the same wall whichever follow; returns the Morton codes of all that it took, each once. */
using WallOpener = std::function<std::vector<std::uint64_t>(std::uint64_t point)>;

struct RemainingWalls
{
  /** Morton codes, those of a wall ascending. The walls are in no order that means anything, but always the same. */
  std::vector<std::vector<std::uint64_t>> walls;
  std::size_t searched = 0; ///< points whose neighbours were looked at to tell what openings had cut apart: the cost beside `points`
};

/**
 * What is left of `points`, all of whose 26-neighbours among them are in one wall with them, once no wall's outline is longer than `longest` octants. In each
 * round every wall that is longer is opened where least speaks for it, at the first such point in lattice order, and falls into those walls that are left of
 * it; walls are opened in the order of their first points.
 *
 * The outline is that of a rectangle with the two longest sides of a wall's box, and the solid around it. `points`: Morton codes of points whose coordinates
 * are 1 and more, ascending; `supports`: how much speaks for each. Throws Cancelled. Cost: where an opening may have cut a wall, what lies on its sides is
 * searched in turns until all but one are known to end or have met. So a piece costs the search of the smaller side, and the whole is nearly linear in the
 * points, except where the sides meet again only far away.
 */
RemainingWalls openLongWalls(const std::vector<std::uint64_t>& points, const std::vector<float>& supports, double longest, const WallOpener& open,
  Execution& execution);

} // namespace silhouette
