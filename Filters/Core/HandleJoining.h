// SPDX-License-Identifier: BSD-3-Clause
/**
 * Handles that noise has cut: ends that the corrected field nearly joins, and that are far from each other through the
 * solid (Documentation/method.md, section 4).
 */
#pragma once

#include "LatticeLabels.h"

#include <vector>

namespace silhouette
{

struct HandleJoiningOptions
{
  bool joinHandles = true; ///< off: the labels stay as they are
  /** Octants for each octant of deficit, 0 or more: how far outside by the field a joint may lie; larger joins more. */
  double reach = 1.0;
  /**
   * Share of the lattice's cells along a side, 0 or more: ends with a shorter way between them through the solid are left apart, and need no bridge; larger
   * joins less.
   */
  double loop = 1.0 / 3.0;
};

/** `loop` in steps of the lattice. */
int loopSteps(const Lattice& lattice, const HandleJoiningOptions& options);

/**
 * The corners of the shell to be labelled inside, ascending, for labels that a field was made for; none for others. The solid grows by
 * corners outside of it by at most `reach` times `deficit` octants, the greatest value first. A corner that would join parts that meet already within
 * the loop's length is left out; one that joins parts further apart is a joint, together with the corners that lead from it to the solid. Further outside, a corner is a joint where survivors that
 * touch in it belong to parts that far apart.
 *
 * Throws InvalidInput for an option out of range, Cancelled. Cost: linear in the shell, and for each place where the growth meets itself the corners
 * within the loop's length.
 */
std::vector<std::uint64_t> handleJoints(
  const LatticeLabels& labels, double deficit, const HandleJoiningOptions& options, Execution& execution);

} // namespace silhouette
