// SPDX-License-Identifier: BSD-3-Clause
/**
 * Image files, decoded by VTK's readers, PNG, JPEG, PNM and BMP, and by libtiff (TiffFile.h). Private to the module.
 *
 * Images may be read side by side: each has a reader of its own, and what readers share, libtiff's handlers, is set once.
 */
#pragma once

#include "vtkSmartPointer.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

class vtkImageData;

namespace silhouette::modeling
{

/**
 * An image of 8 bits a channel; 16-bit values are divided by 257, but for those of
 * an image of zeros and ones. What the reader warns of, data that is
 * damaged but was read, is added to `warnings`, naming the file; so is an Exif orientation, which is not applied. Throws InvalidInput, naming the file and
 * what the reader said: no such file, no format that is understood, an error while decoding, other than one
 * 2D image of 8 or 16 bits.
 */
vtkSmartPointer<vtkImageData> readImage(const std::filesystem::path& file,
                                        std::vector<std::string>& warnings);

/** Width and height, from the file's header alone. Throws as readImage. */
std::array<int, 2> readImageSize(const std::filesystem::path& file);

} // namespace silhouette::modeling
