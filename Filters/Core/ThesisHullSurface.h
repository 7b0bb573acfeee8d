// SPDX-License-Identifier: BSD-3-Clause
/**
 * The local hull surfacer's Thesis mode (Documentation/method.md, section 4; Shin and Tjahjadi 2008), the literal construction:
 * slices, connected regions, convex parts, chains, one convex hull for each chain, and their union on the lattice.
 */
#pragma once

#include "LocalHullSurface.h"

namespace silhouette
{

/**
 * The local hulls of `covered`, a surface whose points lie on the octree's lattice edges, and that crosses or encloses every survivor;
 * ordered by slice. Throws InvalidInput for an option out of range, Cancelled.
 */
std::vector<LocalHull> thesisHulls(
  const Mesh& covered, const Octree& octree, const LocalHullOptions& options, Execution& execution);

/**
 * The combined surface of the hulls. `covered` keeps the promise of LocalHullSurface.h, as localHullSurface()'s surface does; what it encloses is part of
 * the union, so that the promise holds here too. One hull that holds all points is given out as its own facets. Throws InvalidInput where `covered` leaves a survivor without an
 * inside corner or an option is out of range, Cancelled. Cost: near-linear in the octree and the hulls' rows.
 */
LocalHullSurface thesisHullSurface(
  const Mesh& covered, const Octree& octree, const LocalHullOptions& options, Execution& execution);

/** The same from hulls that are known already, as thesisHulls() gives them, or others. */
LocalHullSurface combineLocalHulls(const std::vector<LocalHull>& hulls, const Mesh& covered, const Octree& octree,
  const LocalHullOptions& options, Execution& execution);

} // namespace silhouette
