// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the Robust mode of the local hull surfacer starts from: silhouettes repaired, views aligned, the field corrected, as far as the capture needs
 * it, and lattice labels made from the result (Documentation/method.md, section 4).
 */
#pragma once

#include "LocalHullSurface.h"
#include "SurvivorBridges.h"

#include <optional>

namespace silhouette
{

/** The capture as Robust takes it. Not to be copied: parts point to each other. */
struct CorrectedCapture
{
  std::optional<PreparedViews> repaired; ///< the views with repaired silhouettes, where any were repaired
  std::optional<Octree> recarved;        ///< their octree
  std::optional<Mesh> surface;           ///< its surface
  FieldCorrection correction;
  std::uint64_t repairedPixels = 0;
  KnownVotes::Votes votes; ///< of the shell's corners, where the repair counted them and found nothing to repair
};

/** Repair and correct. `shell` is that of the octree's intersection octants. */
CorrectedCapture correctCapture(const Mesh& imperfect, const Octree& octree, const CornerShell& shell, const PreparedViews& views,
  const LocalHullOptions& options, Execution& execution);

/**
 * Labels of a shell that holds the survivors of `octree`, but by a field only those with a corner outside, `points` with the cells around them, and all that the corrected capture's surface
 * passes. What of the corrected surface holds no survivor is left out. Where its bricks end, the capture's field has to say what the octree
 * says, as correctCapture() makes it: no surface leaves them but through intersection octants.
 */
LatticeLabels correctedLabels(const Octree& octree, CornerShell shell, const std::vector<std::uint64_t>& points,
  const PreparedViews& views, const CorrectedCapture& capture, Execution& execution);

/** Those of the eight cells around each of the given points, none of which is on the border, that the shell does not hold; ascending, each once. */
std::vector<std::uint64_t> cellsMissingAround(const CornerShell& shell, const std::vector<std::uint64_t>& points, Execution& execution);

/** The shell with these cells. */
CornerShell extendedShell(const CornerShell& shell, const std::vector<std::uint64_t>& points, Execution& execution);

} // namespace silhouette
