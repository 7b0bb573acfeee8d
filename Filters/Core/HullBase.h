// SPDX-License-Identifier: BSD-3-Clause
/**
 * The hull as the base of a near-convex surface's field (Documentation/method.md, section 4; after the thesis, which builds surfaces
 * from the convex hulls of their convexities): under noise a convex hull carries the shape where smoothing would round it.
 */
#pragma once

#include "BrickField.h"

namespace silhouette
{

struct HullBase
{
  bool applied = false;
  /**
   * The volume that the field's surface encloses as a share of its convex hull's, 0 to 1; 0 where there is no surface or no hull, or none was made.
   * Where the hull of some of the surface's points told that the whole's is not applied, that hull's: a little more.
   */
  double convexity = 0.0;
};

/**
 * `surface`: field.contourMesh(). Where its convexity exceeds `leastConvexity`, replace the field's values of at most `band`
 * octants by the distance in octants from the convex hull of that surface, positive inside, less the median by which the two
 * differ within half an octant of the surface: the hull of a noisy surface lies too far outside. A `leastConvexity` of 1 or more never does.
 * Cost: a hull, for surfaces that are far from convex of 4,000 points at most, else for each 64 points of the band a look at each of the hull's facets.
 */
HullBase applyHullBase(BrickField& field, const Mesh& surface, double leastConvexity, double band, Execution& execution);

} // namespace silhouette
