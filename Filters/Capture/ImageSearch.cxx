// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSearch.h"

#include "TextParsing.h"

#include <algorithm>
#include <array>

namespace silhouette
{

namespace fs = std::filesystem;

namespace
{

constexpr std::array<const char*, 10> ImageExtensions = {".png", ".pgm", ".bmp", ".tif",  ".tiff",
                                                         ".ppm", ".pnm", ".jpg", ".jpeg", ".gif"};

} // namespace

bool isFile(const fs::path& path)
{
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::vector<fs::path> filesOf(const fs::path& folder)
{
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
  {
    if (isFile(at->path()))
    {
      files.push_back(at->path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> filesEndingIn(const fs::path& folder, const std::string& ending)
{
  std::vector<fs::path> files = filesOf(folder);
  const auto differs = [&](const fs::path& file) { return !endsWith(file.filename().string(), ending); };
  files.erase(std::remove_if(files.begin(), files.end(), differs), files.end());
  return files;
}

bool isImageName(const fs::path& path)
{
  const std::string extension = lowerCase(path.extension().string());
  return std::find(ImageExtensions.begin(), ImageExtensions.end(), extension) != ImageExtensions.end();
}

fs::path nameWithin(const fs::path& folder, const std::string& name)
{
  const fs::path plain = fs::path(name).lexically_normal();
  if (plain.is_relative())
  {
    return plain;
  }
  std::error_code error;
  const fs::path relative = plain.lexically_relative(fs::absolute(folder, error).lexically_normal());
  return relative.empty() || *relative.begin() == ".." ? plain : relative;
}

fs::path findPhotograph(const fs::path& folder, const NamedProjection& view)
{
  const fs::path within = nameWithin(folder, view.name);
  std::vector<fs::path> candidates = {folder / "images" / within, folder / within};
  for (const char* extension : ImageExtensions)
  {
    candidates.push_back(folder / "images" / (within.string() + extension));
    candidates.push_back(folder / (within.string() + extension));
  }
  const auto found = std::find_if(candidates.begin(), candidates.end(), isFile);
  return found == candidates.end() ? fs::path() : *found;
}

std::vector<fs::path> masksOf(const fs::path& folder, const NamedProjection& view)
{
  if (!view.mask.empty())
  {
    return {folder / nameWithin(folder, view.mask)};
  }
  const fs::path within = nameWithin(folder, view.name), images = "images";
  const fs::path inImages = *within.begin() == images ? within.lexically_relative(images) : within;
  // Of an image that lies elsewhere the mask has its name.
  const fs::path mask = folder / "masks" / (inImages.is_relative() && *inImages.begin() != ".." ? inImages : inImages.filename());
  std::vector<fs::path> candidates = {mask, fs::path(mask).replace_extension(".png"),
                                      fs::path(mask.string() + ".png")};
  for (const char* extension : ImageExtensions)
  {
    candidates.push_back(fs::path(mask).replace_extension(extension));
  }
  std::vector<fs::path> masks;
  for (const fs::path& candidate : candidates)
  {
    if (isFile(candidate) && std::find(masks.begin(), masks.end(), candidate) == masks.end())
    {
      masks.push_back(candidate);
    }
  }
  return masks;
}

fs::path findMask(const fs::path& folder, const NamedProjection& view)
{
  const std::vector<fs::path> masks = masksOf(folder, view);
  return masks.empty() ? fs::path() : masks.front();
}

} // namespace silhouette
