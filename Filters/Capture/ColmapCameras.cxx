// SPDX-License-Identifier: BSD-3-Clause
#include "ColmapCameras.h"

#include "CameraGeometry.h"
#include "ColmapFiles.h"
#include "Error.h"
#include "FileBytes.h"
#include "ImageSearch.h"
#include "TextParsing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

namespace silhouette
{

namespace
{

namespace fs = std::filesystem;

/** A camera, of the integer family. */
struct Camera
{
  Matrix3 intrinsics = Matrix3::Identity();
  std::optional<LensDistortion> lens;
  int width = 0;
  int height = 0;
};

int sizeOf(std::uint64_t length, const ColmapCamera& camera, const char* what)
{
  if (length < 1 || length > std::uint64_t(std::numeric_limits<int>::max()))
  {
    throw InvalidInput(camera.where + ": camera " + std::to_string(camera.number) + " has the " + what + " " +
                       std::to_string(length) + "; 1 to 2147483647 pixels are possible");
  }
  return int(length);
}

Camera cameraOf(const ColmapCamera& stored)
{
  const ColmapModel& model = *stored.model;
  const double fx = stored.parameters[0], fy = stored.parameters[std::size_t(model.focalLengths - 1)];
  if (!(fx > 0.0 && fy > 0.0))
  {
    throw InvalidInput(stored.where + ": camera " + std::to_string(stored.number) + " has the focal length " +
                       formatNumber(fx > 0.0 ? fy : fx) + ", which is not above 0");
  }
  Camera camera;
  camera.width = sizeOf(stored.width, stored, "width");
  camera.height = sizeOf(stored.height, stored, "height");
  const auto centre = stored.parameters.begin() + model.focalLengths;
  camera.intrinsics << fx, 0.0, centre[0] - 0.5, 0.0, fy, centre[1] - 0.5, 0.0, 0.0, 1.0;
  LensDistortion lens;
  lens.model = model.lens == ColmapLens::Fisheye ? LensDistortion::Model::Fisheye : LensDistortion::Model::Brown;
  lens.intrinsics = camera.intrinsics;
  lens.coefficients.assign(centre + 2, stored.parameters.end());
  lens.coefficients.resize(std::max<std::size_t>(lens.coefficients.size(), 4), 0.0);
  if (lens.isAny())
  {
    camera.lens = lens;
  }
  return camera;
}

std::map<std::uint32_t, Camera> camerasOf(const std::vector<ColmapCamera>& stored)
{
  std::map<std::uint32_t, Camera> cameras;
  for (const ColmapCamera& camera : stored)
  {
    if (!cameras.emplace(camera.number, cameraOf(camera)).second)
    {
      throw InvalidInput(camera.where + ": there is a camera " + std::to_string(camera.number) + " already");
    }
  }
  return cameras;
}

/** Of cameras as text the second word is a model's name; in a P list of that name it is a number. */
bool namesModels(const fs::path& cameraFile)
{
  constexpr std::size_t enough = std::size_t(64) << 10;
  std::istringstream lines(fileBeginning(cameraFile, enough));
  std::string line, number, model;
  while (std::getline(lines, line))
  {
    std::istringstream words(line);
    if (words >> number && number[0] != '#')
    {
      return !(words >> model) || !parseFinite(model);
    }
  }
  return true;
}

/** Is there the pair of files, with this extension? */
bool isModel(const fs::path& folder, const std::string& extension)
{
  const fs::path cameras = folder / ("cameras" + extension);
  return isFile(folder / ("images" + extension)) && isFile(cameras) && (extension == ".bin" || namesModels(cameras));
}

NamedProjection viewOf(const ColmapImage& image, const std::map<std::uint32_t, Camera>& cameras, const fs::path& cameraFile)
{
  const auto found = cameras.find(image.camera);
  if (found == cameras.end())
  {
    throw InvalidInput(image.where + ": image " + inQuotes(image.name) + " has camera " + std::to_string(image.camera) +
                       ", which " + cameraFile.filename().string() + " has not");
  }
  const Camera& camera = found->second;
  Eigen::Quaterniond turn(image.pose[0], image.pose[1], image.pose[2], image.pose[3]);
  const double largest = turn.coeffs().cwiseAbs().maxCoeff(); // so that no square overflows, or vanishes
  if (!(largest > 0.0))
  {
    throw InvalidInput(image.where + ": the quaternion of image " + inQuotes(image.name) + " is 0, which is no rotation");
  }
  turn.coeffs() /= largest;
  NamedProjection view;
  view.name = image.name;
  view.line = image.line;
  view.where = image.where;
  view.projection = composedProjection(camera.intrinsics, turn.normalized().toRotationMatrix(), Vector3(image.pose[4], image.pose[5], image.pose[6]),
                                       image.where + ": image " + inQuotes(image.name));
  view.lens = camera.lens;
  view.width = camera.width;
  view.height = camera.height;
  return view;
}

} // namespace

fs::path colmapModelIn(const fs::path& folder)
{
  for (const std::string extension : {".bin", ".txt"})
  {
    if (isModel(folder, extension))
    {
      return folder / ("images" + extension);
    }
  }
  return {};
}

bool isColmapFile(const fs::path& file)
{
  const std::string stem = file.stem().string(), extension = file.extension().string();
  if ((stem != "cameras" && stem != "images") || (extension != ".bin" && extension != ".txt"))
  {
    return false;
  }
  if (extension == ".bin" || isModel(file.parent_path(), extension))
  {
    return true;
  }
  const std::string expected = stem == "images" ? "# Image list with" : "# Camera list with";
  std::string start(expected.size(), '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), std::streamsize(start.size()));
  return start == expected;
}

CameraFile readColmapCameras(const fs::path& folderOrFile)
{
  std::error_code error;
  const bool isFolder = fs::is_directory(folderOrFile, error);
  const fs::path found = isFolder ? colmapModelIn(folderOrFile) : folderOrFile;
  if (found.empty())
  {
    throw InvalidInput(folderOrFile.string() + ": neither cameras.bin and images.bin nor cameras.txt and images.txt are there");
  }
  const std::string extension = found.extension().string();
  const fs::path cameraFile = fs::path(found).replace_filename("cameras" + extension);
  const fs::path imageFile = fs::path(found).replace_filename("images" + extension);
  const bool isBinary = extension == ".bin";
  const auto cameras = camerasOf(isBinary ? readBinaryColmapCameras(cameraFile) : readTextColmapCameras(cameraFile));
  CameraFile model;
  model.format = CameraFormat::Colmap;
  model.files = {cameraFile, imageFile};
  for (const ColmapImage& image : isBinary ? readBinaryColmapImages(imageFile) : readTextColmapImages(imageFile))
  {
    model.views.push_back(viewOf(image, cameras, cameraFile));
  }
  std::stable_sort(model.views.begin(), model.views.end(),
                   [](const NamedProjection& a, const NamedProjection& b) { return a.name < b.name; });
  return model;
}

} // namespace silhouette
