// SPDX-License-Identifier: BSD-3-Clause
/**
 * Lattice points that one view alone calls background: where it may be wrong.
 */
#pragma once

#include "BlockWords.h"
#include "CornerShell.h"
#include "PointCubes.h"
#include "PreparedViews.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** Corners of a block that one view alone calls background. */
struct RejectedWord
{
  BlockWord corners{ 0, 0 };
  std::int32_t view = -1;
};

/** A cube of corners that one view alone calls background. */
struct RejectedCube
{
  PointCube cube;
  std::int32_t view = -1;
};

/** What one view alone rejects, by view, then by code: no block of the cubes is among the words'. */
struct RejectedCorners
{
  std::vector<RejectedWord> words; ///< of a view and block one
  std::vector<RejectedCube> cubes;
};

/**
 * The corners that one view alone rejects, as far as steps along lattice edges reach them from the shell, breadth-first. Where a view is wrong in much of its
 * image that is a solid: cubes of which RejectedCubes knows, in whose view's images no object is within `depth` octants, are passed as wholes.
 * `votes`: of the octree, found where it was carved from these views, else nothing. Cost: a vote of each view for each corner that is
 * looked at; of the views that are undecided alone where enough of them never abstain. Memory: as what is rejected has surface.
 */
RejectedCorners findRejected(const Octree& octree, const LatticeViews& views, const CornerShell& shell, double depth,
                             KnownVotes::Votes& votes, Execution& execution);

} // namespace silhouette
