// SPDX-License-Identifier: BSD-3-Clause
/**
 * The folder that PMVS (Furukawa and Ponce 2010) reads.
 *
 * | camera axes X, Y, Z | what is stored | pixel family | distortion | masks |
 * | --- | --- | --- | --- | --- |
 * | projective | the 3 x 4 matrix P, free scale and sign | integer | none | `masks/%08d.pgm`, object above 127 |
 *
 *     FOLDER/txt/00000000.txt              CONTOUR, then the 12 numbers of P row by row; a view a file
 *     FOLDER/visualize/00000000.jpg        its image, of any ending
 *     FOLDER/masks/00000000.pgm            its mask, where there is one, of any ending
 *
 * Views are in the order of their numbers, which may have gaps; other files in `txt` are not looked at. Names and masks are
 * paths from FOLDER: `visualize/00000000.jpg`. Where a view has no image its mask's name stands for it. `silhouettes`, which
 * other data sets bring along, are not read: their polarity is not stated.
 */
#pragma once

#include "CameraFiles.h"

#include <optional>

namespace silhouette
{

/**
 * FOLDER of a path that is it, its `txt`, or a camera file in that, and whose first camera file begins with CONTOUR; nothing
 * of any other path. Lists one folder and opens one file. Never throws InvalidInput.
 */
std::optional<std::filesystem::path> pmvsFolder(const std::filesystem::path& path);

/** The camera files of FOLDER, by their numbers; none where there is no folder `txt`. Never throws InvalidInput. */
std::vector<std::filesystem::path> pmvsCameraFiles(const std::filesystem::path& folder);

/** Is it one of these three? */
bool isPmvsCameras(const std::filesystem::path& path);

/**
 * Read all views of such a path. Throws InvalidInput, naming file, line and value: no such folder; a first line that is not
 * CONTOUR (CONTOUR2 and CONTOUR3 hold other parameters, and are refused by name); not 12 finite numbers; several images or masks
 * of a view, neither of them. Cost: a file a view.
 */
CameraFile readPmvsCameras(const std::filesystem::path& path);

} // namespace silhouette
