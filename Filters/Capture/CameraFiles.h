// SPDX-License-Identifier: BSD-3-Clause
/**
 * What camera files say of each view, before any image is looked for.
 *
 * | format | reader | pixel family of the file | sign of w | lens, size, masks |
 * | --- | --- | --- | --- | --- |
 * | P list | ListedCameras.h | not stated | free | |
 * | Middlebury | ListedCameras.h | not stated | w > 0 in front | |
 * | transforms.json of NeRF, Blender, nerfstudio | TransformsCameras.h | corner | w > 0 in front | lens, size, masks |
 * | COLMAP | ColmapCameras.h | corner | w > 0 in front | lens, size |
 * | OpenCV | OpenCVCameras.h | integer | w > 0 in front, of P alone free | lens, size |
 * | Metashape | MetashapeCameras.h | corner | w > 0 in front | lens, size |
 * | PMVS | PmvsCameras.h | integer | free | masks |
 * | NeuS, IDR | NeusCameras.h | integer | w > 0 in front | masks |
 *
 * Where a format states its pixel family its reader brings the matrices to the integer family; where it does not,
 * integer is the default and CaptureOptions::cornerFamily the choice. How one format is told from another
 * stands in CameraFormats.h.
 */
#pragma once

#include "LensDistortion.h"
#include "View.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace silhouette
{

enum class CameraFormat
{
  ProjectionList,
  Middlebury,
  Transforms,
  Colmap,
  OpenCv,
  Metashape,
  Pmvs,
  Neus
};

/** One view of a camera file. */
struct NamedProjection
{
  std::string name; ///< of the image, as in the file
  int line = 0;     ///< counted from 1; 0 where the file has no lines to speak of
  std::string where; ///< file, and line or place in it, for messages; empty where the camera file and `line` say it
  Projection projection = Projection::Zero(); ///< of the undistorted image; of the integer family where the format states one
  std::string mask;  ///< the mask's file, from the capture's folder on, where the camera file names one
  std::optional<LensDistortion> lens; ///< what has to be taken out of the image, where there is any
  int width = 0;  ///< px of the image that the camera is for; 0 where the file does not say
  int height = 0;
  /** Where the camera follows from the image's size, which the file does not say: the view of an image of that width and height, px.
   * `projection` is zero until then. */
  std::function<NamedProjection(int width, int height)> ofSize;
};

struct CameraFile
{
  CameraFormat format = CameraFormat::ProjectionList;
  std::vector<NamedProjection> views; ///< at least one, names differ
  std::vector<std::filesystem::path> files; ///< all that were read
  bool freeSign = false; ///< the signs of the matrices are free: w may be negative before the camera
  std::vector<std::string> warnings; ///< what was left out, and why
};

/**
 * Read a camera file, of the format that formatOf() (CameraFormats.h) tells. Throws InvalidInput, naming file, line or view, and value:
 * whatever the format's reader throws, a name that is empty or occurs twice, no view at all.
 */
CameraFile readCameraFile(const std::filesystem::path& file);

/** Where a camera file speaks of a view, for messages: the file, and its line where there is one. */
std::string placeOf(const NamedProjection& view, const std::filesystem::path& file);

/** Bring a projection onto corner-family pixels ((0.5, 0.5) is the first pixel's centre) to the integer
 * family. */
Projection cornerToInteger(const Projection& projection);

/** The format in words, for people. */
std::string formatName(CameraFormat format);

} // namespace silhouette
