// SPDX-License-Identifier: BSD-3-Clause
/**
 * A decoded image as this room is given it. Files are decoded elsewhere (by VTK's readers).
 */
#pragma once

#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * Eight bits a channel, interleaved, TOP row first, pixels from left to right. Channels: 1 grey; 2 grey,
 * alpha; 3 red, green, blue; 4 red, green, blue, alpha (not premultiplied). A 16-bit image is brought to 8
 * bits (its values divided by 257) by the caller.
 */
struct ColourImage
{
  int width = 0;
  int height = 0;
  int channels = 1;                 ///< 1 to 4
  std::vector<std::uint8_t> pixels; ///< width * height * channels values
};

} // namespace silhouette
