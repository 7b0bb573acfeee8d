// SPDX-License-Identifier: BSD-3-Clause
/**
 * Is a point near one of some octants? Asked for many points: what is looked at is the few octants around each, not all of them.
 */
#pragma once

#include "Lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * Does a point lie within `ring` octants, 0 or more, of one of the octants, on every axis? Within a thousandth counts. `octants`: Morton codes, ascending; `p`: in
 * octants, from the lattice's origin; `cells`: the lattice's along a side. Cost: at most (2 `ring` + 3)^3 binary searches.
 */
inline bool isNearOctant(const std::vector<std::uint64_t>& octants, const Eigen::Vector3d& p, int ring, int cells)
{
  constexpr double Slack = 1e-3;
  std::array<int, 3> low, high;
  for (int axis = 0; axis < 3; ++axis)
  {
    // With twice the slack: the test below decides.
    low[std::size_t(axis)] = int(std::clamp(std::ceil(p[axis] - 1.0 - ring - 2.0 * Slack), 0.0, double(cells)));
    high[std::size_t(axis)] = int(std::clamp(std::floor(p[axis] + ring + 2.0 * Slack), -1.0, cells - 1.0));
  }
  for (int k = low[2]; k <= high[2]; ++k)
  {
    for (int j = low[1]; j <= high[1]; ++j)
    {
      for (int i = low[0]; i <= high[0]; ++i)
      {
        const Eigen::Vector3d away = p - toVector({ i, j, k }) - Eigen::Vector3d::Constant(0.5);
        if (away.cwiseAbs().maxCoeff() <= 0.5 + ring + Slack && std::binary_search(octants.begin(), octants.end(), mortonCode({ i, j, k })))
        {
          return true;
        }
      }
    }
  }
  return false;
}

} // namespace silhouette
