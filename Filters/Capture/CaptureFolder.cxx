// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureFolder.h"

#include "CameraFormats.h"
#include "Error.h"
#include "ImageSearch.h"
#include "PreparedViews.h"
#include "TextParsing.h"
#include "ViewSelection.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace silhouette
{

namespace
{

namespace fs = std::filesystem;

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
  std::string lookedFor;
  for (const CameraFormatTraits& format : cameraFormats())
  {
    const std::vector<fs::path> files = format.filesIn(folder);
    if (files.size() > 1)
    {
      throw InvalidInput(folder.string() + ": several of " + format.lookedFor + ": " + listed(files) +
                         (lookedFor.empty() ? "" : "; and no " + lookedFor) + "; give the camera file itself");
    }
    if (files.size() == 1)
    {
      return files[0];
    }
    lookedFor += (lookedFor.empty() ? "" : ", ") + std::string(format.lookedFor);
  }
  throw InvalidInput(folder.string() + ": no camera file; looked for " + lookedFor);
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

/** The view, with what its image's size tells of its camera. */
NamedProjection completed(const NamedProjection& view, const CaptureEntry& entry, const std::string& where, const CaptureOptions& options)
{
  if (!view.ofSize)
  {
    return view;
  }
  if (!options.sizeOf)
  {
    throw InvalidInput(where + ": the camera file does not say the image's size");
  }
  const std::array<int, 2> size = options.sizeOf(entry.photograph.empty() ? entry.mask : entry.photograph);
  return view.ofSize(size[0], size[1]);
}

CaptureEntry makeEntry(const CaptureDescription& capture, const NamedProjection& named, const CaptureOptions& options)
{
  const std::string where = placeOf(named, capture.cameraFile);
  CaptureEntry entry;
  entry.name = named.name;
  entry.photograph = findPhotograph(capture.folder, named);
  entry.mask = findMask(capture.folder, named);
  if (!entry.mask.empty() && !isFile(entry.mask))
  {
    throw InvalidInput(where + ": the mask " + inQuotes(named.mask) + " of view " + inQuotes(named.name) + " is missing: there is no " + entry.mask.string());
  }
  if (entry.photograph.empty() && entry.mask.empty())
  {
    throw InvalidInput(where + ": image " + inQuotes(named.name) + " is missing: neither in " +
                       capture.folder.string() +
                       " nor in its images/, and no mask of that stem in its masks/");
  }
  const NamedProjection view = completed(named, entry, where, options);
  const int rank = projectionRank(view.projection);
  if (rank < 3)
  {
    throw InvalidInput(where + ": the projection of view " + inQuotes(view.name) + " has rank " +
                       std::to_string(rank) + "; a camera needs 3");
  }
  entry.projection = options.cornerFamily ? cornerToInteger(view.projection) : view.projection;
  entry.lens = view.lens;
  entry.width = view.width;
  entry.height = view.height;
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
    taken.insert(findMask(capture.folder, view));
  }
  std::set<std::string> used;
  std::transform(capture.entries.begin(), capture.entries.end(), std::inserter(used, used.end()), [](const CaptureEntry& entry) { return entry.name; });
  for (const NamedProjection& view : cameras.views)
  {
    for (const fs::path& mask : masksOf(capture.folder, view))
    {
      if (used.count(view.name) > 0 && taken.count(mask) == 0)
      {
        throw InvalidInput(findMask(capture.folder, view).string() + " and " + mask.string() + ": either would be the mask of view " +
                           inQuotes(view.name) + "; keep one");
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
    named.insert(findPhotograph(capture.folder, view).lexically_normal()); // of a name without an ending
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
    found.insert(findMask(capture.folder, view).lexically_normal());
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
  std::error_code error;
  const bool isFolder = fs::is_directory(folderOrCameraFile, error);
  if (!isFolder && !isFile(folderOrCameraFile))
  {
    throw InvalidInput(folderOrCameraFile.string() + ": there is no such folder or camera file");
  }
  CaptureDescription capture;
  capture.cameraFile = isFolder ? findCameraFile(folderOrCameraFile) : folderOrCameraFile;
  capture.folder = formatOf(capture.cameraFile).captureFolder(capture.cameraFile);
  return capture;
}

} // namespace

std::vector<std::string> captureViewNames(const fs::path& folderOrCameraFile)
{
  return namesOf(readCameraFile(locateCapture(folderOrCameraFile).cameraFile));
}

std::string statedPixelFamily(const fs::path& folderOrCameraFile)
{
  return formatOf(locateCapture(folderOrCameraFile).cameraFile).pixelFamily;
}

std::vector<fs::path> captureFiles(const fs::path& folderOrCameraFile)
{
  const CaptureDescription capture = locateCapture(folderOrCameraFile);
  const CameraFile cameras = readCameraFile(capture.cameraFile);
  std::vector<fs::path> files = cameras.files;
  for (const NamedProjection& view : cameras.views)
  {
    for (const fs::path& image : {findPhotograph(capture.folder, view), findMask(capture.folder, view)})
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
  const CameraFormatTraits& traits = traitsOf(cameras.format);
  if (options.cornerFamily && *traits.pixelFamily)
  {
    throw InvalidInput(capture.cameraFile.string() + ": its format, " + traits.name + ", states its pixel family, " + traits.pixelFamily +
                       "; the corner family is a choice for formats that state none");
  }
  capture.format = traits.name;
  capture.freeSign = cameras.freeSign;
  capture.warnings = cameras.warnings;
  for (const int view : usedViews(capture, cameras, options))
  {
    capture.entries.push_back(makeEntry(capture, cameras.views[std::size_t(view)], options));
  }
  checkMasksDiffer(capture.entries);
  checkMasksAreSingle(capture, cameras);
  warnOfUnnamedImages(capture, cameras);
  warnOfUnusedMasks(capture, cameras);
  return capture;
}

} // namespace silhouette
