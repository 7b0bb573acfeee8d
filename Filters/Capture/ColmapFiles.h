// SPDX-License-Identifier: BSD-3-Clause
/**
 * What stands in the four files of a COLMAP model, number by number; ColmapCameras.h makes views of it.
 *
 * Text: `#` comments; `cameras.txt` has a line a camera (number, model, width, height, parameters), `images.txt` two an image (number, quaternion, translation, camera's
 * number, name; and the points, x, y and number each, maybe none). Binary: little endian, packed; a count of 8 bytes, then `cameras.bin` number 4, model's
 * number 4, width 8, height 8, parameters 8 each, `images.bin` number 4, quaternion and translation 8 each, camera's number 4, name up to a zero byte, count of points 8, points 24 each.
 *
 * A reader throws InvalidInput, naming file, line or the number of the camera or image from 1, and value. Memory grows with what has been read, whatever the file announces.
 */
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace silhouette
{

enum class ColmapLens
{
  Brown,
  Fisheye,
  NotRead
};

/** The parameters are the focal lengths, cx, cy, then the lens's coefficients in OpenCV's order. */
struct ColmapModel
{
  const char* name;
  int parameters;
  int focalLengths; ///< 1 or 2
  ColmapLens lens;
};

struct ColmapCamera
{
  std::uint32_t number = 0;
  const ColmapModel* model = nullptr; ///< never one that is not read
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  std::vector<double> parameters; ///< finite, as many as the model has
  std::string where;              ///< for messages
};

struct ColmapImage
{
  std::string name;
  std::uint32_t camera = 0;
  std::array<double, 7> pose{}; ///< finite: quaternion w, x, y, z, as stored; then the translation
  int line = 0;                 ///< 0 in binary files
  std::string where;            ///< for messages
};

std::vector<ColmapCamera> readTextColmapCameras(const std::filesystem::path& file);
std::vector<ColmapImage> readTextColmapImages(const std::filesystem::path& file);
std::vector<ColmapCamera> readBinaryColmapCameras(const std::filesystem::path& file);
std::vector<ColmapImage> readBinaryColmapImages(const std::filesystem::path& file);

} // namespace silhouette
