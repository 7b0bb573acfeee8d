// SPDX-License-Identifier: BSD-3-Clause
#include "Yardstick.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace silhouette::experiments
{
namespace
{

struct Sums
{
  double area = 0.0;
  double distance = 0.0;
  double largest = 0.0;
};

Sums sampleTriangle(const Mesh& mesh, const Triangle& triangle, const Yardstick& to, double spacing)
{
  const Eigen::Vector3d& a = mesh.points[triangle[0]];
  const Eigen::Vector3d b = mesh.points[triangle[1]] - a;
  const Eigen::Vector3d c = mesh.points[triangle[2]] - a;
  const double longest = std::max({b.norm(), c.norm(), (c - b).norm()});
  const int parts = int(std::clamp(std::ceil(longest / spacing), 1.0, 1000.0));
  const double area = 0.5 * b.cross(c).norm() / parts / parts;
  Sums sums;
  sums.largest = to.distance(a);
  const auto sample = [&](int thirdsB, int thirdsC)
  {
    const double distance = to.distance(a + (thirdsB * b + thirdsC * c) / (3.0 * parts));
    sums.area += area;
    sums.distance += area * distance;
    sums.largest = std::max(sums.largest, distance);
  };
  for (int i = 0; i < parts; ++i)
  {
    for (int j = 0; i + j < parts; ++j)
    {
      sample(3 * i + 1, 3 * j + 1);
      if (i + j + 1 < parts)
      {
        sample(3 * i + 2, 3 * j + 2);
      }
    }
  }
  return sums;
}

/** Made on the calling thread: trials run side by side. */
DistanceTarget targetOf(const Mesh& mesh)
{
  Execution alone;
  return DistanceTarget(mesh, alone);
}

} // namespace

Yardstick::Yardstick(Mesh surface) : Surface(std::move(surface)), Fine(targetOf(this->Surface)) {}

Yardstick::Yardstick(Mesh surface, Mesh coarse, double near)
    : Surface(std::move(surface)), Fine(targetOf(this->Surface)), Coarse(std::move(coarse)),
      Far(std::make_unique<DistanceTarget>(targetOf(this->Coarse))), Near(near)
{
}

double Yardstick::distance(const Eigen::Vector3d& point) const
{
  if (this->Far)
  {
    const double distance = std::sqrt(this->Far->squaredDistance(point));
    if (distance > this->Near)
    {
      return distance;
    }
  }
  return std::sqrt(this->Fine.squaredDistance(point));
}

SampledDistance sampledDistance(const Mesh& from, const Yardstick& to, std::size_t triangles, double spacing,
                                Execution& execution)
{
  if (from.triangles.empty())
  {
    throw InvalidInput("the surface has no triangles");
  }
  const std::size_t step = std::max<std::size_t>(1, from.triangles.size() / triangles);
  std::vector<Sums> sums((from.triangles.size() + step - 1) / step);
  execution.forRanges(sums.size(), 64,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t i = first; i < last; ++i)
                        {
                          sums[i] = sampleTriangle(from, from.triangles[i * step], to, spacing);
                        }
                      });
  Sums total;
  for (const Sums& s : sums)
  {
    total.area += s.area;
    total.distance += s.distance;
    total.largest = std::max(total.largest, s.largest);
  }
  return {total.area > 0.0 ? total.distance / total.area : 0.0, total.largest};
}

} // namespace silhouette::experiments
