// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far do the observed contours lie from those of a surface, and what shift of each view would bring them nearer? (Documentation/
 * method.md, section 4; the shift is the two-dimensional case of registration by silhouette coherence, Hernandez, Schmitt
 * and Cipolla 2007.)
 */
#pragma once

#include "FieldViews.h"

namespace silhouette
{

/** One view's observed contour against a surface's. */
struct ContourResidual
{
  std::size_t count = 0;            ///< contour places that were compared
  double mean = 0.0;                ///< octants: how far the observed contour lies outside the surface's, trimmed by a tenth
  Vector2 shift = Vector2::Zero();  ///< px: the least-squares shift of the surface's contour towards the observed one
  double noise = 0.0; ///< px^2: how large the shift's square would be if it were by chance, from how unlike the contour's parts are
};

/**
 * Residuals of the given views. Places whose distance is more than `limit` octants, and where the surface's silhouette is
 * thinner than one and a half, do not count; a view with few others says nothing. The shift is fitted together with a constant, so that a
 * surface that is too small all around is not shifted. Cost: rendering, and the contours' places; views that are not
 * observed are measured where the surface's contour runs.
 */
std::vector<ContourResidual> contourResiduals(
  const FieldViews& fieldViews, const Mesh& surface, const std::vector<int>& views, double limit, Execution& execution);

/**
 * Take from the views' shifts what a move of the whole object would do to them: it cannot be seen, and what noise makes of it would carry
 * the surface off. `residuals` are of the given views; those without places neither count nor change. Returns the move, in octants, by
 * least squares over the views; 0 where they do not tell all three axes.
 */
Vector3 removeCommonShift(
  const FieldViews& fieldViews, const std::vector<int>& views, std::vector<ContourResidual>& residuals);

/**
 * The share of the shifts' squares that chance explains, once what a move of the whole object does is taken out of them: about 1 where contours are noisy, some hundredths where cameras are wrong, whose errors
 * move whole contours. Views that say nothing do not count; infinite where there is no shift.
 */
double noiseShare(const std::vector<ContourResidual>& residuals);

/** The mean of the residuals' means, by count; octants. */
double typicalResidual(const std::vector<ContourResidual>& residuals);

} // namespace silhouette
