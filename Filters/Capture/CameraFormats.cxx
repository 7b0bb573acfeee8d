// SPDX-License-Identifier: BSD-3-Clause
#include "CameraFormats.h"

#include "ColmapCameras.h"
#include "Error.h"
#include "ImageSearch.h"
#include "ListedCameras.h"
#include "MetashapeCameras.h"
#include "NeusCameras.h"
#include "OpenCVCameras.h"
#include "PmvsCameras.h"
#include "TextParsing.h"
#include "TransformsCameras.h"

#include <algorithm>
#include <array>
#include <fstream>

namespace silhouette
{

namespace
{

namespace fs = std::filesystem;

std::vector<fs::path> firstOf(const std::vector<fs::path>& candidates)
{
  const auto found = std::find_if(candidates.begin(), candidates.end(), isFile);
  return found == candidates.end() ? std::vector<fs::path>() : std::vector<fs::path>{*found};
}

std::vector<fs::path> projectionListsIn(const fs::path& folder)
{
  return firstOf({folder / "projections.txt"});
}

std::vector<fs::path> middleburyFilesIn(const fs::path& folder)
{
  return filesEndingIn(folder, "_par.txt");
}

std::vector<fs::path> transformsIn(const fs::path& folder)
{
  return firstOf({folder / "transforms.json", folder / "transforms_train.json"});
}

std::vector<fs::path> colmapModelsIn(const fs::path& folder)
{
  return firstOf({colmapModelIn(folder), colmapModelIn(folder / "sparse"), colmapModelIn(folder / "sparse" / "0")});
}

std::vector<fs::path> openCVFilesIn(const fs::path& folder)
{
  std::vector<fs::path> candidates;
  for (const char* packed : {"", ".gz"})
  {
    for (const char* ending : {".yml", ".yaml", ".xml", ".json"})
    {
      candidates.push_back(folder / ("cameras" + std::string(ending) + packed));
    }
  }
  const auto isOther = [](const fs::path& file) { return !isFile(file) || !isOpenCVCameras(file); };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), isOther), candidates.end());
  return candidates;
}

std::vector<fs::path> metashapeFilesIn(const fs::path& folder)
{
  std::vector<fs::path> files = filesOf(folder);
  const auto isOther = [](const fs::path& file) { return lowerCase(file.extension().string()) != ".xml" || !isMetashapeCameras(file); };
  files.erase(std::remove_if(files.begin(), files.end(), isOther), files.end());
  return files;
}

std::vector<fs::path> pmvsFilesIn(const fs::path& folder)
{
  const auto capture = pmvsFolder(folder);
  return capture ? std::vector<fs::path>{pmvsCameraFiles(*capture).front()} : std::vector<fs::path>(); // any of them stands for all
}

std::vector<fs::path> neusFilesIn(const fs::path& folder)
{
  const auto file = neusFile(folder);
  return file ? std::vector<fs::path>{*file} : std::vector<fs::path>();
}

