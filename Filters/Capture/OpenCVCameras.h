// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cameras in a file as OpenCV's FileStorage writes: YAML, XML or JSON, packed with gzip or not (StorageTree.h). Plain JSON and YAML by hand of that shape are
 * read, too.
 *
 * | camera axes X, Y, Z | what is stored | pixel family | distortion | masks |
 * | --- | --- | --- | --- | --- |
 * | right, down, forward | K, R, t, the world to the camera; or P | integer | OpenCV's 4, 5, 8, 12 or 14 coefficients, or 4 of its fisheye model | none |
 *
 * The file has one sequence, `views`, `cameras` or `frames`, of maps. These keys are known, the first one found counts:
 *
 * | meaning | keys | shape | where |
 * | --- | --- | --- | --- |
 * | image name | `image`, `name`, `file`, `file_name` | text | view |
 * | K | `camera_matrix`, `cameraMatrix`, `K` | 3 x 3 | view, else the file's top |
 * | R | `R`, `rotation_matrix`, `rvec`, `rotation_vector` | 3 x 3, or the 3 of a rotation vector | view |
 * | t | `t`, `T`, `tvec`, `translation_vector` | 3 | view |
 * | P | `projection_matrix`, `P` | 3 x 4 | view |
 * | distortion | `distortion_coefficients`, `distCoeffs`, `dist` | the coefficients; none or zeros: no distortion | view, else top |
 * | its model | `fisheye_model` | not 0: fisheye | view, else top |
 * | image size | `image_width` and `image_height`, `width` and `height` | whole numbers | view, else top |
 *
 * A matrix is OpenCV's own (`rows`, `cols`, `data`), a sequence of rows, or one of all numbers row by row. Where a view has K, R
 * and t these count. P by itself has a free sign, and then the file has (CameraFile::freeSign). With a distortion P needs K, and
 * has to be a multiple of K [R t] with a rotation R: else nobody knows the image that it is of.
 */
#pragma once

#include "CameraFiles.h"

namespace silhouette
{

/**
 * Does the file begin as one of OpenCV's, or is it YAML by its ending, or JSON, with such a sequence and no `transform_matrix`? Looks at
 * 64 KiB; false where there is no such file.
 */
bool isOpenCVCameras(const std::filesystem::path& file);

/**
 * Read it. Throws InvalidInput, naming file, view and value: what StorageTree.h throws; none
 * of these sequences; a view without a name; a matrix of another shape, a number that is not finite; K that is
 * not fx s cx, 0 fy cy, 0 0 1; R that is no rotation; a number of coefficients that the model does not have. Cost: linear in the file.
 */
CameraFile readOpenCVCameras(const std::filesystem::path& file);

} // namespace silhouette
