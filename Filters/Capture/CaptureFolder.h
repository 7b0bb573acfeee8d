// SPDX-License-Identifier: BSD-3-Clause
/**
 * From a folder to a list of views: which camera file, which photograph, which mask, which matrix. No image
 * is opened here.
 *
 * Camera files, the first of these that is there (CameraFormats.h):
 *
 *     FOLDER/projections.txt          a P list
 *     FOLDER/NAME_par.txt             Middlebury, if it is the only one
 *     FOLDER/transforms.json          or else transforms_train.json
 *     FOLDER/images.bin, cameras.bin  COLMAP, or images.txt and cameras.txt; or else in FOLDER/sparse, or else in FOLDER/sparse/0
 *
 * Any camera file may be given by its own path. Names count from its folder; those of a COLMAP model in `sparse`, or in a folder of
 * that, from the folder above `sparse`.
 *
 *     FOLDER/images/a.jpg             the photographs; or FOLDER/a.jpg
 *     FOLDER/masks/a.png              the masks: a.jpg itself, a.png, a.jpg.png, or any other image of that
 *                                     stem; but the file that the camera file names, where it names one
 *     FOLDER/NAME_good_silhouette_images.txt   (optional) the names of the views to use
 *
 * A photograph or a mask is enough. Masks that lie beside the camera file under the very names that it gives
 * are taken as photographs here; that they have two values is seen when they are opened.
 */
#pragma once

#include "CameraFiles.h"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace silhouette
{

struct CaptureOptions
{
  /** Views to use, as selectViews reads them ("0,3,5-9", names); empty: all, or the good silhouettes where
   * listed. */
  std::string views;
  /** The file's pixel coordinates put the first pixel's centre at (0.5, 0.5); else at (0, 0). */
  bool cornerFamily = false;
  /** Width and height of an image file, px, where a camera follows from them and the camera file does not say them; may throw InvalidInput.
   * Without it such a capture is refused. */
  std::function<std::array<int, 2>(const std::filesystem::path&)> sizeOf;
};

struct CaptureEntry
{
  std::string name;                           ///< of the image, as in the camera file
  std::filesystem::path photograph;           ///< may be empty where there is a mask
  std::filesystem::path mask;                 ///< may be empty where there is a photograph
  Projection projection = Projection::Zero(); ///< integer family; as in the file where its sign is free; of the undistorted image
  std::optional<LensDistortion> lens;         ///< what has to be taken out of photograph and mask, where there is any
  int width = 0;                              ///< px that photograph and mask have to have; 0 where the camera file does not say
  int height = 0;
};

struct CaptureDescription
{
  std::filesystem::path folder;
  std::filesystem::path cameraFile;
  std::string format;                ///< in words: "P list", "COLMAP"
  bool freeSign = false;             ///< the matrices' signs are free: orient them (ProjectiveCameras.h)
  std::vector<CaptureEntry> entries; ///< the views used, in the file's order; at least one
  std::vector<std::string> warnings;
};

/** Names of all views of the camera file, in its order. Throws InvalidInput as describeCapture(), where it finds or reads no camera file. */
std::vector<std::string> captureViewNames(const std::filesystem::path& folderOrCameraFile);

/** The pixel family that the camera file's format states, "corner" or "integer"; empty where it states none. Throws as captureViewNames(), where it finds no camera file. */
std::string statedPixelFamily(const std::filesystem::path& folderOrCameraFile);

/**
 * All files that the cameras are read from, the photographs and masks of all its views, as far as they are there, and what else lies in images/ and masks/. Throws InvalidInput as
 * captureViewNames().
 */
std::vector<std::filesystem::path> captureFiles(const std::filesystem::path& folderOrCameraFile);

/**
 * Describe the capture in a folder, or that of a camera file. Throws InvalidInput, naming file, line or view,
 * and value: no or several camera files; whatever CameraFiles.h throws; the corner family asked for of a format that states its own; a selection that fits no view; and of
 * the views used: neither photograph nor mask, two masks, a mask that the camera file names and that is missing, a mask shared by two, a projection of rank below 3. Warns of
 * images in images/ that the camera file does not name.
 */
CaptureDescription describeCapture(const std::filesystem::path& folderOrCameraFile,
                                   const CaptureOptions& options = {});

} // namespace silhouette
