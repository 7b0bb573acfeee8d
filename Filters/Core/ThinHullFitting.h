// SPDX-License-Identifier: BSD-3-Clause
/**
 * Fitting a surface to thin local hulls (Documentation/method.md, section 4), without a self-intersection and without losing an
 * octant.
 */
#pragma once

#include "LatticeSurface.h"
#include "ThinHulls.h"

namespace silhouette
{

/** The surface of covered labels, before and after. */
struct ThinSurface
{
  const LatticeLabels& labels;
  const Octree& octree; ///< of the survivors, which is not the labels' where silhouettes were repaired
  const std::vector<std::uint64_t>& added; ///< Morton codes of the covering corners, ascending
  const CornerShell& shell;                ///< that `surface` was contoured on
  const LatticeSurface& surface;
  bool singlePrecision = false;
};

/**
 * Move the points on edges that leave a covering corner to the surface of the union of the hulls and of what is inside all silhouettes, and back again
 * as far as is needed for the surface to stay free of self-intersections (exact predicates, for the points as rounded) and for every last-generation
 * survivor to stay crossed or enclosed; both have to hold for `mesh` as it is handed in. `depth` may be null: then the hulls alone count.
 * Returns the number of points that moved. Throws InvalidInput, Cancelled.
 */
std::uint64_t moveToThinHulls(const std::vector<ThinHull>& hulls, const ThinSurface& thin, const SilhouetteDepth* depth,
  const ThinHullOptions& options, Mesh& mesh, Execution& execution);

} // namespace silhouette
