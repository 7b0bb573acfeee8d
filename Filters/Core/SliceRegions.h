// SPDX-License-Identifier: BSD-3-Clause
/**
 * The sliced volume of the thesis's local hulls (Documentation/method.md, section 4): slices of the survivors one octant
 * thick, their connected regions, and these cut into parts that are convex to a tolerance.
 */
#pragma once

#include "ConvexParts.h"
#include "Execution.h"
#include "Octree.h"

#include <vector>

namespace silhouette
{

struct SliceOptions
{
  /**
   * 0, 1 or 2: slices are perpendicular to x, y or z; -1: the axis with the fewest parts a slice, of equal ones the one
   * along which the object is longest.
   */
  int axis = -1;
  /**
   * Octants, 0 or more: how deep below the 2D hull of a part's cell centres a background cell's centre may lie; larger gives
   * fewer parts, and hulls that bridge more of a concavity.
   */
  double tolerance = 0.5;
};

/** Rows run along axis (axis + 1) % 3 and are counted along (axis + 2) % 3. */
struct SlicedVolume
{
  int axis = 0;
  std::int32_t firstSlice = 0;
  std::vector<std::vector<SliceRuns>> parts; ///< for each slice from the first one, in the order of their runs
  std::uint64_t regions = 0;                 ///< connected regions before any cut
};

/**
 * Slice the survivors, and the leaf cells given besides (Morton codes). Throws InvalidInput for an option out of range, Cancelled.
 * Cost: linear in the survivors' rows of cells, and for each cut 24 times the runs of what is cut; memory: that of the parts.
 */
SlicedVolume sliceVolume(const Octree& octree, const std::vector<std::uint64_t>& furtherCells,
  const SliceOptions& options, Execution& execution);

} // namespace silhouette
