// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where views agree that a surface should be: how far their silhouettes are from a model's, averaged over those whose contours pass near.
 */
#pragma once

#include "FieldViews.h"
#include "Vectorised.h"

#include <algorithm>
#include <cstddef>

namespace silhouette
{

/** For the points of a block: the least distance in the model's silhouettes, and how the views that are near it differ, weighted by how near they are. */
struct ViewAgreement
{
  static constexpr std::size_t Points = FieldViews::BlockPoints;
  static constexpr float GreatestDeviation = 3.0f; ///< standard deviations: views whose contours are further from a point are not heard

  float least[Points], sum[Points] = {}, weights[Points] = {};

  /** `far`: octants, what all distances are at most. */
  explicit ViewAgreement(float far) { std::fill(this->least, this->least + Points, far); }

  /** Of all views first: their distances in the model's silhouettes, octants, positive inside. */
  void approach(const float* modelled) { leastOf(modelled, this->least); }

  /**
   * Then, of all views: how much further inside than in the model's silhouettes the points are in the observed ones, weighted by exp(-x^2 / 2), x being by how
   * much further from the contour than the least the point is in the model's, over the standard deviation. Differences of `limit` octants and more do not count. The weights are right to 2e-5 of themselves.
   */
  void hear(const float* modelled, const float* observed, float inverseDeviation, float limit)
  {
    addResiduals(modelled, observed, this->least, inverseDeviation, limit, this->sum, this->weights);
  }

private:
  SILHOUETTE_VECTORISED static void leastOf(const float* modelled, float* least)
  {
    for (std::size_t n = 0; n < Points; ++n)
    {
      least[n] = modelled[n] < least[n] ? modelled[n] : least[n];
    }
  }

  SILHOUETTE_VECTORISED static void addResiduals(
    const float* modelled, const float* observed, const float* least, float inverseDeviation, float limit, float* sum, float* weights)
  {
    for (std::size_t n = 0; n < Points; ++n)
    {
      const float x = (modelled[n] - least[n]) * inverseDeviation, residual = observed[n] - modelled[n];
      // The sixteenth power of a polynomial for exp(-x^2 / 32): a call would be no vector instruction.
      const float t = x * x * (-1.0f / 32.0f);
      const float root = 1.0f + t * (1.0f + t * (0.5f + t * (1.0f / 6.0f + t * (1.0f / 24.0f + t * (1.0f / 120.0f)))));
      const float square = root * root, fourth = square * square, eighth = fourth * fourth;
      const float weight = x < GreatestDeviation && residual < limit && -residual < limit ? eighth * eighth : 0.0f;
      sum[n] += weight * residual;
      weights[n] += weight;
    }
  }
};

} // namespace silhouette
