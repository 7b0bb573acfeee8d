// SPDX-License-Identifier: BSD-3-Clause
/**
 * On which side does a point lie? Answered without error: a floating-point estimate with a bound on its
 * error, and where that does not decide, the determinant as an exact sum of doubles (floating-point
 * expansions: T. J. Dekker, "A floating-point technique for extending the available precision", 1971; J. R.
 * Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997).
 *
 * Exact for coordinates that are 0 or of magnitude 2^-300 to 2^300 (about 1e-90 to 1e90); coordinates of any
 * other magnitude are outside the promise. Needs arithmetic that rounds every operation to a double
 * (-ffp-contract=off). Cost: about 10 ns where the estimate decides, else up to a few microseconds. No memory
 * is allocated.
 */
#pragma once

#include <Eigen/Core>

namespace silhouette
{

/**
 * Sign (-1, 0, 1) of the area of triangle a b c: 1 where it runs counter-clockwise, x to the right and y up.
 */
int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/**
 * Sign (-1, 0, 1) of det[b - a, c - a, d - a]: 1 where d lies on the side of plane a b c from which the
 * triangle runs counter-clockwise, 0 where the four points lie in a plane.
 */
int orient3d(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

} // namespace silhouette
