// SPDX-License-Identifier: BSD-3-Clause
/**
 * A triangle mesh as the core makes and judges it.
 */
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

using Triangle = std::array<std::int32_t, 3>; ///< point indices, counter-clockwise seen from outside

/**
 * A point rounded to float. Each coordinate goes through memory: at -O2 GCC 12 vectorises a conversion to float and
 * back again into nothing.
 */
inline Eigen::Vector3d roundedToFloat(const Eigen::Vector3d& p)
{
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis)
  {
    const volatile float rounded = float(p[axis]);
    result[axis] = rounded;
  }
  return result;
}

struct Mesh
{
  std::vector<Eigen::Vector3d> points; ///< world coordinates, in the capture's unit
  std::vector<Triangle> triangles;
};

} // namespace silhouette
