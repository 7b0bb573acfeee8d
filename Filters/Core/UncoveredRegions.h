// SPDX-License-Identifier: BSD-3-Clause
/**
 * Of a silhouette's uncovered pixels those of lost parts. Noise takes a skin off an object all round, which a surface may give back; a part that is
 * cut through, or far away, it does not.
 */
#pragma once

#include "View.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace silhouette
{

/** A pixel, row first, so that they are in order along the rows. */
using RowColumn = std::pair<int, int>;

/** Lengths in pixels. */
struct LostPartLimits
{
  double area = 4.0;     ///< smaller regions are specks
  double contact = 2.0;  ///< what runs along a region for less is no end and no side of it
  double distance = 1.0; ///< pixels further from all covered ones are lost
};

/**
 * How many pixels of an image lie in lost parts? `uncovered`: the object's pixels that nothing covers, in order; they are joined to regions through sides and corners. `covered`: the image's pixels, of the
 * background too, that something covers.
 *
 * A region that cuts through the object is lost, however short the gap is: one that at least two ends of what is covered and two sides of the background touch, of which holes inside the image, of less than a square of the distance, are none, nor is the image's border, beyond which the object may go on. Of other regions the pixels are lost that are
 * further from what is covered than the distance, as where a part ends. Cost: two passes over the image, and the uncovered pixels.
 */
std::uint64_t pixelsOfLostParts(const std::vector<RowColumn>& uncovered, const BinaryImage& covered, const LostPartLimits& limits);

} // namespace silhouette
