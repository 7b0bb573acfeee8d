// SPDX-License-Identifier: BSD-3-Clause
/**
 * Pictures of surfaces, put side by side, as small PNG files.
 */
#pragma once

#include "vtkPolyData.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace silhouette::experiments
{

/** Red, green, blue, row 0 at the top. */
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels; ///< 3 * width * height
};

/** How a surface is shown: z upwards, the origin in the middle, from a fixed direction, in soft light. */
struct Look
{
  int side = 180;          ///< pixels
  double halfHeight = 1.2; ///< world units from the middle to the upper side
  std::array<double, 3> colour = {0.87, 0.84, 0.76};
  bool flat = false; ///< faces as they are, with their edges; else smooth
  std::string above; ///< text at the upper side
  std::string below; ///< text at the lower side
};

/** The inner side is red: seen through holes, or where a surface is inside out. */
Picture pictureOf(vtkPolyData* surface, const Look& look);

Picture sideBySide(const std::vector<Picture>& pictures);
Picture stacked(const std::vector<Picture>& pictures);

/** A PNG of the 256 colours that suit the picture. Throws InvalidInput where it cannot be written. */
void writePng(const Picture& picture, const std::filesystem::path& file);

} // namespace silhouette::experiments
