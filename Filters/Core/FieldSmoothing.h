// SPDX-License-Identifier: BSD-3-Clause
/**
 * Smoothing of a field in bricks that draws no curved surface inwards.
 */
#pragma once

#include "BrickField.h"
#include "Execution.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace silhouette
{

/** Weights of a Gaussian at 0, 1, 2, ... octants, up to three standard deviations `sigma`, above 0; over both sides they add up to 1. */
std::vector<float> gaussianKernel(double sigma);

/** Smooths fields, one after another, in memory that it keeps. */
class FieldSmoother
{
public:
  /**
   * Along each axis a Gaussian of standard deviation `sigma` octants (0 or less: nothing happens), less a share of itself smoothed once more, so that polynomials up
   * to the third degree stay; but no value is changed by more than `most`, 0 or more. Where bricks end the last value goes on. Cost: for each value and axis 9 sigma values, in
   * vectors; memory: twice the field's.
   */
  void smooth(BrickField& field, double sigma, float most, Execution& execution);

private:
  std::unique_ptr<float[]> From, To; ///< values of all bricks, a brick's row after row; first touched side by side
  std::size_t Size = 0;              ///< of each
};

} // namespace silhouette
