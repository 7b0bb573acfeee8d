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

struct Mesh
{
  std::vector<Eigen::Vector3d> points; ///< world coordinates, in the capture's unit
  std::vector<Triangle> triangles;
};

} // namespace silhouette
