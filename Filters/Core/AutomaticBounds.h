// SPDX-License-Identifier: BSD-3-Clause
/**
 * A root cube found from the silhouettes and cameras alone: the viewing cones of the silhouettes' bounding boxes
 * are intersected, and the result is tightened by coarse carves that are counted apart.
 */
#pragma once

#include "PreparedViews.h"
#include "ViewingCones.h"

namespace silhouette
{

struct AutomaticBoundsOptions
{
  int depth = 8;           ///< depth that the cube is meant for: the hull lies at least one of its leaves inside
  int backgroundVotes = 0; ///< k of the octree that is meant for it
};

/**
 * The cube. From depth 5 on its edge is at most 1.1 times the hull's longest side. Below
 * depth 5 the leaf that it keeps free costs more, and at depth 1, where there is none to spare, a tenth is kept free.
 * Throws UnboundedObject where the cones do not close (one view, say), NothingSurvives where they do not meet.
 * Cost: a few carves at depth 6 and one at depth 7.
 */
RootCube automaticBounds(const PreparedViews& views, const AutomaticBoundsOptions& options, Execution& execution);

/** The smallest cube with the box's centre that holds it. */
RootCube enclosingCube(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest);

} // namespace silhouette
