// SPDX-License-Identifier: BSD-3-Clause
/**
 * How wrong silhouettes and cameras are, from how a surface's contours differ from the silhouettes' (Documentation/method.md, section 4).
 */
#pragma once

#include "Execution.h"
#include "FieldViews.h"
#include "Mesh.h"
#include "ViewAlignment.h"

#include <vector>

namespace silhouette
{

constexpr int ViewsToJudgeBy = 6; ///< whether cameras are wrong; fewer may be so by chance

/** 0, 3, 6, ...: the views that tell how wrong all are. */
std::vector<int> everyThirdView(int views);

/** The mean length of the shifts of views that say anything. */
struct TypicalShift
{
  double octants = 0.0;
  double pixels = 0.0;
};

struct ContourDeficit
{
  std::vector<ContourResidual> residuals; ///< of every third view; of those that were not asked one that says nothing
  double octants = 0.0;                   ///< 0 or more: how far the observed contours lie outside the surface's
  TypicalShift shift;
  double chance = 0.0; ///< noiseShare() of the residuals without their common shift

  ContourDeficit() = default;
  /** May cameras be wrong? `shiftNoise`: the share of chance from which on they are not; of few views nobody knows. */
  bool mayBeCameras(double shiftNoise) const { return this->residuals.size() < std::size_t(ViewsToJudgeBy) || this->chance <= shiftNoise; }

  /**
   * `limit`: px of an octant, as contourResiduals() has it. Half of the views come first, by pairs, so that of two cameras which take turns both are among them: where they say less than a
   * third of `smallest`, octants, the others are not asked; nor where chance explains more than twice `shiftNoise` of the squares of their shifts, since contour noise is in all views alike.
   * Cost: contourResiduals() of every third view, or of every sixth.
   */
  ContourDeficit(const FieldViews& fieldViews, const Mesh& surface, double limit, double smallest, double shiftNoise, Execution& execution);
};

} // namespace silhouette
