// SPDX-License-Identifier: BSD-3-Clause
/**
 * Connected components of lattice points.
 */
#pragma once

#include "BlockSteps.h"
#include "PointCubes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Points and cubes that meet; both ascending. */
struct PointComponent
{
  std::vector<std::uint64_t> points; ///< Morton codes, but those within the cubes
  std::vector<PointCube> cubes;
  std::uint64_t size = 0; ///< points, those within the cubes among them

  /** The lowest code of a point. */
  std::uint64_t first() const
  {
    return this->cubes.empty() || (!this->points.empty() && this->points.front() < this->cubes.front().corner) ? this->points.front()
                                                                                                               : this->cubes.front().corner;
  }
};

/**
 * Those components of `points` (Morton codes) and `cubes` (both ascending, no point twice) that have `least` points or more. Points are joined that are
 * neighbours by `steps`. Cost: linear in the points, and in the cubes whatever they hold; what is looked for is blocks of 4 x 4 x 4 and cubes.
 */
std::vector<PointComponent> pointComponents(const std::vector<std::uint64_t>& points, const std::vector<PointCube>& cubes, Steps steps, std::size_t least);

} // namespace silhouette
