// SPDX-License-Identifier: BSD-3-Clause
/**
 * A look at an image file before VTK's reader opens it. Some readers do not survive a broken file: the PNG
 * reader jumps to a stack frame that is gone, the PNM reader waits forever for a number, the JPEG reader
 * fills what is missing with grey, the BMP reader does not survive pixels of one bit. Private to the module.
 */
#pragma once

#include <filesystem>
#include <string>

namespace silhouette::modeling
{

/** What of a file is going to be read. */
enum class ImageFileScope
{
  Header, ///< a PNG's pixels are not decompressed
  Whole
};

struct ImageFileReport
{
  std::string fault;   ///< in words; empty where nothing is wrong, or nobody knows
  int orientation = 1; ///< 1 to 8, as Exif has it: how the image is to be turned to be upright
};

/**
 * What is wrong with a PNG, JPEG, PNM or BMP file, and how it is to be turned, which PNG and JPEG files may tell.
 * PNG: every chunk is known, whole, in its place and has its checksum, and the pixels are all there; JPEG: the
 * image has an end, and is of grey or three colours; PNM: binary, 8 bits, and of its full length; BMP: 8 or 24 bits
 * a pixel, not compressed, and of its full length. Cost: the file is read once, a PNG's pixels are decompressed.
 */
ImageFileReport inspectImageFile(const std::filesystem::path& file, ImageFileScope scope);

} // namespace silhouette::modeling