fs::path ownFolder(const fs::path& file)
{
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/** So many folders above. */
fs::path above(fs::path folder, int count)
{
  for (int n = 0; n < count; ++n)
  {
    folder /= "..";
  }
  folder = folder.lexically_normal();
  return folder.has_filename() ? folder : folder.parent_path(); // without a slash at its end
}

/** A model lies in the capture's folder, in its folder `sparse`, or in a folder of that. */
fs::path folderOfColmap(const fs::path& file)
{
  std::error_code error;
  const fs::path model = ownFolder(file);
  const fs::path full = above(fs::absolute(model, error), 0); // "." has no name of its own
  return full.filename() == "sparse" ? above(model, 1) : full.parent_path().filename() == "sparse" ? above(model, 2) : model;
}

/** Files that begin as a format's that is read, but are none of its camera files, are refused; anything else may be a list. */
bool isProjectionList(const fs::path& file, const std::string& beginning)
{
  static constexpr const char* Json = "JSON, without a list \"frames\", \"views\" or \"cameras\"";
  static constexpr std::array<std::array<const char*, 2>, 8> kinds = {{{"{\n", Json}, {"{\r", Json}, {"{ ", Json}, {"{\"", Json},
                                                                      {"<?xml", "XML, but neither OpenCV's nor a chunk of Metashape's"},
                                                                      {"<opencv_storage", "OpenCV's XML"},
                                                                      {"CONTOUR\n", "a camera of PMVS's, but it lies in no folder txt"},
                                                                      {"CONTOUR\r", "a camera of PMVS's, but it lies in no folder txt"}}};
  for (const auto& [begin, kind] : kinds)
  {
    if (beginning.compare(0, std::string(begin).size(), begin) == 0)
    {
      throw InvalidInput(file.string() + ": this looks like " + kind +
                         "; it is not read. A P list has a line for each view, the image's name and the 12 numbers of its 3 x 4 "
                         "matrix, row by row, from the world to pixels of the undistorted image");
    }
  }
  return true;
}

/** JSON with a list `frames` may be either's. */
bool isOpenCVNotTransforms(const fs::path& file, const std::string& beginning)
{
  const bool isNamedTransforms = lowerCase(file.filename().string()).compare(0, 10, "transforms") == 0;
  return isOpenCVCameras(file) && !(isNamedTransforms && isTransforms(beginning));
}

} // namespace

const std::vector<CameraFormatTraits>& cameraFormats()
{
  static const std::vector<CameraFormatTraits> formats = {
      {CameraFormat::ProjectionList, "P list", "projections.txt (a P list)", "", projectionListsIn, isProjectionList, ownFolder,
       readProjectionList},
      {CameraFormat::Middlebury, "Middlebury", "*_par.txt (Middlebury)", "", middleburyFilesIn, isMiddlebury, ownFolder, readMiddlebury},
      {CameraFormat::Transforms, "transforms.json", "transforms.json, transforms_train.json (NeRF, nerfstudio)", "corner", transformsIn,
       [](const fs::path&, const std::string& beginning) { return isTransforms(beginning); }, ownFolder, readTransformsCameras},
      {CameraFormat::Colmap, "COLMAP", "cameras and images, .bin or .txt, in it, in its sparse or sparse/0 (COLMAP)", "corner", colmapModelsIn,
       [](const fs::path& file, const std::string&) { return isColmapFile(file); }, folderOfColmap, readColmapCameras},
      {CameraFormat::OpenCv, "OpenCV", "cameras.yml, .yaml, .xml or .json (OpenCV)", "integer", openCVFilesIn, isOpenCVNotTransforms, ownFolder, readOpenCVCameras},
      {CameraFormat::Metashape, "Metashape", "*.xml (Metashape)", "corner", metashapeFilesIn,
       [](const fs::path& file, const std::string&) { return isMetashapeCameras(file); }, ownFolder, readMetashapeCameras},
      {CameraFormat::Pmvs, "PMVS", "txt/00000000.txt (PMVS)", "integer", pmvsFilesIn,
       [](const fs::path& file, const std::string&) { return isPmvsCameras(file); }, [](const fs::path& file) { return pmvsFolder(file).value_or(ownFolder(file)); },
       readPmvsCameras},
      {CameraFormat::Neus, "NeuS", "cameras_sphere.npz, cameras.npz (NeuS, IDR)", "integer", neusFilesIn,
       [](const fs::path& file, const std::string&) { return neusFile(file).has_value(); }, ownFolder, readNeusCameras},
  };
  return formats;
}

const CameraFormatTraits& traitsOf(CameraFormat format)
{
  const auto& formats = cameraFormats();
  return *std::find_if(formats.begin(), formats.end(), [&](const CameraFormatTraits& one) { return one.format == format; });
}

const CameraFormatTraits& formatOf(const fs::path& file)
{
  std::string beginning(std::size_t(64) << 10, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(beginning.data(), std::streamsize(beginning.size()));
  beginning.resize(std::size_t(stream.gcount()));
  const auto& formats = cameraFormats();
  return *std::find_if(formats.rbegin(), formats.rend(), [&](const CameraFormatTraits& one) { return one.fits(file, beginning); });
}

} // namespace silhouette
