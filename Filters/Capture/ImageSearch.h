// SPDX-License-Identifier: BSD-3-Clause
/**
 * The photograph and the mask of a view in a capture's folder, by their names. No image is opened.
 */
#pragma once

#include "CameraFiles.h"

#include <filesystem>
#include <string>
#include <vector>

namespace silhouette
{

bool isFile(const std::filesystem::path& path);

/** The regular files of a folder, sorted by name; none where it cannot be read. */
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& folder);

/** Those whose names end so. */
std::vector<std::filesystem::path> filesEndingIn(const std::filesystem::path& folder, const std::string& ending);

/** Does a name end as images' names do? */
bool isImageName(const std::filesystem::path& path);

/** What a name of the camera file says within the capture's folder: "./a.png" is "a.png", and so is the folder's own path before it. */
std::filesystem::path nameWithin(const std::filesystem::path& folder, const std::string& name);

/** In images/, or else from the folder itself on; where there is none of that name, of that name with an image's extension; empty where there is none of these either. */
std::filesystem::path findPhotograph(const std::filesystem::path& folder, const NamedProjection& view);

/**
 * The files that may be a view's mask, that which is taken first: the one that the camera file names, whether it is there or not; else of image a.jpg those of
 * a.jpg, a.png, a.jpg.png and any other image of that stem in masks/ that are there (of a: a.png and so on).
 */
std::vector<std::filesystem::path> masksOf(const std::filesystem::path& folder, const NamedProjection& view);

/** The first of masksOf(); empty where there is none. */
std::filesystem::path findMask(const std::filesystem::path& folder, const NamedProjection& view);

} // namespace silhouette
