// SPDX-License-Identifier: BSD-3-Clause
/**
 * A corrected field raised, smoothly, to the survivors that it leaves outside (Documentation/method.md, section 4).
 *
 * Where cameras are wrong, or votes let the octree grow beyond the contours, whole patches of survivors stick out of the corrected surface, and all of them have to be
 * covered. A corner for each makes scales; the surface that the survivors were carved by is smooth.
 */
#pragma once

#include "BrickField.h"
#include "Execution.h"
#include "FieldViews.h"
#include "RaisingWeights.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * With g(x) the least but `backgroundVotes` of the views' distances, less a tenth of an octant, each value f becomes f + w max(0, g - f): w is 1 at the corners of the lost survivors, those
 * all of whose corners have values and none a positive one, and falls off around them as a Gaussian of standard deviation `width` does; so a survivor
 * that is still lost sticks out by a tenth of an octant or so.
 * `survivors`: leaf cells, Morton codes, ascending; `views`: all observed, on the field's lattice, as the survivors were carved; `backgroundVotes`: 0 or more, below
 * their number; `width`: octants, above 0 and up to WidestRaising. Cost: eight look-ups a survivor; around lost ones their weights (RaisingWeights.h), and the distances of the views near them.
 */
void raiseToSurvivors(BrickField& field, const std::vector<std::uint64_t>& survivors, const FieldViews& views, int backgroundVotes, double width, Execution& execution);

} // namespace silhouette
