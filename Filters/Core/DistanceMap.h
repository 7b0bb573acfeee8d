// SPDX-License-Identifier: BSD-3-Clause
/**
 * Signed distances from a silhouette's contour, near the contour.
 */
#pragma once

#include <cstdint>
#include <vector>

namespace silhouette
{

/** Distances in pixels, positive inside, exact up to `reach` and cut off there; kept for the object's surroundings alone. */
struct DistanceMap
{
  int width = 0; ///< of the image
  int height = 0;
  int left = 0; ///< first column that is kept
  int top = 0;
  int columns = 0;
  int rows = 0;
  float reach = 0;
  std::vector<float> value; ///< rows * columns, at the pixels' centres

  /** Between the pixels' centres, bilinearly; beyond the image as far less as the image is away. */
  float at(double u, double v) const;
};

/**
 * The map of an image of 0 and 1. The contour runs between pixels: a pixel's distance is that to the nearest pixel of the other
 * kind, less half a pixel. Cost: one pass over the image, and about `reach` steps for each pixel that near to the contour.
 */
DistanceMap distanceMap(const std::uint8_t* object, int width, int height, double reach);

} // namespace silhouette
