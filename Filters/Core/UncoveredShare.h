// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which parts of the silhouettes does what survived the carving leave uncovered? Parts thinner than the noise
 * are carved away by single views, and are then missing in all others: object pixels onto which no survivor
 * projects.
 */
#pragma once

#include "ContourLimit.h"
#include "Execution.h"
#include "Octree.h"
#include "PreparedViews.h"

#include <vector>

namespace silhouette
{

struct UncoveredShareOptions
{
  /**
   * Octants, 0 to 1e9: pixels no further than this from a survivor's projection count as covered; larger
   * finds less.
   */
  double reach = 1.0;
  /**
   * Squared octants, 0 to 1e9: regions of uncovered pixels of a smaller area, such as salt, are left out; at
   * least four pixels are. Larger finds less.
   */
  double speckArea = 1.0;
  /**
   * Octants times lengthScale(), 0 to 1e9: how far uncovered pixels may be from covered ones and yet be the skin that noise takes off all round. The
   * default is as far as the local hulls take contours for each other's. Larger finds less.
   */
  double bridged = ContourLimit;
};

/**
 * For each view the share of its object pixels in parts of it that no survivor of `octree` covers, 0 to 1; 0 where there are
 * none, and for a view that does not have the middle of the root cube in front of it.
 *
 * A survivor of the last generation covers the box around its projection, widened by the reach; a larger one
 * the projection itself. Uncovered pixels are joined to regions; those count that cut through the object, and pixels further from what is covered than
 * can be bridged (UncoveredRegions.h): what noise takes off all round is for a surface to give back, and tolerance would give back too much. Throws
 * InvalidInput for an option out of range or an octree of other views, Cancelled. Cost: the pairs of survivor
 * and view, and a pass over the pixels.
 */
std::vector<double> uncoveredShares(const Octree& octree, const PreparedViews& views,
  const UncoveredShareOptions& options, Execution& execution);

/**
 * How many pixels an octant of the last generation is wide in the middle of the root cube, mean over the
 * views that see it.
 */
double pixelsPerOctant(const PreparedViews& views, const Lattice& lattice);

} // namespace silhouette
