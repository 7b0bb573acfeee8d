// SPDX-License-Identifier: BSD-3-Clause
/**
 * The thesis's local hulls: convex parts of neighbouring slices chained as long as their 3D hull stays out of the
 * background, and one hull for each chain.
 */
#pragma once

#include "LocalHulls.h"
#include "RowIntervals.h"
#include "SliceRegions.h"

namespace silhouette
{

struct ChainOptions
{
  /**
   * Octants, 0 or more: how deep below its hull the surface of a chain may lie, wherever a lattice row passes it; larger
   * gives fewer, larger hulls that bridge more of a concavity.
   */
  double tolerance = 0.5;
  /**
   * Share, in (0, 1]: how much of the smaller of two parts in neighbouring slices the other must overlap for them to be
   * chained; larger chains less.
   */
  double overlap = 0.5;
};

/** Parts of neighbouring slices, from the first slice upwards: (slice, part). */
using PartChain = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/** Link each part with at most one above and one below, greatest overlaps first; the longest chains of links. */
std::vector<PartChain> linkParts(const SlicedVolume& volume, double overlap);

/** The points of a surface, in lattice coordinates, by the closed cells of the slices that hold them. */
class SlicePoints
{
public:
  SlicePoints(const SlicedVolume& volume, const std::vector<Eigen::Vector3d>& points);
  /** The points in the cells of a part, ascending. */
  std::vector<std::int32_t> inPart(std::size_t slice, const SliceRuns& part) const;

private:
  struct Entry
  {
    std::int32_t v, u, point;
  };
  std::vector<std::vector<Entry>> Slices; ///< ascending
};

/**
 * Does a hull in lattice coordinates hold a place on a lattice row that `solid` does not, deeper than `tolerance`? Rows tell
 * more than lattice points do, which see nothing of a concavity shallower than an octant.
 */
bool holdsOutside(const Mesh& hull, const SolidRows& solid, const Lattice& lattice, double tolerance);

/**
 * Halve the parts whose own hull would hold too much, until none does: a slice's cells see nothing of a concavity
 * shallower than a cell, nor of one across the slice.
 */
void refineParts(SlicedVolume& volume, const SlicePoints& slicePoints, const std::vector<Eigen::Vector3d>& points,
  const SolidRows& solid, const Lattice& lattice, double tolerance, Execution& execution);

/**
 * The hulls of the chains of refined parts, ordered by chain; parts whose points lie in a plane have none. `points` are the surface's, in lattice
 * coordinates, and `solid` is what it encloses. A chain is cut where its hull would hold too much; that a larger hull holds what a smaller one did makes it
 * enough to try ever longer stretches and to halve the last step. Throws InvalidInput for an option out of
 * range, Cancelled. Cost: some log(slices) Qhull runs of each point, and the rows of the hulls tried.
 */
std::vector<LocalHull> hullChains(SlicedVolume volume, const std::vector<Eigen::Vector3d>& points,
  const SolidRows& solid, const Lattice& lattice, const ChainOptions& options, Execution& execution);

} // namespace silhouette
