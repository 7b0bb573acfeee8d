// SPDX-License-Identifier: BSD-3-Clause
/**
 * Captures of IDR, NeuS and those that read their folders.
 *
 * | camera axes X, Y, Z | what is stored | pixel family | distortion | masks |
 * | --- | --- | --- | --- | --- |
 * | right, down, forward | `world_mat_i`, 4 x 4 (or 3 x 4), K [R t] above a fourth row; w > 0 in front | integer | none | by sorted order, object above 127.5 |
 *
 *     FOLDER/cameras_sphere.npz     or cameras.npz
 *     FOLDER/image                  or images, or rgb: view i is the i-th of the image files, by their names' bytes
 *     FOLDER/mask                   or masks, likewise; may be absent
 *
 * P is the first three rows of world_mat_i. `scale_mat_i`, which brings a unit sphere onto the object, is not looked at: the mesh
 * is to be in the world, and there it has no part in the matrices. Names and masks are paths from FOLDER: `image/000.png`. Without
 * images the masks' names stand for them.
 */
#pragma once

#include "CameraFiles.h"

#include <optional>

namespace silhouette
{

/** FOLDER/cameras_sphere.npz or else FOLDER/cameras.npz of a folder, an .npz file itself; nothing where there is none. Never throws InvalidInput. */
std::optional<std::filesystem::path> neusFile(const std::filesystem::path& path);

/**
 * Read the capture of such a path. Throws InvalidInput, naming file, array and value: what NumpyArchive.h throws; no world_mat_0, or
 * a gap in their numbers; another shape; a number that is not finite; neither images nor masks; images or masks of another number
 * than matrices (both numbers are named). Cost: the archive is read, two folders are listed.
 */
CameraFile readNeusCameras(const std::filesystem::path& path);

} // namespace silhouette
