// SPDX-License-Identifier: BSD-3-Clause
/**
 * Filling of silhouettes where the other views see object: pixels that points of some regions fall into.
 */
#pragma once

#include "BlockWords.h"
#include "PointCubes.h"
#include "PreparedViews.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** Corners that a view alone cuts out of the object; both ascending, no block in both. */
struct Blobs
{
  std::vector<BlockWord> words; ///< of corners, of a block one
  std::vector<PointCube> cubes;

  bool empty() const { return this->words.empty() && this->cubes.empty(); }
};

struct BlobFilling
{
  std::vector<std::uint64_t> pixels; ///< for each view, that were filled
  std::uint64_t looks = 0;           ///< at boxes and points, to find them
};

/** How far pixels are filled around blobs. */
struct BlobReach
{
  int halvings = 0; ///< of an octant: so much finer is the lattice of the points
  int steps = 0;    ///< along each axis, octants, from a blob's corners
};

/**
 * Fill in `repaired` the background pixels of each view that a point near the view's blobs falls into which every other
 * view calls object. The points are those of `fine`, a lattice about as fine as the pixels, `halvings` finer than the
 * octree's, so that the contour stays where the other views have it. Boxes of them are passed whose pixels are filled, or which another view calls background,
 * and views that see nothing but object are not asked again: cost as the regions' surface and image, in pixels. Throws Cancelled.
 */
BlobFilling fillBlobs(const LatticeViews& fine, const std::vector<Blobs>& blobs, const BlobReach& reach, std::vector<View>& repaired, Execution& execution);

} // namespace silhouette
