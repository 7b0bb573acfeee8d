// SPDX-License-Identifier: BSD-3-Clause
/**
 * The sliced volume of the thesis's local hulls (Documentation/method.md, section 4): slices of the survivors one octant
 * thick, their connected regions, and these cut into parts that are convex to a tolerance.
 */
#pragma once

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

/** Cells [from, to) of row `v` of a slice. */
struct SliceRun
{
  std::int32_t v = 0;
  std::int32_t from = 0;
  std::int32_t to = 0;

  bool operator==(const SliceRun& o) const { return v == o.v && from == o.from && to == o.to; }
};

/** Runs ascending by row and place; those of one row do not touch. */
using SliceRuns = std::vector<SliceRun>;

/** Rows run along axis (axis + 1) % 3 and are counted along (axis + 2) % 3. */
struct SlicedVolume
{
  int axis = 0;
  std::int32_t firstSlice = 0;
  std::vector<std::vector<SliceRuns>> parts; ///< for each slice from the first one, in the order of their runs
  std::uint64_t regions = 0;                 ///< connected regions before any cut
};

std::int64_t cellCount(const SliceRuns& runs);

/** How many cells two parts of slices share, seen along the axis. */
std::int64_t overlap(const SliceRuns& a, const SliceRuns& b);

/** The 4-connected regions of runs, in the order of their first runs. */
std::vector<SliceRuns> connectedRegions(const SliceRuns& runs);

/**
 * Cut a region of a slice with the given cells: where its hull reaches too deep into the background, through the deepest cell by
 * the best of eight directions, recursively. The cells on the cut belong to both sides where that makes no side less convex.
 */
std::vector<SliceRuns> convexParts(const SliceRuns& region, const SliceRuns& slice, double tolerance);

/** A part cut across the middle of its longer side, both halves with a common row of cells; itself where it is a cell. */
std::vector<SliceRuns> halves(const SliceRuns& part);

/**
 * Slice the survivors, and the leaf cells given besides (Morton codes). Throws InvalidInput for an option out of range, Cancelled.
 * Cost: linear in the survivors' rows of cells, and for each cut 24 times the runs of what is cut; memory: that of the parts.
 */
SlicedVolume sliceVolume(const Octree& octree, const std::vector<std::uint64_t>& furtherCells,
  const SliceOptions& options, Execution& execution);

} // namespace silhouette
