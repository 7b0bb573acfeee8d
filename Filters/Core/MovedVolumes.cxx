// SPDX-License-Identifier: BSD-3-Clause
#include "MovedVolumes.h"

#include "Lattice.h"
#include "MeshComponents.h"
#include "UnionFind.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace silhouette
{

/** A triangle's share in its component's volume, seen from a place that does not move. */
MovedVolumes::Volume MovedVolumes::sixfoldVolume(const Eigen::Vector3d& from, const Triangle& t) const
{
  const auto product = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) { return (a - from).cross(b - from).dot(c - from); };
  const auto& points = this->TheMesh.points;
  const auto isStill = [&](std::int32_t p) { return this->Number[std::size_t(p)] < 0; };
  Volume volume;
  volume.now = product(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]);
  volume.before =
    std::all_of(t.begin(), t.end(), isStill) ? volume.now : product(this->original(t[0]), this->original(t[1]), this->original(t[2]));
  return volume;
}

bool MovedVolumes::mayShrink(const std::vector<std::int32_t>& moving) const
{
  std::vector<std::int32_t> points;
  for (const std::int32_t t : moving)
  {
    const Triangle& triangle = this->TheMesh.triangles[std::size_t(t)];
    points.insert(points.end(), triangle.begin(), triangle.end());
  }
  sortUnique(points);
  const auto number = [&](std::int32_t p) { return std::uint32_t(std::lower_bound(points.begin(), points.end(), p) - points.begin()); };
  UnionFind together(points.size());
  for (const std::int32_t t : moving)
  {
    const Triangle& triangle = this->TheMesh.triangles[std::size_t(t)];
    together.unite(number(triangle[0]), number(triangle[1]));
    together.unite(number(triangle[0]), number(triangle[2]));
  }
  std::vector<double> growth(points.size(), 0.0); // of those that stand for others
  for (const std::int32_t t : moving)
  {
    const Triangle& triangle = this->TheMesh.triangles[std::size_t(t)];
    const std::uint32_t set = together.find(number(triangle[0]));
    growth[set] += this->sixfoldVolume(this->original(points[set]), triangle).growth();
  }
  return std::any_of(growth.begin(), growth.end(), [](double volume) { return volume < 0.0; });
}

/** Adds a triangle's share to its component's; those of one component are measured from where its first point was. */
void MovedVolumes::addVolume(const Triangle& t, Volumes& volumes)
{
  const std::uint32_t first = this->Components.find(std::uint32_t(t[0]));
  const Volume own = this->sixfoldVolume(this->original(std::int32_t(first)), t);
  Volume& volume = volumes[first];
  volume.now += own.now;
  volume.before += own.before;
}

MovedVolumes::Volumes MovedVolumes::volumes(Execution& execution)
{
  constexpr std::size_t RunSize = 1 << 15; // triangles whose shares are summed one after another, whatever the threads
  const auto& triangles = this->TheMesh.triangles;
  std::vector<Volumes> runs((triangles.size() + RunSize - 1) / RunSize);
  execution.forRanges(runs.size(), 1,
    [&](std::size_t firstRun, std::size_t lastRun)
    {
      for (std::size_t run = firstRun; run < lastRun; ++run)
      {
        for (std::size_t t = run * RunSize; t < std::min((run + 1) * RunSize, triangles.size()); ++t)
        {
          this->addVolume(triangles[t], runs[run]);
        }
      }
    });
  Volumes all;
  for (const Volumes& run : runs)
  {
    for (const auto& [component, volume] : run)
    {
      all[component].before += volume.before;
      all[component].now += volume.now;
    }
  }
  return all;
}

std::vector<std::size_t> MovedVolumes::inverted(Execution& execution)
{
  if (this->Components.size() == 0)
  {
    this->Components = connectPoints(this->TheMesh.triangles, this->TheMesh.points.size(), execution);
  }
  const Volumes volumes = this->volumes(execution);
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < this->Number.size(); ++p)
  {
    if (this->Number[p] >= 0)
    {
      const Volume& own = volumes.at(this->Components.find(std::uint32_t(p)));
      if (own.before > 0.0 && !(own.now > 0.0))
      {
        found.push_back(std::size_t(this->Number[p]));
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace silhouette
