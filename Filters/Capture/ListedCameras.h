// SPDX-License-Identifier: BSD-3-Clause
/**
 * Camera files with a line for each view: P lists and Middlebury's.
 *
 * | format | file | what it says of a view |
 * | --- | --- | --- |
 * | P list | `projections.txt`, or any text | image name, 12 numbers of the 3 x 4 matrix P, row by row |
 * | Middlebury | `*_par.txt` | image name, 9 of K, 9 of R, 3 of t: P = K [R t], camera axes right, down, forward; the first line is the number of views |
 *
 * Neither states its pixel family. Blank lines, `#` comments, Windows line endings and a UTF-8 byte order mark are
 * accepted in both; a name with blanks, or that begins with `#`, stands in double quotes.
 */
#pragma once

#include "CameraFiles.h"

namespace silhouette
{

/** Does the file's name end in `_par.txt`, or is the first line of what it begins with a single whole number? */
bool isMiddlebury(const std::filesystem::path& file, const std::string& beginning);

/**
 * Read a P list, or Middlebury's file. Throw InvalidInput, naming file, line and value: a wrong number of numbers on a line, something that is
 * not a finite number, a count that differs from the lines.
 */
CameraFile readProjectionList(const std::filesystem::path& file);
CameraFile readMiddlebury(const std::filesystem::path& file);

} // namespace silhouette
