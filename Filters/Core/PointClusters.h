// SPDX-License-Identifier: BSD-3-Clause
/**
 * Groups of lattice points, or of cells, that lie far from one another: what is done in one of them does not reach the next.
 */
#pragma once

#include "Execution.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

struct PointClusters
{
  std::vector<std::uint32_t> members; ///< numbers of the points, those of a cluster together and ascending
  std::vector<std::uint32_t> first;   ///< where each cluster begins among them, and the end; clusters in the order of their first points

  std::size_t size() const { return this->first.empty() ? 0 : this->first.size() - 1; }
  const std::uint32_t* begin(std::size_t cluster) const { return this->members.data() + this->first[cluster]; }
  const std::uint32_t* end(std::size_t cluster) const { return this->members.data() + this->first[cluster + 1]; }
};

/**
 * Points whose coordinates differ by two at most on every axis are in one cluster, and so on from these; some that are three apart may be, too. `points`: Morton codes,
 * ascending. Cost: finding half of the 26 blocks around each block of 4 x 4 x 4 points.
 */
PointClusters clustersOf(const std::vector<std::uint64_t>& points, Execution& execution);

} // namespace silhouette
