// SPDX-License-Identifier: BSD-3-Clause
/**
 * Carving as strictly as the silhouettes bear. Parts thinner than the noise of cameras and contours are cut
 * by a strict carve, and no surface brings back what the octree lacks; what is then missing shows in the
 * silhouettes (UncoveredShare.h). The remedies are background votes, and where they do not do it, silhouettes
 * dilated by a few pixels.
 */
#pragma once

#include "UncoveredShare.h"

#include <functional>
#include <memory>
#include <vector>

namespace silhouette
{

struct CarvingToleranceOptions
{
  int backgroundVotes = 0; ///< k to begin with, 0 to views - 1
  /**
   * Share of the object's pixels, 0 to 1: a mean over the views of at most this is borne; larger leaves more
   * uncovered before any tolerance is taken.
   */
  double uncoveredShare = 0.001;
  /**
   * Share of the views, 0 to below 1: at most so many background votes are tried; larger forgives more, and
   * grows the object.
   */
  double voteShare = 0.1;
  /**
   * Octants, 0 to 10: dilation by at most so much, in whole pixels, is tried; larger forgives more, and grows
   * the object. Half an octant is about what the lattice can tell.
   */
  double greatestDilation = 0.5;
  UncoveredShareOptions measure;
};

/** An octree and what it was carved with. */
struct TolerantCarving
{
  Octree octree;                              ///< octree.backgroundVotes is k
  std::shared_ptr<const PreparedViews> views; ///< those given, or dilated
  std::vector<View> dilatedViews;             ///< what `views` was made from; empty where nothing was dilated
  int dilation = 0;                           ///< px
  /** mean share that k to begin with leaves uncovered, of the views given */
  double strictUncovered = 0.0;
  double uncovered = 0.0;                     ///< the same of this octree
  int leastCoveredView = 0;                   ///< the view with the largest share, the first of several
  double greatestUncovered = 0.0;             ///< its share
  int carves = 1;                             ///< how many octrees were carved to find it
};

/** Makes an octree of views, with the background votes given. */
using Carve = std::function<Octree(const PreparedViews& views, int backgroundVotes, Execution& execution)>;

/**
 * Find the least tolerance with which the mean uncovered share is borne: background votes from those given
 * upwards; if the most are too few, these and a dilation of 1 px and up. Where nothing that is allowed brings
 * it down so far, it is the most votes, else the most of both, if that leaves at most half of the share, and
 * else the carving as strict as it was.
 *
 * A strict carving that is borne costs one carve and one measure; else the least is found by doubling and
 * halving. What `carve` throws of the strict octree is thrown on, but where nothing survives of silhouettes that are
 * not empty: that counts as all uncovered, and is thrown where no tolerance helps. Throws InvalidInput for an option out of range, Cancelled.
 */
TolerantCarving carveTolerantly(std::shared_ptr<const PreparedViews> views, const Carve& carve,
  const CarvingToleranceOptions& options, Execution& execution);

/** The views with object in every pixel that has some within `radius` + 0.5 pixels of its centre. */
std::vector<View> dilatedSilhouettes(const PreparedViews& views, int radius, Execution& execution);

} // namespace silhouette
