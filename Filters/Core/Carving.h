// SPDX-License-Identifier: BSD-3-Clause
/**
 * Carving: grow the octree of the silhouettes, generation by generation (Documentation/method.md, section 1).
 *
 * An octant is background iff more than k views call all of it background, inside iff at most k views call any
 * of it background and some view sees all of it, else an intersection; k = 0 is the strict octree. What lies
 * outside the root cube counts as background, so that an octant at the cube's border is never inside. A view
 * that is wholly for or wholly against an octant is not asked again about its descendants.
 *
 * Cost: proportional to the boundary pairs (octant, view); memory: the octants and, for the generation under
 * work, two bytes for each such pair.
 */
#pragma once

#include "Octree.h"
#include "PreparedViews.h"

namespace silhouette
{

struct CarveOptions
{
  int backgroundVotes = 0; ///< k, 0 to views - 1; larger keeps more: octants survive k dissenting views
  /** Morton codes, within the generation of the tree roots, of the trees to carve; sorted; empty is all. */
  std::vector<std::uint64_t> trees;
};

/** Generation of the tree roots for a depth: min(3, depth - 1). */
int treeGeneration(int depth);

/** Is any octant not background? */
bool anySurvivor(const Octree& octree);

/**
 * Carve `views`. Throws InvalidInput (depth or votes out of range), Cancelled, and NothingSurvives where no
 * octant of the whole root cube survives: its message names the views without one of which something would, or the one that carved most.
 */
Octree carve(const LatticeViews& views, const CarveOptions& options, Execution& execution);

/**
 * The state that carve() comes to for a leaf cell of the lattice: of its octant of the last generation, or of the
 * coarser octant that it lies in, which tells the same since a cell's pixels are among those of its ancestors. For
 * the few cells that an octree of some trees lacks. Cost: a test of the cell in each view.
 */
OctantState leafState(const LatticeViews& views, int backgroundVotes, const LatticePoint& cell);

} // namespace silhouette
