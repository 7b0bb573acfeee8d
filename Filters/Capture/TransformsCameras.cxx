// SPDX-License-Identifier: BSD-3-Clause
#include "TransformsCameras.h"

#include "CameraGeometry.h"
#include "Error.h"
#include "FileBytes.h"
#include "ImageSearch.h"
#include "TextParsing.h"

#include <nlohmann/json.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace silhouette
{

namespace
{

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string shown(const Json& value)
{
  return inQuotes(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

double finiteNumber(const Json& value, const std::string& what)
{
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(number))
  {
    throw InvalidInput(what + " is " + shown(value) + ", which is not a finite number");
  }
  return number;
}

/** Null where it is not there, or null. */
const Json* valueOf(const Json& object, const char* key)
{
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

/** A frame's keys over those of the whole file. */
class Keys
{
public:
  Keys(const Json& frame, const Json& all, std::string where)
      : Frame(frame), All(all), Where(std::move(where))
  {
  }

  const Json* find(const char* key) const
  {
    for (const Json* scope : {&this->Frame, &this->All})
    {
      if (const Json* value = valueOf(*scope, key))
      {
        return value;
      }
    }
    return nullptr;
  }

  std::optional<double> number(const char* key) const
  {
    const Json* value = this->find(key);
    return value ? std::optional<double>(finiteNumber(*value, this->Where + ": " + key)) : std::nullopt;
  }

  /** The first of two keys, the frame's own before both of the file's: is it the second? */
  std::optional<bool> isSecond(const char* first, const char* second) const
  {
    for (const Json* scope : {&this->Frame, &this->All})
    {
      for (const bool isSecond : {false, true})
      {
        if (valueOf(*scope, isSecond ? second : first))
        {
          return isSecond;
        }
      }
    }
    return std::nullopt;
  }

  const std::string& where() const { return this->Where; }

private:
  const Json& Frame;
  const Json& All;
  std::string Where;
};

/** A number of pixels: so many, and so many for each pixel of the image's width and height. */
struct Length
{
  double pixels = 0.0;
  double perWidth = 0.0;
  double perHeight = 0.0;

  double of(int width, int height) const { return this->pixels + this->perWidth * width + this->perHeight * height; }
};

/** What a frame says of its camera. */
struct Frame
{
  NamedProjection view; ///< without its matrix
  Length fx, fy, cx, cy;
  std::optional<LensDistortion> lens; ///< without K
  Projection pose = Projection::Zero(); ///< world to camera, axes right, down, forward
};

/** Half of an image's side over the focal length, of the angle under which the side is seen. */
double halfTangent(const Keys& keys, const char* key)
{
  const double angle = *keys.number(key), pi = std::acos(-1.0);
  if (!(angle > 0.0 && angle < pi))
  {
    throw InvalidInput(keys.where() + ": " + key + " is " + formatNumber(angle) + "; radians between 0 and pi are needed");
  }
  return std::tan(0.5 * angle);
}

double aboveZero(const Keys& keys, const char* key)
{
  const double value = *keys.number(key);
  if (!(value > 0.0))
  {
    throw InvalidInput(keys.where() + ": " + key + " is " + formatNumber(value) + ", which is not above 0");
  }
  return value;
}

void readFocalLengths(const Keys& keys, Frame& frame)
{
  const std::optional<bool> isAngle = keys.isSecond("fl_x", "camera_angle_x");
  if (!isAngle)
  {
    throw InvalidInput(keys.where() + ": neither \"fl_x\" nor \"camera_angle_x\" is there");
  }
  frame.fx = *isAngle ? Length{0.0, 0.5 / halfTangent(keys, "camera_angle_x"), 0.0} : Length{aboveZero(keys, "fl_x"), 0.0, 0.0};
  const std::optional<bool> isAngleOfHeight = keys.isSecond("fl_y", "camera_angle_y");
  frame.fy = !isAngleOfHeight ? frame.fx
      : *isAngleOfHeight      ? Length{0.0, 0.0, 0.5 / halfTangent(keys, "camera_angle_y")}
                              : Length{aboveZero(keys, "fl_y"), 0.0, 0.0};
}

int sizeOf(const Keys& keys, const char* key)
{
  const std::optional<double> value = keys.number(key);
  if (value && !(*value >= 1.0 && *value <= std::numeric_limits<int>::max() && *value == std::floor(*value)))
  {
    throw InvalidInput(keys.where() + ": " + key + " is " + formatNumber(*value) + ", which is not a number of pixels");
  }
  return int(value.value_or(0.0));
}

bool isFisheye(const Keys& keys)
{
  const Json* flag = keys.find("is_fisheye");
  if (flag && !flag->is_boolean())
  {
    throw InvalidInput(keys.where() + ": is_fisheye is " + shown(*flag) + "; true or false is needed");
  }
  const Json* value = keys.find("camera_model");
  if (!value)
  {
    return flag && flag->get<bool>();
  }
  const std::string model = value->is_string() ? value->get<std::string>() : std::string();
  for (const char* known : {"PINHOLE", "SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV"})
  {
    if (model == known)
    {
      return flag && flag->get<bool>();
    }
  }
  if (model != "OPENCV_FISHEYE")
  {
    throw InvalidInput(keys.where() + ": the camera model is " + shown(*value) +
                       ", which is not read; PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV and OPENCV_FISHEYE are");
  }
  return true;
}

std::optional<LensDistortion> lensOf(const Keys& keys)
{
  const bool fisheye = isFisheye(keys);
  LensDistortion lens;
  lens.model = fisheye ? LensDistortion::Model::Fisheye : LensDistortion::Model::Brown;
  const std::array<const char*, 5> brown = {"k1", "k2", "p1", "p2", "k3"}, others = {"k1", "k2", "k3", "k4", nullptr};
  for (const char* key : fisheye ? others : brown)
  {
    if (key)
    {
      lens.coefficients.push_back(keys.number(key).value_or(0.0));
    }
  }
  for (const char* key : {fisheye ? "p1" : "k4", fisheye ? "p2" : "k5", "k5", "k6"})
  {
    if (const double value = keys.number(key).value_or(0.0); value != 0.0)
    {
      throw InvalidInput(keys.where() + ": " + key + " is " + formatNumber(value) + "; " +
                         (fisheye ? "OpenCV's fisheye model has k1 to k4 alone" : "of radial coefficients k1, k2 and k3 are read") +
                         ", so it has to be 0");
    }
  }
  return lens.isAny() ? std::optional<LensDistortion>(lens) : std::nullopt;
}

/** World to camera, axes right, down, forward, of the matrix that brings the camera, right, up and back, to the world. */
Projection poseOf(const Json& frame, const std::string& where)
{
  const auto matrix = frame.find("transform_matrix");
  const std::string what = where + ": transform_matrix";
  const auto fits = [](const Json& rows)
  {
    return rows.is_array() && (rows.size() == 3 || rows.size() == 4) &&
           std::all_of(rows.begin(), rows.end(), [](const Json& row) { return row.is_array() && row.size() == 4; });
  };
  if (matrix == frame.end() || !fits(*matrix))
  {
    throw InvalidInput(what + (matrix == frame.end() ? " is missing" : " is " + shown(*matrix)) + "; 4 rows of 4 numbers are needed");
  }
  Eigen::Matrix4d toWorld = Eigen::Matrix4d::Identity();
  for (std::size_t row = 0; row < matrix->size(); ++row)
  {
    for (std::size_t column = 0; column < 4; ++column)
    {
      toWorld(int(row), int(column)) = finiteNumber((*matrix)[row][column], what + "[" + std::to_string(row) + "][" + std::to_string(column) + "]");
    }
  }
  Eigen::Matrix3d turn = toWorld.topLeftCorner<3, 3>();
  const double slack = 1e-3; // decimals may be few
  const bool isTurn = (turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= slack && turn.determinant() > 0.0;
  if (!isTurn || (toWorld.row(3) - Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)).cwiseAbs().maxCoeff() > slack)
  {
    throw InvalidInput(what + " is " + shown(*matrix) + ", which is no rotation and translation");
  }
  turn.rightCols<2>() *= -1.0;
  Projection pose;
  pose.leftCols<3>() = turn.inverse();
  pose.col(3) = -pose.leftCols<3>() * toWorld.topRightCorner<3, 1>();
  return pose;
}

std::string textOf(const Json& frame, const char* key, const std::string& where)
{
  const auto found = frame.find(key);
  if (found == frame.end() || !found->is_string())
  {
    throw InvalidInput(where + ": " + key + (found == frame.end() ? " is missing" : " is " + shown(*found)) + "; a text is needed");
  }
  return found->get<std::string>();
}

Frame frameOf(const Json& json, const Json& all, std::string where)
{
  if (!json.is_object())
  {
    throw InvalidInput(where + " is " + shown(json) + "; an object is needed");
  }
  Frame frame;
  frame.view.name = fs::path(textOf(json, "file_path", where)).lexically_normal().string();
  if (!isImageName(frame.view.name))
  {
    frame.view.name += ".png"; // Blender's leave it out
  }
  where += ", " + inQuotes(frame.view.name);
  frame.view.where = where;
  if (valueOf(json, "mask_path"))
  {
    frame.view.mask = textOf(json, "mask_path", where);
  }
  const Keys keys(json, all, where);
  frame.view.width = sizeOf(keys, "w");
  frame.view.height = sizeOf(keys, "h");
  readFocalLengths(keys, frame);
  const std::optional<double> cx = keys.number("cx"), cy = keys.number("cy");
  frame.cx = cx ? Length{*cx, 0.0, 0.0} : Length{0.0, 0.5, 0.0};
  frame.cy = cy ? Length{*cy, 0.0, 0.0} : Length{0.0, 0.0, 0.5};
  frame.lens = lensOf(keys);
  frame.pose = poseOf(json, where);
  return frame;
}

NamedProjection viewOf(const Frame& frame, int width, int height)
{
  NamedProjection view = frame.view;
  Matrix3 intrinsics;
  intrinsics << frame.fx.of(width, height), 0.0, frame.cx.of(width, height) - 0.5, 0.0, frame.fy.of(width, height),
      frame.cy.of(width, height) - 0.5, 0.0, 0.0, 1.0;
  view.projection = composedProjection(intrinsics, frame.pose.leftCols<3>(), frame.pose.col(3), view.where);
  view.lens = frame.lens;
  if (view.lens)
  {
    view.lens->intrinsics = intrinsics;
  }
  return view;
}

NamedProjection viewOf(const Frame& frame)
{
  bool isKnown = true;
  for (const Length& length : {frame.fx, frame.fy, frame.cx, frame.cy})
  {
    isKnown = isKnown && (length.perWidth == 0.0 || frame.view.width > 0) && (length.perHeight == 0.0 || frame.view.height > 0);
  }
  if (isKnown)
  {
    return viewOf(frame, frame.view.width, frame.view.height);
  }
  NamedProjection view = frame.view;
  view.ofSize = [frame](int width, int height)
  { return viewOf(frame, frame.view.width > 0 ? frame.view.width : width, frame.view.height > 0 ? frame.view.height : height); };
  return view;
}

Json parsed(const fs::path& file)
{
  try
  {
    return Json::parse(readBytes(file));
  }
  catch (const Json::exception& error)
  {
    throw InvalidInput(file.string() + ": not JSON (" + std::string(error.what()).substr(0, 200) + ")"); // it may quote the file at length
  }
}

} // namespace

bool isTransforms(const std::string& beginning)
{
  const std::string_view text = withoutLeadingBlanks(beginning);
  return text.substr(0, 1) == "{" && text.find("\"frames\"") != std::string_view::npos;
}

CameraFile readTransformsCameras(const fs::path& file)
{
  const Json all = parsed(file);
  const auto frames = all.is_object() ? all.find("frames") : all.end();
  if (frames == all.end() || !frames->is_array())
  {
    throw InvalidInput(file.string() + ": there is no list \"frames\"");
  }
  CameraFile cameras;
  cameras.format = CameraFormat::Transforms;
  cameras.files = {file};
  for (std::size_t n = 0; n < frames->size(); ++n)
  {
    cameras.views.push_back(viewOf(frameOf((*frames)[n], all, file.string() + " frame " + std::to_string(n))));
  }
  return cameras;
}

} // namespace silhouette
