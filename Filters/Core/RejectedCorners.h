// SPDX-License-Identifier: BSD-3-Clause
/**
 * Lattice points that one view alone calls background: where it may be wrong.
 */
#pragma once

#include "CornerShell.h"
#include "PreparedViews.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** A corner that one view alone calls background. */
struct Rejected
{
  std::uint64_t corner = 0;
  std::int32_t view = -1;
};

/**
 * The corners that one view alone rejects, as far as steps along lattice edges reach them from the shell; by
 * view, then by code. Breadth-first: a neighbour of one wave belongs to it, to the one before or to the next,
 * so that two waves are all that need be remembered.
 * `votes`: of the octree, found where it was carved from these views, else nothing. Cost: a vote of each view for each corner that is
 * looked at; of the views that are undecided alone where enough of them never abstain.
 */
std::vector<Rejected> findRejected(const Octree& octree, const LatticeViews& views, const CornerShell& shell,
                                   KnownVotes::Votes& votes, Execution& execution);

} // namespace silhouette
