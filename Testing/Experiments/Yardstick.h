// SPDX-License-Identifier: BSD-3-Clause
/**
 * Surfaces that others are compared with, and the distances of the study: from samples of some of one
 * surface's triangles to the nearest point of the other.
 */
#pragma once

#include "MeshDistance.h"

#include <cstddef>
#include <memory>

namespace silhouette::experiments
{

/**
 * A surface to measure to. With a coarse stand-in for it, points further than `near` from that are measured
 * to it alone: a fine surface is slow to search from afar, and what it adds there is less than a hundredth.
 */
class Yardstick
{
public:
  explicit Yardstick(Mesh surface);
  Yardstick(Mesh surface, Mesh coarse, double near);

  const Mesh& surface() const { return this->Surface; }
  double distance(const Eigen::Vector3d& point) const;

private:
  Mesh Surface;
  DistanceTarget Fine;
  Mesh Coarse;
  std::unique_ptr<DistanceTarget> Far;
  double Near = 0.0;
};

struct SampledDistance
{
  double mean = 0.0; ///< weighted by area
  double largest = 0.0;
};

/**
 * The distance from `from`: every n-th of its triangles, so many that about `triangles` are left, is cut into
 * equal parts not longer than `spacing`, whose centroids are the samples; its first corner counts for the
 * largest distance. The same for any number of threads. Throws InvalidInput for a mesh without triangles.
 */
SampledDistance sampledDistance(const Mesh& from, const Yardstick& to, std::size_t triangles, double spacing,
                                Execution& execution);

} // namespace silhouette::experiments
