// SPDX-License-Identifier: BSD-3-Clause
/**
 * TIFF images by libtiff itself: vtkTIFFReader of VTK 9.1 turns those upside down whose first row is the top, as nearly all are, and
 * mistakes compressed ones. Private to the module.
 */
#pragma once

#include "vtkSmartPointer.h"

#include <array>
#include <filesystem>

class vtkImageData;

namespace silhouette::modeling
{

/** Whether a file begins as a TIFF file does. */
bool isTiffFile(const std::filesystem::path& file);

/**
 * The image, 8 bits a channel: grey, grey and opacity, colours, or colours and opacity (by which libtiff has multiplied them); of
 * 16 bits the upper 8, but for grey of zeros and ones. Throws
 * InvalidInput, naming the file, for what is damaged, of a kind that libtiff does not turn into colours, or turned by a right angle, and where
 * there are several images of full size.
 */
vtkSmartPointer<vtkImageData> readTiff(const std::filesystem::path& file);

/** Width and height. Throws as readTiff. */
std::array<int, 2> readTiffSize(const std::filesystem::path& file);

} // namespace silhouette::modeling
