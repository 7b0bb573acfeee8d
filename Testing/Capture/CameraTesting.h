// SPDX-License-Identifier: BSD-3-Clause
/** What the tests of other programs' cameras share: known cameras, and lenses written anew from their formulas. */
#pragma once

#include "CameraFiles.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace silhouette
{

/** World to camera: x right, y down, z forward. The unit cube about the origin lies before it. */
struct TestPose
{
  explicit TestPose(unsigned seed)
  {
    std::mt19937 generator(seed);
    std::normal_distribution<double> any;
    this->Turn = Eigen::Quaterniond(any(generator), any(generator), any(generator), any(generator)).normalized();
    this->Translation = {0.1 * any(generator), 0.1 * any(generator), 6.0};
  }

  /** X / Z and Y / Z. */
  Vector2 plane(const Vector3& point) const { return (this->Turn * point + this->Translation).hnormalized(); }

  /** Camera to world, the camera's axes right, up and back. */
  Eigen::Matrix4d openGlToWorld() const
  {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    const Eigen::Matrix3d toWorld = this->Turn.conjugate().toRotationMatrix();
    matrix.col(0).head<3>() = toWorld.col(0);
    matrix.col(1).head<3>() = -toWorld.col(1);
    matrix.col(2).head<3>() = -toWorld.col(2);
    matrix.col(3).head<3>() = -toWorld * this->Translation;
    return matrix;
  }

  Eigen::Quaterniond Turn;
  Vector3 Translation;
};

inline std::vector<Vector3> testPoints()
{
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::vector<Vector3> points(50);
  for (Vector3& point : points)
  {
    point = {coordinate(generator), coordinate(generator), coordinate(generator)};
  }
  return points;
}

/** k1 k2 p1 p2 k3 k4 k5 k6; k4 to k6 divide. */
inline Vector2 brownLens(const Vector2& p, std::vector<double> k)
{
  k.resize(8, 0.0);
  const double x = p.x(), y = p.y(), r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double radial = (1.0 + k[0] * r2 + k[1] * r4 + k[4] * r6) / (1.0 + k[5] * r2 + k[6] * r4 + k[7] * r6);
  return {x * radial + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x), y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y};
}

inline Vector2 fisheyeLens(const Vector2& p, std::vector<double> k)
{
  k.resize(4, 0.0);
  const double r = p.norm(), angle = std::atan(r), a2 = angle * angle;
  return p * (angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))) / r);
}

/** Where the camera's own image has a point, by the view's matrix and lens; of the integer family. */
inline Vector2 pixelOf(const NamedProjection& view, const Vector3& point)
{
  const Vector2 ideal = (view.projection * point.homogeneous()).hnormalized();
  if (!view.lens)
  {
    return ideal;
  }
  const Vector2 plane = (view.lens->intrinsics.inverse() * ideal.homogeneous()).hnormalized();
  const bool isFisheye = view.lens->model == LensDistortion::Model::Fisheye;
  const Vector2 bent = isFisheye ? fisheyeLens(plane, view.lens->coefficients) : brownLens(plane, view.lens->coefficients);
  return (view.lens->intrinsics * bent.homogeneous()).hnormalized();
}

/** Numbers with all their digits, a blank before each. */
template <typename Numbers> std::string written(const Numbers& numbers)
{
  std::ostringstream text;
  text << std::setprecision(17);
  for (const double number : numbers)
  {
    text << ' ' << number;
  }
  return text.str();
}

} // namespace silhouette
