// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where views agree that a surface should be: how far their silhouettes are from a model's, averaged over those whose contours pass near.
 */
#pragma once

#include "BlockGroups.h"
#include "FieldViews.h"
#include "Vectorised.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace silhouette
{

/**
 * For the points of some groups of a block: the least distance in the model's silhouettes, and how the views that are near it differ, weighted by how near they are. What is
 * said of points is said of one group's after another's.
 */
class BlockAgreement
{
public:
  static constexpr float GreatestDeviation = 3.0f; ///< standard deviations: views whose contours are further from a point are not heard

  /** `far`: octants, what all distances are at most; `deviation` and `limit`: octants, of hear(). */
  BlockAgreement(std::size_t points, float far, float deviation, float limit)
    : Count(points)
    , InverseDeviation(1.0f / deviation)
    , Limit(limit)
  {
    std::fill(this->Least, this->Least + points, far);
    std::fill(this->Sum, this->Sum + points, 0.0f);
    std::fill(this->Weights, this->Weights + points, 0.0f);
  }

  /** Of all views first: their distances in the model's silhouettes, octants, positive inside. */
  void approach(const float* modelled) { leastOf(modelled, this->Count, this->Least); }

  /** Then: the places of the groups where a view's contour is near enough to some point for the view to be heard. */
  BlockGroups heard(const float* modelled) const { return BlockGroups(nearGroups(modelled, this->Least, this->Count, this->InverseDeviation)); }

  /**
   * And of all views, at the groups where they are heard: how much further inside than in the model's silhouettes points are in the observed ones (`observed`: of these groups
   * alone), weighted by exp(-x^2 / 2), x being by how much further from the contour than the least the point is in the model's, over the standard deviation. Differences of the limit
   * and more do not count. The weights are right to 2e-5 of themselves.
   */
  void hear(const BlockGroups& places, const float* modelled, const float* observed)
  {
    for (std::size_t m = 0; m < places.size(); ++m)
    {
      const std::size_t n = places.first(m);
      addResiduals({ modelled + n, observed + m * BlockGroups::Points, this->Least + n }, this->InverseDeviation, this->Limit, this->Sum + n, this->Weights + n);
    }
  }

  float least(std::size_t n) const { return this->Least[n]; }
  float weight(std::size_t n) const { return this->Weights[n]; }
  /** Octants: by how much the views that were heard say that a point is further inside; 0 where none was. */
  float difference(std::size_t n) const { return this->Weights[n] > 0.0f ? this->Sum[n] / this->Weights[n] : 0.0f; }

private:
  struct GroupDistances
  {
    const float *modelled, *observed, *least;
  };

  SILHOUETTE_VECTORISED static void leastOf(const float* modelled, std::size_t count, float* least)
  {
    for (std::size_t n = 0; n < count; ++n)
    {
      least[n] = modelled[n] < least[n] ? modelled[n] : least[n];
    }
  }

  SILHOUETTE_VECTORISED static std::uint8_t nearGroups(const float* modelled, const float* least, std::size_t count, float inverseDeviation)
  {
    unsigned groups = 0;
    for (std::size_t first = 0; first < count; first += BlockGroups::Points)
    {
      std::int32_t near = 0;
      for (std::size_t n = first; n < first + BlockGroups::Points; ++n)
      {
        near |= (modelled[n] - least[n]) * inverseDeviation < GreatestDeviation ? 1 : 0;
      }
      groups |= unsigned(near) << first / BlockGroups::Points;
    }
    return std::uint8_t(groups);
  }

  SILHOUETTE_VECTORISED static void addResiduals(const GroupDistances& distances, float inverseDeviation, float limit, float* sum, float* weights)
  {
    for (std::size_t n = 0; n < BlockGroups::Points; ++n)
    {
      const float modelled = distances.modelled[n], residual = distances.observed[n] - modelled;
      const float x = (modelled - distances.least[n]) * inverseDeviation;
      // The sixteenth power of a polynomial for exp(-x^2 / 32): a call would be no vector instruction.
      const float t = x * x * (-1.0f / 32.0f);
      const float root = 1.0f + t * (1.0f + t * (0.5f + t * (1.0f / 6.0f + t * (1.0f / 24.0f + t * (1.0f / 120.0f)))));
      const float square = root * root, fourth = square * square, eighth = fourth * fourth;
      const float weight = x < GreatestDeviation && residual < limit && -residual < limit ? eighth * eighth : 0.0f;
      sum[n] += weight * residual;
      weights[n] += weight;
    }
  }

  std::size_t Count;
  float InverseDeviation;
  float Limit;
  float Least[FieldViews::BlockPoints], Sum[FieldViews::BlockPoints], Weights[FieldViews::BlockPoints];
};

} // namespace silhouette
