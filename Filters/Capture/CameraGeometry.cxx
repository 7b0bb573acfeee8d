// SPDX-License-Identifier: BSD-3-Clause
#include "CameraGeometry.h"

#include "Error.h"
#include "TextParsing.h"

#include <Eigen/Geometry>

#include <map>

namespace silhouette
{

Matrix3 checkedIntrinsics(const Matrix3& intrinsics, const std::string& where)
{
  const Matrix3& K = intrinsics;
  if (K(1, 0) != 0.0 || K(2, 0) != 0.0 || K(2, 1) != 0.0 || K(2, 2) != 1.0)
  {
    throw InvalidInput(where + ": K is " + formatMatrix(K) + "; fx s cx, 0 fy cy, 0 0 1 are needed");
  }
  if (!(K(0, 0) > 0.0) || !(K(1, 1) > 0.0))
  {
    throw InvalidInput(where + ": focal lengths " + formatNumber(K(0, 0)) + " and " + formatNumber(K(1, 1)) + " are not above 0");
  }
  return K;
}

Matrix3 checkedRotation(const Matrix3& rotation, const std::string& where)
{
  const double deviation = (rotation * rotation.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation <= 1e-3) || rotation.determinant() < 0.0)
  {
    throw InvalidInput(where + ": R is no rotation: " + formatMatrix(rotation));
  }
  return rotation;
}

Matrix3 rotationAbout(const Vector3& vector)
{
  const double angle = vector.norm();
  return angle > 0.0 ? Matrix3(Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()) : Matrix3::Identity();
}

Projection composedProjection(const Matrix3& intrinsics, const Matrix3& rotation, const Vector3& translation, const std::string& where)
{
  Projection pose;
  pose.leftCols<3>() = rotation;
  pose.col(3) = translation;
  const Projection projection = intrinsics * pose;
  if (!projection.allFinite())
  {
    throw InvalidInput(where + ": K [R t] is too large to be finite");
  }
  return projection;
}

std::string formatMatrix(const Matrix3& matrix)
{
  std::string text;
  for (int i = 0; i < 9; ++i)
  {
    text += std::string(i == 0 ? "" : i % 3 == 0 ? ", " : " ") + formatNumber(matrix(i / 3, i % 3));
  }
  return text;
}

std::string viewOf(const std::filesystem::path& file, std::size_t index, const std::string& name)
{
  return file.string() + " view " + std::to_string(index) + " " + inQuotes(name);
}

} // namespace silhouette
