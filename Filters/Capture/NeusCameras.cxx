// SPDX-License-Identifier: BSD-3-Clause
#include "NeusCameras.h"

#include "CameraGeometry.h"
#include "Error.h"
#include "ImageSearch.h"
#include "NumpyArchive.h"
#include "TextParsing.h"

#include <algorithm>
#include <initializer_list>

namespace silhouette
{
namespace
{

namespace fs = std::filesystem;

const std::string Matrix = "world_mat_"; // and its number

/** world_mat_7 has 7; scale_mat_7 and world_mat_inv_7 have none. */
std::optional<int> numberOf(const std::string& array)
{
  const std::string digits = array.compare(0, Matrix.size(), Matrix) == 0 ? array.substr(Matrix.size()) : std::string();
  return digits.empty() ? std::nullopt : parseCount(digits);
}

struct ImageFolder
{
  std::string name;               ///< of the first of some folders that has images
  std::vector<std::string> paths; ///< of the images, from the capture's folder, sorted
};

ImageFolder imagesIn(const fs::path& folder, std::initializer_list<const char*> names)
{
  for (const char* name : names)
  {
    ImageFolder images;
    images.name = name;
    std::error_code error;
    for (fs::directory_iterator at(folder / name, error), end; !error && at != end; at.increment(error))
    {
      std::error_code ignored;
      const std::string file = at->path().filename().string();
      if (isImageName(at->path()) && file[0] != '.' && fs::is_regular_file(at->path(), ignored))
      {
        images.paths.push_back(name + ("/" + file));
      }
    }
    std::sort(images.paths.begin(), images.paths.end());
    if (!images.paths.empty())
    {
      return images;
    }
  }
  return {};
}

std::vector<Projection> readMatrices(const fs::path& file)
{
  const std::map<std::string, NumpyArray> arrays = readNumpyArchive(file, [](const std::string& name) { return numberOf(name).has_value(); });
  std::vector<Projection> matrices;
  for (std::size_t i = 0; i < std::max<std::size_t>(arrays.size(), 1); ++i)
  {
    const std::string name = Matrix + std::to_string(i);
    const auto found = arrays.find(name);
    if (found == arrays.end())
    {
      throw InvalidInput(file.string() + ": has no " + name + (arrays.empty() ? "" : ", but " + std::to_string(arrays.size()) + " of its kind"));
    }
    const std::string where = file.string() + " array " + inQuotes(name);
    const NumpyArray& array = found->second;
    if (array.shape != std::vector<std::size_t>{ 4, 4 } && array.shape != std::vector<std::size_t>{ 3, 4 })
    {
      std::string shape;
      for (const std::size_t along : array.shape)
      {
        shape += (shape.empty() ? "" : " x ") + std::to_string(along);
      }
      throw InvalidInput(where + ": is " + (shape.empty() ? "a single number" : shape) + "; 4 x 4 is needed");
    }
    matrices.emplace_back(Eigen::Map<const Projection>(array.values.data()));
    if (!matrices.back().allFinite())
    {
      throw InvalidInput(where + ": holds a number that is not finite");
    }
  }
  return matrices;
}

void checkCount(const fs::path& file, const ImageFolder& images, std::size_t count)
{
  if (!images.paths.empty() && images.paths.size() != count)
  {
    throw InvalidInput(file.string() + ": has " + std::to_string(count) + " matrices, but the folder " + images.name + " " +
                       std::to_string(images.paths.size()) + " images");
  }
}

} // namespace

std::optional<fs::path> neusFile(const fs::path& path)
{
  std::error_code error;
  if (fs::is_regular_file(path, error))
  {
    return lowerCase(path.extension().string()) == ".npz" ? std::optional(path) : std::nullopt;
  }
  for (const char* name : { "cameras_sphere.npz", "cameras.npz" })
  {
    if (fs::is_regular_file(path / name, error))
    {
      return path / name;
    }
  }
  return std::nullopt;
}

CameraFile readNeusCameras(const fs::path& path)
{
  const std::optional<fs::path> file = neusFile(path);
  if (!file)
  {
    throw InvalidInput(path.string() + ": is neither an .npz file nor a folder with cameras_sphere.npz or cameras.npz");
  }
  const std::vector<Projection> matrices = readMatrices(*file);
  const ImageFolder images = imagesIn(file->parent_path(), { "image", "images", "rgb" });
  const ImageFolder masks = imagesIn(file->parent_path(), { "mask", "masks" });
  checkCount(*file, images, matrices.size());
  checkCount(*file, masks, matrices.size());
  if (images.paths.empty() && masks.paths.empty())
  {
    throw InvalidInput(file->string() + ": there are images neither in image, images or rgb nor in mask or masks beside it");
  }
  CameraFile cameras;
  cameras.format = CameraFormat::Neus;
  cameras.files = { *file };
  for (std::size_t i = 0; i < matrices.size(); ++i)
  {
    NamedProjection view;
    view.name = images.paths.empty() ? masks.paths[i] : images.paths[i];
    view.mask = masks.paths.empty() ? std::string() : masks.paths[i];
    view.projection = matrices[i];
    cameras.views.push_back(std::move(view));
  }
  return cameras;
}

} // namespace silhouette
