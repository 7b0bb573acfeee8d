// SPDX-License-Identifier: BSD-3-Clause
#include "CameraFiles.h"

#include "CameraFormats.h"
#include "Error.h"
#include "TextParsing.h"

#include <map>

namespace silhouette
{

namespace
{

void checkNames(const CameraFile& cameras, const std::filesystem::path& file)
{
  std::map<std::string, const NamedProjection*> viewOfName;
  for (const NamedProjection& view : cameras.views)
  {
    if (view.name.empty())
    {
      throw InvalidInput(placeOf(view, file) + ": the image name is empty");
    }
    const auto [found, isNew] = viewOfName.emplace(view.name, &view);
    if (!isNew)
    {
      throw InvalidInput(placeOf(view, file) + ": the image name " + inQuotes(view.name) + " occurs twice (first in " +
                         placeOf(*found->second, file) + ")");
    }
  }
}

} // namespace

std::string placeOf(const NamedProjection& view, const std::filesystem::path& file)
{
  return !view.where.empty() ? view.where : view.line > 0 ? file.string() + " line " + std::to_string(view.line) : file.string();
}

CameraFile readCameraFile(const std::filesystem::path& file)
{
  CameraFile cameras = formatOf(file).read(file);
  if (cameras.views.empty())
  {
    throw InvalidInput(file.string() + ": names no view");
  }
  checkNames(cameras, file);
  return cameras;
}

Projection cornerToInteger(const Projection& projection)
{
  Projection integer = projection;
  integer.row(0) -= 0.5 * projection.row(2);
  integer.row(1) -= 0.5 * projection.row(2);
  return integer;
}

std::string formatName(CameraFormat format)
{
  return traitsOf(format).name;
}

} // namespace silhouette
