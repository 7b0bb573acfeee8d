// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where the votes fail along a lattice edge (Documentation/method.md, section 2; after Liang and Wong 2008).
 */
#pragma once

#include "PreparedViews.h"

namespace silhouette
{

/**
 * The first fraction t of the edge from `inside` to `outside`, neighbouring lattice points, at which more than
 * `backgroundVotes` views say background. In each view the pixels of the projected edge are walked; an image
 * parameter s becomes t = s wA / (wB + s (wA - wB)). 1 where the votes fail only at the end.
 * Cost: a table look-up a view, and the walk in the views that hold background there.
 */
double exactCrossing(
  const LatticeViews& views, const LatticePoint& inside, const LatticePoint& outside, int backgroundVotes);

/** The same for an edge of an octant of which `ask` says whom to ask. */
double exactCrossing(const LatticeViews& views, const ViewsToAsk& ask, const LatticePoint& inside,
  const LatticePoint& outside, int backgroundVotes);

} // namespace silhouette
