// SPDX-License-Identifier: BSD-3-Clause
#include "CameraFiles.h"

#include "Error.h"
#include "TextParsing.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>

namespace silhouette
{

namespace
{

std::string lineOf(const std::filesystem::path& file, int line)
{
  return file.string() + " line " + std::to_string(line);
}

/** The numbers after a line's name. */
std::vector<double> numbersOf(const std::filesystem::path& file, const TextLine& line, std::size_t count,
                              const char* meaning)
{
  if (line.tokens.size() != count + 1)
  {
    throw InvalidInput(lineOf(file, line.number) + ": expected an image name and " + std::to_string(count) +
                       " numbers (" + meaning + "), found " + std::to_string(line.tokens.size() - 1) +
                       " values after " + inQuotes(line.tokens[0]));
  }
  std::vector<double> numbers;
  for (std::size_t i = 1; i <= count; ++i)
  {
    const std::optional<double> number = parseFinite(line.tokens[i]);
    if (!number)
    {
      throw InvalidInput(lineOf(file, line.number) + ": " + inQuotes(line.tokens[i]) + " (value " +
                         std::to_string(i) + " of view " + inQuotes(line.tokens[0]) +
                         ") is not a finite number");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

Projection listedProjection(const std::filesystem::path& file, const TextLine& line)
{
  const std::vector<double> numbers = numbersOf(file, line, 12, "the 3 x 4 matrix row by row");
  return Eigen::Map<const Projection>(numbers.data());
}

Projection middleburyProjection(const std::filesystem::path& file, const TextLine& line)
{
  using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const std::vector<double> numbers = numbersOf(file, line, 21, "9 of K, 9 of R, 3 of t");
  const Matrix3 intrinsics = Eigen::Map<const Matrix3>(numbers.data());
  Projection pose;
  pose.leftCols<3>() = Eigen::Map<const Matrix3>(numbers.data() + 9);
  pose.col(3) = Eigen::Map<const Vector3>(numbers.data() + 18);
  return intrinsics * pose;
}

bool isMiddlebury(const std::filesystem::path& file, const std::vector<TextLine>& lines)
{
  const std::string name = lowerCase(file.filename().string());
  const std::string ending = "_par.txt";
  const bool named =
      name.size() >= ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  return named || (!lines.empty() && lines[0].tokens.size() == 1 && parseCount(lines[0].tokens[0]));
}

/** Take the count line away from `lines`, and hold it against them. */
void takeCount(const std::filesystem::path& file, std::vector<TextLine>& lines)
{
  if (lines.empty() || lines[0].tokens.size() != 1 || !parseCount(lines[0].tokens[0]))
  {
    const int number = lines.empty() ? 1 : lines[0].number;
    throw InvalidInput(lineOf(file, number) + ": expected the number of views, alone on the first line" +
                       (lines.empty() ? "" : ", found " + inQuotes(lines[0].tokens[0])));
  }
  const int count = *parseCount(lines[0].tokens[0]);
  const int first = lines[0].number;
  lines.erase(lines.begin());
  if (std::size_t(count) != lines.size())
  {
    throw InvalidInput(lineOf(file, first) + ": announces " + std::to_string(count) + " views, but " +
                       std::to_string(lines.size()) + " lines follow");
  }
}

void checkNames(const std::filesystem::path& file, const std::vector<NamedProjection>& views)
{
  std::map<std::string, int> lineOfName;
  for (const NamedProjection& view : views)
  {
    if (view.name.empty())
    {
      throw InvalidInput(lineOf(file, view.line) + ": the image name is empty");
    }
    const auto [found, isNew] = lineOfName.emplace(view.name, view.line);
    if (!isNew)
    {
      throw InvalidInput(lineOf(file, view.line) + ": the image name " + inQuotes(view.name) +
                         " occurs twice (first on line " + std::to_string(found->second) + ")");
    }
  }
}

/** Camera files of other programs, told by how they begin. */
void refuseForeign(const std::filesystem::path& file)
{
  static constexpr const char* Json = "JSON, as NeRF's transforms.json";
  static constexpr std::array<std::array<const char*, 2>, 11> kinds = {{{"{\n", Json}, {"{\r", Json}, {"{ ", Json}, {"{\"", Json},
                                                                       {"<?xml", "XML, as Metashape's and OpenCV's"},
                                                                       {"<opencv_storage", "OpenCV's XML"},
                                                                       {"%YAML", "YAML, as OpenCV's"},
                                                                       {"CONTOUR\n", "PMVS's, of one view"},
                                                                       {"CONTOUR\r", "PMVS's, of one view"},
                                                                       {"# Camera list with", "COLMAP's cameras.txt"},
                                                                       {"# Image list with", "COLMAP's images.txt"}}};
  std::string start(32, '\0');
  std::ifstream(file, std::ios::binary).read(&start[0], std::streamsize(start.size()));
  for (const auto& [begin, kind] : kinds)
  {
    if (start.compare(0, std::string(begin).size(), begin) == 0)
    {
      throw InvalidInput(file.string() + ": this looks like " + kind +
                         ", which is not read; a P list has a line for each view, the image's name and the 12 numbers of its 3 x 4 "
                         "matrix, row by row, from the world to pixels of the undistorted image");
    }
  }
}

} // namespace

CameraFile readCameraFile(const std::filesystem::path& file)
{
  refuseForeign(file);
  std::vector<TextLine> lines = readTextLines(file);
  CameraFile cameras;
  cameras.files = {file};
  if (isMiddlebury(file, lines))
  {
    cameras.format = CameraFormat::Middlebury;
    takeCount(file, lines);
  }
  for (const TextLine& line : lines)
  {
    const bool middlebury = cameras.format == CameraFormat::Middlebury;
    const Projection projection =
        middlebury ? middleburyProjection(file, line) : listedProjection(file, line);
    if (!projection.allFinite())
    {
      throw InvalidInput(lineOf(file, line.number) + ": K [R t] of view " + inQuotes(line.tokens[0]) +
                         " is too large to be finite");
    }
    NamedProjection view;
    view.name = line.tokens[0];
    view.line = line.number;
    view.projection = projection;
    cameras.views.push_back(std::move(view));
  }
  if (cameras.views.empty())
  {
    throw InvalidInput(file.string() + ": names no view");
  }
  checkNames(file, cameras.views);
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
  return format == CameraFormat::Middlebury ? "Middlebury" : "P list";
}

} // namespace silhouette
