// SPDX-License-Identifier: BSD-3-Clause
/** Which files of a folder are images, by their names. */
#pragma once

#include "TextParsing.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace silhouette
{

/** Does the name end as an image's does, in capitals or not? */
inline bool isImageFileName(const std::filesystem::path& file)
{
  static constexpr std::array<const char*, 10> endings = { ".png", ".pgm", ".bmp", ".tif", ".tiff", ".ppm", ".pnm", ".jpg", ".jpeg", ".gif" };
  const std::string ending = lowerCase(file.extension().string());
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

} // namespace silhouette
