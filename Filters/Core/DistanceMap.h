// SPDX-License-Identifier: BSD-3-Clause
/**
 * Signed distances from a silhouette's contour, near the contour.
 */
#pragma once

#include <algorithm>
#include <cmath>
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
  /** For each block of 8 x 8 pixels and those before it in both directions, how many are not wholly at the reach. */
  std::vector<std::int32_t> blocksNear;

  /** Between the pixels' centres, bilinearly; beyond the image as far less as the image is away. */
  float at(double u, double v) const
  {
    if (this->value.empty())
    {
      return -this->reach;
    }
    // Beyond the part that is kept there is only background.
    const double x = std::clamp(u - this->left, 0.0, double(this->columns - 1));
    const double y = std::clamp(v - this->top, 0.0, double(this->rows - 1));
    const int c = std::min(int(x), std::max(this->columns - 2, 0));
    const int r = std::min(int(y), std::max(this->rows - 2, 0));
    const int right = this->columns > 1 ? 1 : 0;
    const std::size_t below = this->rows > 1 ? std::size_t(this->columns) : 0;
    const float s = float(x - c), t = float(y - r);
    const float* p = &this->value[std::size_t(r) * this->columns + c];
    const float inner = (p[0] * (1 - s) + p[right] * s) * (1 - t) + (p[below] * (1 - s) + p[below + right] * s) * t;
    const double dx = u - this->left - x, dy = v - this->top - y;
    return dx == 0.0 && dy == 0.0 ? inner : std::max(-this->reach, inner - float(std::sqrt(dx * dx + dy * dy)));
  }

  /** Is the value, but for rounding, the whole reach everywhere between these places? May say no where it is. Cost: four look-ups. */
  bool farInside(double firstU, double lastU, double firstV, double lastV) const;
};

/**
 * The map of an image of 0 and 1. The contour runs between pixels: a pixel's distance is that to the nearest pixel of the other
 * kind, less half a pixel. Cost: one pass over the image, and about `reach` steps for each pixel that near to the contour.
 */
DistanceMap distanceMap(const std::uint8_t* object, int width, int height, double reach);

} // namespace silhouette
