// SPDX-License-Identifier: BSD-3-Clause
/**
 * transforms.json: the cameras of NeRF's captures, of Blender's add-ons for these, instant-ngp and nerfstudio.
 *
 * | | |
 * | --- | --- |
 * | files | `transforms.json`, or any JSON with a list `frames` |
 * | camera axes | right, UP, BACK |
 * | pose | `transform_matrix`, camera to world, 4 (or 3) rows |
 * | pixel family | corner: cx and cy become less by 0.5 |
 * | focal lengths, px | `fl_x`, else w / 2 / tan(`camera_angle_x` / 2); `fl_y`, else from `camera_angle_y` and h, else as in x |
 * | principal point, px | `cx`, `cy`, else the image's middle |
 * | size, px | `w`, `h`, else the image's own |
 * | lens | `camera_model` PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, or none: Brown's k1 k2 p1 p2 k3; OPENCV_FISHEYE, or `is_fisheye`: k1 to k4 |
 * | image | `file_path`, from the file's folder on; `.png` is added where it has no image's extension |
 * | masks | `mask_path`, from the file's folder on |
 *
 * Of all keys but the last two and the pose a frame's own goes before that of the whole file.
 */
#pragma once

#include "CameraFiles.h"

namespace silhouette
{

/** Does text that begins so look like this format: an object of JSON with "frames"? */
bool isTransforms(const std::string& beginning);

/**
 * Read the file. Where a view needs the image's size and the file does not say it, the view's `ofSize` makes it. Throws InvalidInput, naming file, frame (from 0, as in
 * the list) and image, and value: no JSON, larger than 64 MiB, no list of frames, a key that is missing or of another type, a matrix that is no rigid motion, a focal length or a
 * size not above 0, an angle not between 0 and pi, a camera model that is not in the table, a coefficient that is not 0 and that the model does not have.
 */
CameraFile readTransformsCameras(const std::filesystem::path& file);

} // namespace silhouette
