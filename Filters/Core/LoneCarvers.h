// SPDX-License-Identifier: BSD-3-Clause
/**
 * Who is at fault where a carve leaves nothing.
 */
#pragma once

#include "PreparedViews.h"

#include <vector>

namespace silhouette
{

/**
 * Of a carve that leaves nothing: for each view whether something would be left without it alone, as far as a coarser carve tells, of depth 5 or as much finer as
 * it takes for it to leave nothing either. None where a carve of depth 8 leaves something. Throws Cancelled. Cost: two carves of that depth, and those of less.
 */
std::vector<bool> loneCarvers(const PreparedViews& views, const Lattice& lattice, int backgroundVotes, Execution& execution);

} // namespace silhouette
