// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the core is given: silhouettes and their projection matrices.
 */
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace silhouette
{

using Vector3 = Eigen::Vector3d;
using Vector2 = Eigen::Vector2d;
using Projection = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/** A two-valued image: 1 is object, 0 is background. Row 0 is the TOP row, pixels run left to right. */
struct BinaryImage
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels; ///< width * height values 0 or 1

  std::uint8_t& at(int column, int row) { return this->pixels[std::size_t(row) * this->width + column]; }
  std::uint8_t at(int column, int row) const { return this->pixels[std::size_t(row) * this->width + column]; }
};

/** How messages call a view: "view 3 (mask.png)", or "view 3" where it has no name. */
inline std::string describeView(std::size_t index, const std::string& name)
{
  return "view " + std::to_string(index) + (name.empty() ? std::string() : " (" + name + ")");
}

/**
 * One calibrated silhouette. `w (u, v, 1)^T = projection (X, Y, Z, 1)^T` with w > 0 in front of the camera, u to
 * the right, v down, in pixels, the centre of the top-left pixel at (0, 0); X, Y, Z in the capture's unit.
 */
struct View
{
  std::string name; ///< the file it came from; used in messages
  Projection projection = Projection::Zero();
  BinaryImage silhouette;
};

} // namespace silhouette
