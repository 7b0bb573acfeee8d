// SPDX-License-Identifier: BSD-3-Clause
/**
 * Marching cubes and voting marching cubes on the octree's last generation (Documentation/method.md, section 2;
 * equation 6.1 of the thesis).
 */
#pragma once

#include "Mesh.h"
#include "Octree.h"
#include "PreparedViews.h"

namespace silhouette
{

enum class EdgePlacement : int
{
  Middle = 0, ///< the middle of the lattice edge: the thesis
  Exact = 1,  ///< the first point along the edge, from its inside end, at which the votes fail; pixels are squares
  /**
   * The same by distances between pixels (SubPixelCrossing.h), nearer to smooth contours. In consistent mode corners
   * among intersection octants alone are labelled by distances, too (SubPixelLabels.h).
   */
  SubPixel = 2
};

enum class VotingMode : int
{
  Faithful = 0,  ///< patches from the strict octree's intersection octants at any share: opens below share 1
  Consistent = 1 ///< the octree allows exactly the background votes that the share needs: always closed
};

struct VotingOptions
{
  double share = 1.0; ///< share of the views that a corner needs, in (0, 1]; 1 is plain marching cubes
  EdgePlacement edges = EdgePlacement::Exact;
  VotingMode mode = VotingMode::Consistent;
};

/** A surface and what it was counted from. */
struct VotingSurface
{
  Mesh mesh;
  std::vector<std::array<std::uint16_t, 2>> insideVotes; ///< for each point: pixels' votes at the inside and outside end
  std::uint64_t intersectionOctants = 0; ///< of the last generation
  std::uint64_t lostNoCorner = 0;        ///< of these, the ones without an inside corner
  std::uint64_t lostAllCorners = 0;      ///< of these, the ones with eight inside corners
};

/** n: the least integer >= share * views - 1e-9, and at least 1. Throws InvalidInput outside (0, 1]. */
int requiredInsideVotes(double share, int views);

/**
 * The surface. Throws InvalidInput where the octree's views are not these (fingerprint), where the octree's
 * background votes are not what the mode and share need (the message gives the number), or Cancelled.
 * Vertices lie on lattice edges, at least 0.01 of an edge from its ends; points are in lattice order.
 */
VotingSurface votingMarchingCubes(
  const Octree& octree, const PreparedViews& views, const VotingOptions& options, Execution& execution);

} // namespace silhouette
