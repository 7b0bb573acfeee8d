// SPDX-License-Identifier: BSD-3-Clause
/**
 * Repair of silhouettes by what the other views say (Documentation/method.md, section 4): speckles,
 * background holes smaller than the lattice can show and a few pixels of object that stand alone, and blobs, regions that a single view cuts deep and
 * long out of the object.
 */
#pragma once

#include "CornerShell.h"
#include "Octree.h"
#include "PreparedViews.h"

#include <optional>
#include <vector>

namespace silhouette
{

struct SilhouetteRepairOptions
{
  /**
   * Squared octants, 0 to 1e9: a region of background that the object encloses is a speckle if its area is
   * at most this, or a pixel; larger takes larger ones. Of object, only a few pixels that stand alone are
   * one.
   */
  double speckleArea = 0.5;
  /**
   * Share of the object's pixels, 0 to 1: speckles are left alone where those that the other views dispute
   * are fewer; larger repairs less.
   */
  double speckleShare = 1e-4;
  /**
   * Octants, 0 to 1e9: how deep in one view's background a corner lies that this view alone rejects; at least 85 over the
   * square of the number of views is asked for. Larger finds fewer blobs.
   */
  double blobDepth = 0.1;
  /**
   * Share of the object's extent along the lattice, 0 to 1: the mean depth, along the view, of what it alone
   * cuts away; at least 3 over the number of views is asked for. Larger finds fewer blobs.
   */
  double blobChord = 0.125;
  int blobCorners = 8; ///< least number of such corners in a blob, at least 1; larger finds fewer blobs
};

/** What was repaired. */
struct SilhouetteRepair
{
  std::optional<PreparedViews> views;  ///< all views, repaired; nothing where no view needed it
  std::vector<std::uint64_t> speckles; ///< for each view, pixels that were flipped as speckles
  std::vector<std::uint64_t> blobs;    ///< for each view, pixels that were filled as blobs
  KnownVotes::Votes votes;             ///< the shell's corners' inside votes, where no view needed repair; else nothing
};

/**
 * Repair the silhouettes from which `octree` was carved. `shell` is that of its intersection octants. Throws
 * InvalidInput for an option out of range, Cancelled. Cost: a pass over the pixels, and the corners that a
 * single view rejects.
 */
SilhouetteRepair repairSilhouettes(const Octree& octree, const CornerShell& shell, const PreparedViews& views,
  const SilhouetteRepairOptions& options, Execution& execution);

} // namespace silhouette
