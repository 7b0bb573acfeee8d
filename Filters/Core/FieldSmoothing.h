// SPDX-License-Identifier: BSD-3-Clause
/**
 * Smoothing of a field in bricks that draws no curved surface inwards.
 */
#pragma once

#include "BrickField.h"
#include "Execution.h"

namespace silhouette
{

/**
 * Along each axis a Gaussian of standard deviation `sigma` octants (0 or less: nothing happens), less a share of itself smoothed once more, so that polynomials up
 * to the third degree stay. Where bricks end the last value goes on. Cost: for each value and axis 9 sigma values, in vectors; twice the field's memory.
 */
void smoothField(BrickField& field, double sigma, Execution& execution);

} // namespace silhouette
