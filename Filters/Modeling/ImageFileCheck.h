// SPDX-License-Identifier: BSD-3-Clause
/**
 * A look at an image file before VTK's reader opens it. Some readers do not survive a broken file: the PNG
 * reader jumps to a stack frame that is gone, the PNM reader waits forever for a number, the JPEG reader
 * fills what is missing with grey. Private to the module.
 */
#pragma once

#include <filesystem>
#include <string>

namespace silhouette::modeling
{

/**
 * What is wrong with a PNG, JPEG or PNM file, in words; empty where nothing is, or where it is none of these.
 * PNG: every chunk is known, whole, in its place and has its checksum, and the pixels are all there; JPEG: the
 * image has an end; PNM: binary, 8 bits, and of its full length. Cost: the file is read once, a PNG's pixels are
 * decompressed.
 */
std::string imageFileFault(const std::filesystem::path& file);

} // namespace silhouette::modeling
