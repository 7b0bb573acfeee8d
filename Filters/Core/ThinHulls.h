// SPDX-License-Identifier: BSD-3-Clause
/**
 * Thin local hulls (Documentation/method.md, section 4): where the object is thinner than an octant, the surface around the corners
 * that cover survivors is moved onto the hulls of balls that fit into the silhouettes, and onto the silhouettes where these reach farther.
 */
#pragma once

#include "LatticeLabels.h"
#include "LatticeSurface.h"
#include "Mesh.h"
#include "SilhouetteDepth.h"

#include <vector>

namespace silhouette
{

struct ThinHullOptions
{
  double smallestRadius = 0.12; ///< octants, above 0: larger makes thinner parts fatter
  double largestRadius = 0.5;   ///< octants, at least smallestRadius, at most 1; larger lets balls fill more of their octant
  double reach = 0.9;           ///< octants, 0 to 1: how far a point moves at most; 0 moves none
};

/** Throws InvalidInput, naming the option and its value, where one is out of range. */
void checkThinHullOptions(const ThinHullOptions& options);

/** The convex hull of two balls; of one, where both are the same. World units. */
struct ThinHull
{
  Vector3 centre[2];
  double radius[2];
};

/** What is nearest to a point among a hull's balls: all those between its two. */
struct NearestBall
{
  double distance = 0.0; ///< of the point from the hull's surface, negative inside
  Vector3 centre = Vector3::Zero();
};
NearestBall nearestBall(const ThinHull& hull, const Vector3& point);

/**
 * The hulls of the balls in neighbouring covered octants (26-neighbourhood), and of these with the ordinary survivors next to them, so
 * that thin parts join the solid. `cells` are the shell cells of `labels` that had no inside corner before covering, ascending. A ball lies
 * where its octant is deepest in the silhouettes. Throws InvalidInput, Cancelled. Cost: some 80 places an octant, each looked up in the distance
 * maps of as many views as it takes to find one that says less than the best place so far.
 */
std::vector<ThinHull> thinHulls(const LatticeLabels& labels, const std::vector<std::uint32_t>& cells,
  const SilhouetteDepth& depth, const ThinHullOptions& options, Execution& execution);

} // namespace silhouette
