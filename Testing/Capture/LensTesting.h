// SPDX-License-Identifier: BSD-3-Clause
/** Where a point falls, by formulas written down anew: what the readers' matrices and lenses are held against. */
#pragma once

#include "CameraFiles.h"

#include <Eigen/Geometry>

#include <cmath>

namespace silhouette
{

/** Of the undistorted image. */
inline Vector2 pixelOf(const Projection& projection, const Vector3& point)
{
  const Vector3 pixel = projection * point.homogeneous();
  return { pixel.x() / pixel.z(), pixel.y() / pixel.z() };
}

/** OpenCV's rational model with its thin prism, as its documentation has it, and its fisheye model: a point before the camera to a pixel of the image as it was taken. */
inline Vector2 distortedPixel(const LensDistortion& lens, const Vector3& point)
{
  const double a = point.x() / point.z(), b = point.y() / point.z();
  std::vector<double> c = lens.coefficients;
  c.resize(14, 0.0);
  double x = 0.0, y = 0.0;
  if (lens.model == LensDistortion::Model::Fisheye)
  {
    const double r = std::sqrt(a * a + b * b), theta = std::atan(r), t2 = theta * theta;
    const double bent = theta * (1 + c[0] * t2 + c[1] * std::pow(t2, 2) + c[2] * std::pow(t2, 3) + c[3] * std::pow(t2, 4));
    x = bent / r * a;
    y = bent / r * b;
  }
  else
  {
    const double r2 = a * a + b * b, r4 = r2 * r2, r6 = r4 * r2;
    const double radial = (1 + c[0] * r2 + c[1] * r4 + c[4] * r6) / (1 + c[5] * r2 + c[6] * r4 + c[7] * r6);
    x = a * radial + 2 * c[2] * a * b + c[3] * (r2 + 2 * a * a) + c[8] * r2 + c[9] * r4;
    y = b * radial + c[2] * (r2 + 2 * b * b) + 2 * c[3] * a * b + c[10] * r2 + c[11] * r4;
  }
  const Eigen::Matrix3d& K = lens.intrinsics;
  return { K(0, 0) * x + K(0, 1) * y + K(0, 2), K(1, 1) * y + K(1, 2) };
}

} // namespace silhouette
