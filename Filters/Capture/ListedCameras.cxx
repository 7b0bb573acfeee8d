// SPDX-License-Identifier: BSD-3-Clause
#include "ListedCameras.h"

#include "Error.h"
#include "TextParsing.h"

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

CameraFile viewsOf(const std::filesystem::path& file, const std::vector<TextLine>& lines, CameraFormat format)
{
  CameraFile cameras;
  cameras.format = format;
  cameras.freeSign = format == CameraFormat::ProjectionList;
  cameras.files = {file};
  for (const TextLine& line : lines)
  {
    NamedProjection view;
    view.name = line.tokens[0];
    view.line = line.number;
    view.projection =
        format == CameraFormat::Middlebury ? middleburyProjection(file, line) : listedProjection(file, line);
    if (!view.projection.allFinite())
    {
      throw InvalidInput(lineOf(file, line.number) + ": K [R t] of view " + inQuotes(view.name) +
                         " is too large to be finite");
    }
    cameras.views.push_back(std::move(view));
  }
  return cameras;
}

} // namespace

bool isMiddlebury(const std::filesystem::path& file, const std::string& beginning)
{
  if (endsWith(lowerCase(file.filename().string()), "_par.txt"))
  {
    return true;
  }
  const std::size_t mark = beginning.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0; // of UTF-8
  for (const std::string& line : splitText(std::string_view(beginning).substr(mark), '\n'))
  {
    const std::string text = splitText(splitText(line, '\r')[0], '#')[0];
    if (!text.empty())
    {
      return parseCount(text).has_value();
    }
  }
  return false;
}

CameraFile readProjectionList(const std::filesystem::path& file)
{
  return viewsOf(file, readTextLines(file), CameraFormat::ProjectionList);
}

CameraFile readMiddlebury(const std::filesystem::path& file)
{
  std::vector<TextLine> lines = readTextLines(file);
  takeCount(file, lines);
  return viewsOf(file, lines, CameraFormat::Middlebury);
}

} // namespace silhouette
