// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureFolder.h"

#include "Error.h"
#include "PreparedViews.h"
#include "TextParsing.h"
#include "ViewSelection.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

namespace silhouette
{

namespace
{

namespace fs = std::filesystem;

constexpr std::array<const char*, 10> ImageExtensions = {".png", ".pgm", ".bmp", ".tif",  ".tiff",
                                                         ".ppm", ".pnm", ".jpg", ".jpeg", ".gif"};

bool isFile(const fs::path& path)
{
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool isFolder(const fs::path& path)
{
  std::error_code error;
  return fs::is_directory(path, error);
}

bool endsWith(const std::string& text, const std::string& ending)
{
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

bool isImageName(const fs::path& path)
{
  const std::string extension = lowerCase(path.extension().string());
  return std::find(ImageExtensions.begin(), ImageExtensions.end(), extension) != ImageExtensions.end();
}

/** The regular files of a folder, sorted by name; none where it cannot be read. */
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

std::string listed(const std::vector<fs::path>& files)
{
  std::string text;
  for (const fs::path& file : files)
  {
    text += (text.empty() ? "" : ", ") + file.filename().string();
  }
  return text;
}

fs::path findCameraFile(const fs::path& folder)
{
  if (isFile(folder / "projections.txt"))
  {
    return folder / "projections.txt";
  }
  const std::vector<fs::path> parameters = filesEndingIn(folder, "_par.txt");
  if (parameters.size() == 1)
  {
    return parameters[0];
  }
  if (parameters.empty())
  {
    throw InvalidInput(folder.string() +
                       ": no camera file; looked for projections.txt (a P list) and *_par.txt (Middlebury)");
  }
  throw InvalidInput(folder.string() + ": no projections.txt, and several of *_par.txt (" +
                     listed(parameters) + "); give the camera file itself");
}

/** The file that lists the good silhouettes: of the camera file's own prefix, or the only one; else empty. */
fs::path findGoodSilhouettes(const fs::path& folder, const fs::path& cameraFile)
{
  const std::string ending = "_good_silhouette_images.txt";
  const std::string name = cameraFile.filename().string();
  if (endsWith(name, "_par.txt"))
  {
    const fs::path own = folder / (name.substr(0, name.size() - 8) + ending);
    if (isFile(own))
    {
      return own;
    }
  }
  const std::vector<fs::path> files = filesEndingIn(folder, ending);
  if (files.size() > 1)
  {
    throw InvalidInput(folder.string() + ": several of *" + ending + " (" + listed(files) +
                       "); choose the views to use instead");
  }
  return files.empty() ? fs::path() : files[0];
}

std::vector<int> goodSilhouettes(const fs::path& list, const fs::path& cameraFile,
                                 const std::vector<std::string>& names)
{
  std::set<int> good;
  for (const TextLine& line : readTextLines(list))
  {
    for (const std::string& name : line.tokens)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
      {
        throw InvalidInput(list.string() + " line " + std::to_string(line.number) + ": " + inQuotes(name) +
                           " is not a view of " + cameraFile.filename().string());
      }
      good.insert(int(found - names.begin()));
    }
  }
  if (good.empty())
  {
    throw InvalidInput(list.string() + ": names no view");
  }
  return std::vector<int>(good.begin(), good.end());
}

std::vector<std::string> namesOf(const CameraFile& cameras)
{
  std::vector<std::string> names;
  for (const NamedProjection& view : cameras.views)
  {
    names.push_back(view.name);
  }
  return names;
}

std::vector<int> usedViews(const CaptureDescription& capture, const CameraFile& cameras,
                           const CaptureOptions& options)
{
  const std::vector<std::string> names = namesOf(cameras);
  if (options.views.empty())
  {
    const fs::path list = findGoodSilhouettes(capture.folder, capture.cameraFile);
    if (!list.empty())
    {
      return goodSilhouettes(list, capture.cameraFile, names);
    }
  }
  return selectViews(options.views, names);
}

/** What a name of the camera file says within the capture's folder: "./a.png" is "a.png", and so is the folder's own path before it. */
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

fs::path findPhotograph(const fs::path& folder, const std::string& name)
{
  const fs::path within = nameWithin(folder, name);
  for (const fs::path& candidate : {folder / "images" / within, folder / within})
  {
    if (isFile(candidate))
    {
      return candidate;
    }
  }
  return {};
}

/** The files that may be the mask of an image, that which is taken first. */
std::vector<fs::path> masksOf(const fs::path& folder, const std::string& name)
{
  const fs::path within = nameWithin(folder, name), images = "images";
  const fs::path inImages = *within.begin() == images ? within.lexically_relative(images) : within;
  // Of an image that lies elsewhere the mask has its name.
  const fs::path mask = folder / "masks" / (inImages.is_relative() ? inImages : inImages.filename());
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

fs::path findMask(const fs::path& folder, const std::string& name)
{
  const std::vector<fs::path> masks = masksOf(folder, name);
  return masks.empty() ? fs::path() : masks.front();
}

CaptureEntry makeEntry(const CaptureDescription& capture, const NamedProjection& view, bool cornerFamily)
{
  const std::string where = capture.cameraFile.string() + " line " + std::to_string(view.line);
  CaptureEntry entry;
  entry.name = view.name;
  entry.photograph = findPhotograph(capture.folder, view.name);
  entry.mask = findMask(capture.folder, view.name);
  if (entry.photograph.empty() && entry.mask.empty())
  {
    throw InvalidInput(where + ": image " + inQuotes(view.name) + " is missing: neither in " +
                       capture.folder.string() +
                       " nor in its images/, and no mask of that stem in its masks/");
  }
  const int rank = projectionRank(view.projection);
  if (rank < 3)
  {
    throw InvalidInput(where + ": the projection of view " + inQuotes(view.name) + " has rank " +
                       std::to_string(rank) + "; a camera needs 3");
  }
  entry.projection = cornerFamily ? cornerToInteger(view.projection) : view.projection;
  return entry;
}

void checkMasksDiffer(const std::vector<CaptureEntry>& entries)
{
  std::map<fs::path, std::string> nameOfMask;
  for (const CaptureEntry& entry : entries)
  {
    if (!entry.mask.empty())
    {
      const auto [found, isNew] = nameOfMask.emplace(entry.mask, entry.name);
      if (!isNew)
      {
        throw InvalidInput(entry.mask.string() + ": would be the mask of both view " +
                           inQuotes(found->second) + " and view " + inQuotes(entry.name));
      }
    }
  }
}

/** Of two files that may be a view's mask, neither of them another view's, nobody knows which is meant. */
void checkMasksAreSingle(const CaptureDescription& capture, const CameraFile& cameras)
{
  std::set<fs::path> taken;
  for (const NamedProjection& view : cameras.views)
  {
    taken.insert(findMask(capture.folder, view.name));
  }
  for (const CaptureEntry& entry : capture.entries)
  {
    for (const fs::path& mask : masksOf(capture.folder, entry.name))
    {
      if (taken.count(mask) == 0)
      {
        throw InvalidInput(entry.mask.string() + " and " + mask.string() + ": either would be the mask of view " +
                           inQuotes(entry.name) + "; keep one");
      }
    }
  }
}

void warnOfUnnamedImages(CaptureDescription& capture, const CameraFile& cameras)
{
  std::set<fs::path> named;
  for (const NamedProjection& view : cameras.views)
  {
    const fs::path within = nameWithin(capture.folder, view.name);
    named.insert((capture.folder / "images" / within).lexically_normal());
    named.insert((capture.folder / within).lexically_normal());
  }
  std::vector<fs::path> unnamed;
  for (const fs::path& file : filesOf(capture.folder / "images"))
  {
    if (isImageName(file) && named.count(file.lexically_normal()) == 0)
    {
      unnamed.push_back(file);
    }
  }
  if (!unnamed.empty())
  {
    const std::string camera = capture.cameraFile.filename().string();
    capture.warnings.push_back((capture.folder / "images").string() + ": " + std::to_string(unnamed.size()) +
                               (unnamed.size() == 1 ? " image is" : " images are") + " not named in " +
                               camera + " and not used: " + inQuotes(unnamed[0].filename().string()) +
                               (unnamed.size() == 1 ? "" : " and others"));
  }
}

/** Masks that no view has found, where some view has none. */
void warnOfUnusedMasks(CaptureDescription& capture, const CameraFile& cameras)
{
  const auto lacking = std::find_if(capture.entries.begin(), capture.entries.end(), [](const CaptureEntry& entry) { return entry.mask.empty(); });
  if (lacking == capture.entries.end())
  {
    return;
  }
  std::set<fs::path> found;
  for (const NamedProjection& view : cameras.views)
  {
    found.insert(findMask(capture.folder, view.name).lexically_normal());
  }
  std::vector<fs::path> unused;
  for (const fs::path& file : filesOf(capture.folder / "masks"))
  {
    if (isImageName(file) && found.count(file.lexically_normal()) == 0)
    {
      unused.push_back(file);
    }
  }
  if (!unused.empty())
  {
    capture.warnings.push_back((capture.folder / "masks").string() + ": " + inQuotes(unused[0].filename().string()) +
                               (unused.size() == 1 ? " is" : " and others are") + " the mask of no view, and view " + inQuotes(lacking->name) +
                               " has none; a mask is called as its image is, or has its stem and the extension of another image format");
  }
}

/** Folder and camera file alone. */
CaptureDescription locateCapture(const fs::path& folderOrCameraFile)
{
  CaptureDescription capture;
  if (isFolder(folderOrCameraFile))
  {
    capture.folder = folderOrCameraFile;
    capture.cameraFile = findCameraFile(capture.folder);
  }
  else if (isFile(folderOrCameraFile))
  {
    capture.cameraFile = folderOrCameraFile;
    capture.folder = folderOrCameraFile.has_parent_path() ? folderOrCameraFile.parent_path() : fs::path(".");
  }
  else
  {
    throw InvalidInput(folderOrCameraFile.string() + ": there is no such folder or camera file");
  }
  return capture;
}

} // namespace

std::vector<std::string> captureViewNames(const fs::path& folderOrCameraFile)
{
  return namesOf(readCameraFile(locateCapture(folderOrCameraFile).cameraFile));
}

std::vector<fs::path> captureFiles(const fs::path& folderOrCameraFile)
{
  const CaptureDescription capture = locateCapture(folderOrCameraFile);
  std::vector<fs::path> files = {capture.cameraFile};
  for (const std::string& name : namesOf(readCameraFile(capture.cameraFile)))
  {
    for (const fs::path& image : {findPhotograph(capture.folder, name), findMask(capture.folder, name)})
    {
      if (!image.empty())
      {
        files.push_back(image);
      }
    }
  }
  for (const char* folder : {"images", "masks"})
  {
    const std::vector<fs::path> inFolder = filesOf(capture.folder / folder);
    files.insert(files.end(), inFolder.begin(), inFolder.end());
  }
  return files;
}

CaptureDescription describeCapture(const fs::path& folderOrCameraFile, const CaptureOptions& options)
{
  CaptureDescription capture = locateCapture(folderOrCameraFile);
  const CameraFile cameras = readCameraFile(capture.cameraFile);
  capture.format = formatName(cameras.format);
  capture.freeSign = cameras.format == CameraFormat::ProjectionList;
  for (const int view : usedViews(capture, cameras, options))
  {
    capture.entries.push_back(makeEntry(capture, cameras.views[std::size_t(view)], options.cornerFamily));
  }
  checkMasksDiffer(capture.entries);
  checkMasksAreSingle(capture, cameras);
  warnOfUnnamedImages(capture, cameras);
  warnOfUnusedMasks(capture, cameras);
  return capture;
}

} // namespace silhouette
