// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCVCameras.h"

#include "CameraGeometry.h"
#include "Error.h"
#include "FileBytes.h"
#include "StorageTree.h"
#include "TextParsing.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace silhouette
{
namespace
{

using Kind = StorageNode::Kind;
using Keys = std::initializer_list<const char*>;

const StorageNode& find(const StorageNode& view, const StorageNode& top, Keys keys)
{
  const StorageNode& own = view.find(keys);
  return own.is(Kind::Nothing) ? top.find(keys) : own;
}

struct Numbers
{
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;
};

void append(Numbers& numbers, const StorageNode& node, const std::string& what)
{
  if (!node.is(Kind::Number))
  {
    throw InvalidInput(what + " holds " + (node.is(Kind::Text) ? inQuotes(node.text) : "something") + ", which is not a number");
  }
  const double value = node.number;
  if (!std::isfinite(value))
  {
    throw InvalidInput(what + " holds " + formatNumber(value) + ", which is not a finite number");
  }
  numbers.values.push_back(value);
}

/** A sequence of numbers, one row, or of sequences of numbers, a row each. */
Numbers numbersOfSequence(const StorageNode& sequence, const std::string& what)
{
  Numbers numbers;
  for (const auto& [key, row] : sequence.members)
  {
    if (!row.is(Kind::Sequence))
    {
      append(numbers, row, what);
      continue;
    }
    for (const auto& [none, number] : row.members)
    {
      append(numbers, number, what);
    }
    ++numbers.rows;
    if (numbers.values.size() != numbers.rows * row.members.size())
    {
      throw InvalidInput(what + ": row " + std::to_string(numbers.rows - 1) + " has " + std::to_string(row.members.size()) +
                         " numbers, not as many as the first");
    }
  }
  numbers.rows = std::max<std::size_t>(numbers.rows, 1);
  numbers.columns = numbers.values.size() / numbers.rows;
  if (numbers.rows * numbers.columns != numbers.values.size())
  {
    throw InvalidInput(what + " has numbers beside its rows");
  }
  return numbers;
}

/** Of a sequence, or of a matrix that says how many numbers follow. */
Numbers numbersOf(const StorageNode& node, const std::string& what)
{
  if (node.is(Kind::Sequence))
  {
    return numbersOfSequence(node, what);
  }
  const StorageNode &rows = node.find({ "rows" }), &columns = node.find({ "cols" }), &data = node.find({ "data" });
  const bool isEmpty = data.is(Kind::Nothing) && rows.number * columns.number == 0.0;
  if (!rows.is(Kind::Number) || !columns.is(Kind::Number) || !(data.is(Kind::Sequence) || isEmpty))
  {
    throw InvalidInput(what + " is neither a sequence of numbers nor a matrix with rows, cols and data");
  }
  Numbers numbers = numbersOfSequence(data, what);
  const double announced = rows.number * columns.number;
  if (rows.number < 0 || columns.number < 0 || announced != double(numbers.values.size()))
  {
    throw InvalidInput(what + " announces " + formatNumber(rows.number) + " x " + formatNumber(columns.number) + " numbers, but " +
                       std::to_string(numbers.values.size()) + " follow");
  }
  numbers.rows = std::size_t(rows.number);
  numbers.columns = std::size_t(columns.number);
  return numbers;
}

/** Of that shape, or of one row or column with as many numbers. */
bool isOfShape(const Numbers& numbers, std::size_t rows, std::size_t columns)
{
  return numbers.values.size() == rows * columns &&
    ((numbers.rows == rows && numbers.columns == columns) || numbers.rows == 1 || numbers.columns == 1);
}

[[noreturn]] void refuseShape(const Numbers& numbers, const std::string& what, const std::string& needed)
{
  throw InvalidInput(what + " is " + std::to_string(numbers.rows) + " x " + std::to_string(numbers.columns) + " numbers; " + needed +
                     " are needed");
}

Matrix3 intrinsicsOf(const StorageNode& node, const std::string& where)
{
  const Numbers numbers = numbersOf(node, where + ": K");
  if (!isOfShape(numbers, 3, 3))
  {
    refuseShape(numbers, where + ": K", "3 x 3");
  }
  return checkedIntrinsics(Eigen::Map<const Matrix3>(numbers.values.data()), where);
}

Matrix3 rotationOf(const StorageNode& node, const std::string& where)
{
  const Numbers numbers = numbersOf(node, where + ": R");
  if (isOfShape(numbers, 3, 1))
  {
    return rotationAbout(Vector3(numbers.values.data()));
  }
  if (!isOfShape(numbers, 3, 3))
  {
    refuseShape(numbers, where + ": R", "3 x 3, or the 3 of a rotation vector");
  }
  return checkedRotation(Eigen::Map<const Matrix3>(numbers.values.data()), where);
}

Vector3 translationOf(const StorageNode& node, const std::string& where)
{
  const Numbers numbers = numbersOf(node, where + ": t");
  if (!isOfShape(numbers, 3, 1))
  {
    refuseShape(numbers, where + ": t", "3");
  }
  return Vector3(numbers.values.data());
}

Projection projectionOf(const StorageNode& node, const std::string& where)
{
  const Numbers numbers = numbersOf(node, where + ": P");
  if (!isOfShape(numbers, 3, 4))
  {
    refuseShape(numbers, where + ": P", "3 x 4");
  }
  return Eigen::Map<const Projection>(numbers.values.data());
}

bool isFisheye(const StorageNode& view, const StorageNode& top, const std::string& where)
{
  const StorageNode& node = find(view, top, { "fisheye_model" });
  if (!node.is(Kind::Nothing) && !node.is(Kind::Number))
  {
    throw InvalidInput(where + ": fisheye_model is not a number");
  }
  return !node.is(Kind::Nothing) && node.number != 0.0;
}

/** What the lens does, K left open; nothing where it does nothing. */
std::optional<LensDistortion> distortionOf(const StorageNode& view, const StorageNode& top, const std::string& where)
{
  const StorageNode& node = find(view, top, { "distortion_coefficients", "distCoeffs", "dist" });
  LensDistortion lens;
  lens.model = isFisheye(view, top, where) ? LensDistortion::Model::Fisheye : LensDistortion::Model::Brown;
  const bool fisheye = lens.model == LensDistortion::Model::Fisheye;
  lens.coefficients = node.is(Kind::Nothing) ? std::vector<double>() : numbersOf(node, where + ": the distortion").values;
  const std::size_t count = lens.coefficients.size();
  if (fisheye ? count != 4 : count != 0 && count != 4 && count != 5 && count != 8 && count != 12 && count != 14)
  {
    throw InvalidInput(where + ": the distortion has " + std::to_string(count) + " coefficients; OpenCV's " +
                       (fisheye ? "fisheye model has 4" : "model has 4, 5, 8, 12 or 14"));
  }
  return lens.isAny() ? std::optional(lens) : std::nullopt;
}

/** An image size, which is given as a whole or not at all. */
void readSize(const StorageNode& view, const StorageNode& top, const std::string& where, NamedProjection& read)
{
  const StorageNode& width = find(view, top, { "image_width", "width" });
  const StorageNode& height = find(view, top, { "image_height", "height" });
  if (width.is(Kind::Nothing) && height.is(Kind::Nothing))
  {
    return;
  }
  for (const auto& [node, what, size] : { std::tuple(width, "width", &read.width), { height, "height", &read.height } })
  {
    const double value = node.is(Kind::Number) ? node.number : 0.0;
    if (!(value >= 1.0 && value <= 1e9) || value != std::floor(value))
    {
      throw InvalidInput(where + ": the image's " + what + " is not a whole number from 1 on");
    }
    *size = int(value);
  }
}

/** Is P a multiple of K [R t] with a rotation R, of either sign? */
bool isOfIntrinsics(const Projection& projection, const Matrix3& intrinsics)
{
  const Matrix3 turn = intrinsics.inverse() * projection.leftCols<3>();
  const Matrix3 product = turn * turn.transpose();
  const double scale = product.trace() / 3.0;
  return scale > 0.0 && (product / scale - Matrix3::Identity()).cwiseAbs().maxCoeff() <= 1e-3;
}

std::string nameOf(const StorageNode& view, const std::string& where)
{
  const StorageNode& node = view.find({ "image", "name", "file", "file_name" });
  if (!node.is(Kind::Text))
  {
    throw InvalidInput(where + ": no image name (image, name, file or file_name, text)");
  }
  return node.text;
}

/** The projection, and K of the lens where there is one; whether the sign is free. */
bool readCamera(const StorageNode& view, const StorageNode& top, const std::string& where, NamedProjection& read)
{
  const StorageNode& K = find(view, top, { "camera_matrix", "cameraMatrix", "K" });
  const StorageNode& R = view.find({ "R", "rotation_matrix", "rvec", "rotation_vector" });
  const StorageNode& t = view.find({ "t", "T", "tvec", "translation_vector" });
  const StorageNode& P = view.find({ "projection_matrix", "P" });
  const bool isComposed = !K.is(Kind::Nothing) && !R.is(Kind::Nothing) && !t.is(Kind::Nothing);
  if (!isComposed && P.is(Kind::Nothing))
  {
    throw InvalidInput(where + ": neither P nor K, R and t (no " + (K.is(Kind::Nothing) ? "K" : R.is(Kind::Nothing) ? "R" : "t") + ")");
  }
  read.lens = distortionOf(view, top, where);
  if (isComposed)
  {
    const Matrix3 intrinsics = intrinsicsOf(K, where);
    read.projection = composedProjection(intrinsics, rotationOf(R, where), translationOf(t, where), where);
  }
  else
  {
    read.projection = projectionOf(P, where);
    if (read.lens && (K.is(Kind::Nothing) || !isOfIntrinsics(read.projection, intrinsicsOf(K, where))))
    {
      throw InvalidInput(where + ": the lens distorts, but P is " +
                         (K.is(Kind::Nothing) ? "given without K" : "no multiple of K [R t] with a rotation R, and of another image than K"));
    }
  }
  if (read.lens)
  {
    read.lens->intrinsics = intrinsicsOf(K, where);
  }
  return !isComposed;
}

} // namespace

bool isOpenCVCameras(const std::filesystem::path& file)
{
  const std::string bytes = fileBeginning(file, std::size_t(64) << 10);
  const std::string_view text = withoutLeadingBlanks(bytes);
  const auto has = [&](const char* part) { return text.find(part) != std::string_view::npos; };
  if (text.substr(0, 5) == "%YAML")
  {
    return true;
  }
  const std::string ending = lowerCase(file.extension() == ".gz" ? file.stem().extension().string() : file.extension().string());
  if (ending == ".yml" || ending == ".yaml") // by hand, without the first line
  {
    return has("views:") || has("cameras:") || has("frames:");
  }
  if (text.substr(0, 1) == "<")
  {
    return has("<opencv_storage");
  }
  return text.substr(0, 1) == "{" && !has("\"transform_matrix\"") && (has("\"views\"") || has("\"cameras\"") || has("\"frames\""));
}

CameraFile readOpenCVCameras(const std::filesystem::path& file)
{
  const StorageNode top = readStorageTree(file);
  const StorageNode& sequence = top.find({ "views", "cameras", "frames" });
  if (!sequence.is(Kind::Sequence))
  {
    throw InvalidInput(file.string() + ": no sequence views, cameras or frames");
  }
  CameraFile cameras;
  cameras.format = CameraFormat::OpenCv;
  cameras.files = { file };
  for (const auto& [key, view] : sequence.members)
  {
    NamedProjection read;
    read.name = nameOf(view, file.string() + " view " + std::to_string(cameras.views.size()));
    const std::string where = viewOf(file, cameras.views.size(), read.name);
    const bool isFree = readCamera(view, top, where, read);
    cameras.freeSign = cameras.freeSign || isFree;
    readSize(view, top, where, read);
    read.where = where;
    cameras.views.push_back(std::move(read));
  }
  return cameras;
}

} // namespace silhouette
