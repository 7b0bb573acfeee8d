// SPDX-License-Identifier: BSD-3-Clause
/**
 * The formats of camera files, one row each: how a file or a folder is told to be of it, where its images lie, its reader.
 */
#pragma once

#include "CameraFiles.h"

#include <filesystem>
#include <string>
#include <vector>

namespace silhouette
{

struct CameraFormatTraits
{
  CameraFormat format;
  const char* name;          ///< in words, for people
  const char* lookedFor;     ///< the files that filesIn() looks for, in words
  const char* pixelFamily;   ///< that the format states: "corner", "integer"; empty where it states none
  /** The camera files of this format in a capture's folder. None: the next format is looked for; several: nobody knows which is meant. */
  std::vector<std::filesystem::path> (*filesIn)(const std::filesystem::path& folder);
  /** Is a file that was given by its own path, and that begins like this, of this format? Asked from the last row to the first, which takes what is left. */
  bool (*fits)(const std::filesystem::path& file, const std::string& beginning);
  /** The folder that the names of images and masks count from. */
  std::filesystem::path (*captureFolder)(const std::filesystem::path& file);
  CameraFile (*read)(const std::filesystem::path& file);
};

/** All formats, in the order in which a folder is searched for them. */
const std::vector<CameraFormatTraits>& cameraFormats();

const CameraFormatTraits& traitsOf(CameraFormat format);

/** The format of a camera file, from its name and its first 64 KiB. A file that cannot be read is a P list, whose reader says so. Throws InvalidInput where it begins as a
 * format's that is read, but is none of its camera files. */
const CameraFormatTraits& formatOf(const std::filesystem::path& file);

} // namespace silhouette
