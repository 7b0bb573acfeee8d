// SPDX-License-Identifier: BSD-3-Clause
#include "PmvsCameras.h"

#include "CameraGeometry.h"
#include "Error.h"
#include "FileBytes.h"
#include "ImageSearch.h"
#include "TextParsing.h"

#include <algorithm>
#include <map>

namespace silhouette
{
namespace
{

namespace fs = std::filesystem;

bool isEightDigits(const std::string& stem)
{
  return stem.size() == 8 && std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/** The files of a folder whose stems have eight digits, by stem; none where there is no such folder. */
template <typename IsWanted> std::multimap<std::string, fs::path> numberedFiles(const fs::path& folder, const IsWanted& isWanted)
{
  std::multimap<std::string, fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
  {
    const fs::path& file = at->path();
    std::error_code ignored;
    if (isEightDigits(file.stem().string()) && isWanted(file) && fs::is_regular_file(file, ignored))
    {
      files.emplace(file.stem().string(), file);
    }
  }
  return files;
}

Projection readProjection(const fs::path& file)
{
  const std::vector<TextLine> lines = readTextLines(file);
  if (lines.empty() || lines[0].tokens != std::vector<std::string>{ "CONTOUR" })
  {
    const std::string found = lines.empty() ? std::string() : lines[0].tokens[0];
    throw InvalidInput(file.string() + " line " + std::to_string(lines.empty() ? 1 : lines[0].number) + ": expected CONTOUR, " +
                       (lines.empty() ? "found nothing" : "found " + inQuotes(found)) +
                       (found == "CONTOUR2" || found == "CONTOUR3" ? ", whose cameras are no 3 x 4 matrices and are not read" : ""));
  }
  std::vector<double> numbers;
  for (auto line = lines.begin() + 1; line != lines.end(); ++line)
  {
    for (const std::string& token : line->tokens)
    {
      const std::optional<double> number = parseFinite(token);
      if (!number)
      {
        throw InvalidInput(file.string() + " line " + std::to_string(line->number) + ": " + inQuotes(token) + " is not a finite number");
      }
      numbers.push_back(*number);
    }
  }
  if (numbers.size() != 12)
  {
    throw InvalidInput(file.string() + ": expected the 12 numbers of the 3 x 4 matrix after CONTOUR, found " + std::to_string(numbers.size()));
  }
  return Eigen::Map<const Projection>(numbers.data());
}

/** Of one view, as a path from the capture's folder; empty where it has none. */
std::string fileOf(const fs::path& folder, const std::multimap<std::string, fs::path>& files, const fs::path& camera, const std::string& what)
{
  const auto [first, last] = files.equal_range(camera.stem().string());
  if (first == last)
  {
    return {};
  }
  if (std::next(first) != last)
  {
    throw InvalidInput(camera.string() + ": has the " + what + "s " + inQuotes(first->second.filename().string()) + " and " +
                       inQuotes(std::next(first)->second.filename().string()) + "; one is needed");
  }
  return first->second.lexically_relative(folder).generic_string();
}

} // namespace

std::vector<fs::path> pmvsCameraFiles(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& [stem, file] : numberedFiles(folder / "txt", [](const fs::path& one) { return one.extension() == ".txt"; }))
  {
    files.push_back(file);
  }
  return files;
}

std::optional<fs::path> pmvsFolder(const fs::path& path)
{
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  if (error)
  {
    return std::nullopt;
  }
  const fs::path named = whole.has_filename() ? whole : whole.parent_path(); // without a slash at its end
  const bool isFolder = fs::is_directory(named, error);
  const fs::path txt = isFolder ? named : named.parent_path();
  const fs::path folder = txt.filename() == "txt" ? txt.parent_path() : isFolder ? named : fs::path();
  if (folder.empty() || (!isFolder && !isEightDigits(named.stem().string())))
  {
    return std::nullopt;
  }
  const std::vector<fs::path> cameras = pmvsCameraFiles(folder);
  const bool begins = !cameras.empty() && withoutLeadingBlanks(fileBeginning(cameras[0], 64)).substr(0, 7) == "CONTOUR";
  return begins ? std::optional(folder) : std::nullopt;
}

bool isPmvsCameras(const fs::path& path)
{
  return pmvsFolder(path).has_value();
}

CameraFile readPmvsCameras(const fs::path& path)
{
  const std::optional<fs::path> folder = pmvsFolder(path);
  if (!folder)
  {
    throw InvalidInput(path.string() + ": has no folder txt with cameras of PMVS (00000000.txt, which begins with CONTOUR)");
  }
  const auto images = numberedFiles(*folder / "visualize", isImageName);
  const auto masks = numberedFiles(*folder / "masks", isImageName);
  CameraFile cameras;
  cameras.format = CameraFormat::Pmvs;
  cameras.freeSign = true;
  cameras.files = pmvsCameraFiles(*folder);
  for (const fs::path& file : cameras.files)
  {
    NamedProjection view;
    view.projection = readProjection(file);
    view.name = fileOf(*folder, images, file, "image");
    view.mask = fileOf(*folder, masks, file, "mask");
    if (view.name.empty() && view.mask.empty())
    {
      throw InvalidInput(file.string() + ": there is neither an image visualize/" + file.stem().string() + ".* nor a mask masks/" +
                         file.stem().string() + ".*");
    }
    view.name = view.name.empty() ? view.mask : view.name;
    cameras.views.push_back(std::move(view));
  }
  return cameras;
}

} // namespace silhouette
