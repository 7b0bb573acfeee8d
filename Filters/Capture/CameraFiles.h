// SPDX-License-Identifier: BSD-3-Clause
/**
 * The camera files that are understood, as text or numbers: what they say of each view, before any image is looked for.
 *
 * | format | file | what it says of a view | pixel family of the file | sign of w |
 * | --- | --- | --- | --- | --- |
 * | P list | `projections.txt`, or any text | image name, 12 numbers of the 3 x 4 matrix P | not stated | free |
 * | Middlebury | `*_par.txt` | image name, 9 of K, 9 of R, 3 of t; the first line is the number of views | not stated | w > 0 in front |
 *
 * Middlebury's matrix is P = K [R t], camera axes right, down, forward. Where a format does not state its pixel family
 * integer is the default, CaptureOptions::cornerFamily the choice.
 *
 * Blank lines, `#` comments, Windows line endings and a UTF-8 byte order mark are accepted in both.
 */
#pragma once

#include "LensDistortion.h"
#include "View.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace silhouette
{

enum class CameraFormat
{
  ProjectionList,
  Middlebury
};

/** One view of a camera file. */
struct NamedProjection
{
  std::string name; ///< of the image, as in the file
  int line = 0;     ///< counted from 1; 0 where the file has no lines to speak of
  Projection projection = Projection::Zero(); ///< of the undistorted image; of the integer family where the format states one
  std::string mask;  ///< the mask's file, where the camera file names one
  std::optional<LensDistortion> lens; ///< what has to be taken out of the image, where there is any
  int width = 0;  ///< px of the image that the camera is for; 0 where the file does not say
  int height = 0;
};

struct CameraFile
{
  CameraFormat format = CameraFormat::ProjectionList;
  std::vector<NamedProjection> views; ///< at least one, names differ
  std::vector<std::filesystem::path> files; ///< all that were read
};

/**
 * Read a camera file: Middlebury where its name ends in `_par.txt` or its first line is a single whole
 * number, else a P list. Throws InvalidInput, naming file, line and value: a wrong number of numbers on a
 * line, something that is not a finite number, a name that occurs twice, a count that differs from the lines,
 * no view at all.
 */
CameraFile readCameraFile(const std::filesystem::path& file);

/** Bring a projection onto corner-family pixels ((0.5, 0.5) is the first pixel's centre) to the integer
 * family. */
Projection cornerToInteger(const Projection& projection);

/** The format in words, for people. */
std::string formatName(CameraFormat format);

} // namespace silhouette
