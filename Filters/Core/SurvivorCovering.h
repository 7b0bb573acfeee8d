// SPDX-License-Identifier: BSD-3-Clause
/**
 * Covering: label further corners inside until every last-generation survivor has an inside corner, and survivors
 * that touch (26-neighbourhood) belong to one component of the solid (Documentation/method.md, section 4).
 */
#pragma once

#include "CornerDepth.h"
#include "LatticeLabels.h"
#include "SurvivorBridges.h"

namespace silhouette
{

/** What covering did. */
struct CoveringResult
{
  std::vector<std::uint32_t> coveredCells;    ///< cells of the shell, survivors that had no inside corner; ascending
  std::vector<std::uint32_t> coveringCorners; ///< shell corners that were labelled inside, in that order
  bool mayEnclose = false; ///< one of these may have changed more than components of the solid: there may be new cavities
};

/**
 * Corners that change no topology (simple ones) come first, then those that join components, then those that
 * found one, and only where none of these is left any other; among equals the corner that is least far outside
 * the silhouettes by `depth`, where that is not null, or that has most of the labels' support, then the one
 * that covers most octants, then the first in lattice order. The bridges' points, all of them corners of the
 * shell, are labelled inside at the end; those of a bridge whose ends meet within `loop` steps through the
 * solid are not. Cost: linear in the lost octants, and for each bridge the corners within `loop` steps.
 */
CoveringResult coverSurvivors(
  LatticeLabels& labels, const std::vector<Bridge>& bridges, int loop, const CornerDepth* depth, Execution& execution);

} // namespace silhouette
