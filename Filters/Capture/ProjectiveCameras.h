// SPDX-License-Identifier: BSD-3-Clause
/**
 * Projection matrices whose scale and sign are free, as a P list has them: made positive at the object, and
 * held against what a camera's matrix looks like.
 */
#pragma once

#include "View.h"

#include <string>
#include <vector>

namespace silhouette
{

/**
 * Negate each projection whose w is negative at the world point nearest the rays through `pixels` (one a
 * view, in pixels: the silhouette's centroid where there is one, else the image's centre). Of a single view,
 * which has no such point, the determinant of the left 3 x 3 is made positive. Returns how many were negated.
 * Throws InvalidInput where there are not as many pixels as projections.
 */
int orientProjections(std::vector<Projection>& projections, const std::vector<Vector2>& pixels);

/** The inner part of a camera's matrix, by RQ decomposition of the left 3 x 3: K = [fx skew cx; 0 fy cy; 0 0
 * 1]. */
struct InnerCamera
{
  double fx = 0.0;   ///< pixels; positive
  double fy = 0.0;   ///< pixels; positive
  double skew = 0.0; ///< pixels
  double cx = 0.0;   ///< pixels
  double cy = 0.0;   ///< pixels
  double determinant =
      0.0; ///< of the left 3 x 3, its rows at unit length; negative is mirrored, 0 at infinity
};

/** All zero where the camera's centre is at infinity. */
InnerCamera innerCamera(const Projection& projection);

/**
 * One warning for a capture whose projections, already positive at the object, are mirrored (negative
 * determinant of the left 3 x 3) or not metric (fx : fy outside 0.8 to 1.25, or a skew above a tenth of fx);
 * empty where nothing is amiss. What is amiss in all of them may be the frame's; in some alone it is probably wrong, and
 * it says so. It counts the views and names the first, by `names` where given, else by
 * index. Cameras at infinity are not judged.
 */
std::string projectiveWarning(const std::vector<Projection>& projections,
                              const std::vector<std::string>& names = {});

} // namespace silhouette
