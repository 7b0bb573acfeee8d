// SPDX-License-Identifier: BSD-3-Clause
/**
 * COLMAP's models: cameras and images, as text or binary.
 *
 * | | |
 * | --- | --- |
 * | files | `cameras.bin` and `images.bin`, or `cameras.txt` and `images.txt`, in one folder |
 * | camera axes | right, down, forward |
 * | pose | unit quaternion w, x, y, z and t: world to camera; a quaternion of another length is brought to 1 |
 * | pixel family | corner: cx and cy become less by 0.5 |
 * | lens | SIMPLE_PINHOLE f cx cy; PINHOLE fx fy cx cy; SIMPLE_RADIAL f cx cy k1; RADIAL f cx cy k1 k2; OPENCV fx fy cx cy k1 k2 p1 p2; FULL_OPENCV the same and k3 to k6; OPENCV_FISHEYE fx fy cx cy k1 to k4; SIMPLE_RADIAL_FISHEYE f cx cy k1; RADIAL_FISHEYE f cx cy k1 k2 |
 * | size | each camera's width and height |
 * | masks | none in these files; in a capture `masks/` has them (CaptureFolder.h) |
 *
 * The points that images see are passed over. Views come sorted by their images' names: COLMAP's numbers and order tell of its threads.
 */
#pragma once

#include "CameraFiles.h"

namespace silhouette
{

/** The file of the model in `folder` that names the images, `images.bin` before `images.txt`; empty where no pair of files is there. */
std::filesystem::path colmapModelIn(const std::filesystem::path& folder);

/** Is this one of a model's four files, by its name, and of those that are text by the pair, or its first line? Where `cameras.txt` is a P list there is no pair. */
bool isColmapFile(const std::filesystem::path& file);

/**
 * Read the model of a folder, or that of one of its files. Throws InvalidInput, naming file, line or number of the camera or image, and value: the other file of a
 * pair is missing; a camera model that is not in the table; a wrong number of parameters; what is no finite number; a focal length not above 0; a size
 * that is not in 1 to 2^31 - 1; a quaternion of length 0; an image of a camera that is not there; two cameras of one number; a line of points that is none; a binary
 * file that ends early, or goes on. Cost: the files are read once, of a binary one not its points; memory: the views', whatever a file says of their number.
 */
CameraFile readColmapCameras(const std::filesystem::path& folderOrFile);

} // namespace silhouette
