// SPDX-License-Identifier: BSD-3-Clause
/**
 * A smooth field on a finer lattice than it was computed on.
 */
#pragma once

#include "BrickField.h"

namespace silhouette
{

/**
 * The field on a lattice of the same cube with `halvings` generations more, 0 to 3: cubic convolution between its points (Keys
 * 1981, a = -1/2), which keeps polynomials of the second degree; values are octants of the finer lattice. Given in the bricks
 * within `margin` octants of the finer lattice of `cells` (its leaf cells' Morton codes, ascending) and of where the field is 0, as far
 * as the field goes. Throws InvalidInput for halvings out of range. Cost: 64 products for each point.
 */
BrickField refinedField(const BrickField& field, int halvings, const std::vector<std::uint64_t>& cells, int margin, Execution& execution);

} // namespace silhouette
