// SPDX-License-Identifier: BSD-3-Clause
/**
 * The two camera files that are understood, as text: what they say of each view, before any image is looked
 * for. Numbers are row by row.
 *
 * | format | lines | pixel family | sign of w |
 * | --- | --- | --- | --- |
 * | P list | a view: image name, 12 numbers of the 3 x 4 matrix P | integer | free |
 * | Middlebury | number of views; a view: image name, 9 of K, 9 of R, 3 of t | integer | w > 0 in front |
 *
 * Middlebury's matrix is P = K [R t], camera axes right, down, forward. Neither format states its pixel family:
 * integer is the default, CaptureOptions::cornerFamily the choice.
 *
 * Blank lines, `#` comments, Windows line endings and a UTF-8 byte order mark are accepted in both.
 */
#pragma once

#include "View.h"

#include <filesystem>
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
  int line = 0;     ///< counted from 1
  Projection projection = Projection::Zero();
};

struct CameraFile
{
  CameraFormat format = CameraFormat::ProjectionList;
  std::vector<NamedProjection> views; ///< at least one, names differ
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
