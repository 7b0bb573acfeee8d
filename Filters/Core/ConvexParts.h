// SPDX-License-Identifier: BSD-3-Clause
/**
 * Regions of a slice, as runs of cells, and their cutting into parts that are convex to a tolerance.
 */
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

namespace silhouette
{

/** Cells [from, to) of row `v` of a slice. */
struct SliceRun
{
  std::int32_t v = 0;
  std::int32_t from = 0;
  std::int32_t to = 0;

  bool operator==(const SliceRun& o) const { return v == o.v && from == o.from && to == o.to; }
  bool operator<(const SliceRun& o) const { return std::tie(v, from, to) < std::tie(o.v, o.from, o.to); }
};

/** Runs ascending by row and place; those of one row do not touch. */
using SliceRuns = std::vector<SliceRun>;

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

} // namespace silhouette
