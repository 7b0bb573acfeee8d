// SPDX-License-Identifier: BSD-3-Clause
#include "HullBase.h"

#include "ConvexHull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace silhouette
{
namespace
{

constexpr float Beside = 0.5f; ///< octants from the surface within which the median is taken

double enclosedVolume(const Mesh& mesh)
{
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    const Eigen::Vector3d& o = mesh.points.front();
    sum += (mesh.points[t[0]] - o).dot((mesh.points[t[1]] - o).cross(mesh.points[t[2]] - o));
  }
  return sum / 6.0;
}

/** The planes of a hull's facets in lattice coordinates, positive outside; facets without an area have none. */
std::vector<Eigen::Vector4f> planesOf(const Mesh& hull, const Lattice& lattice)
{
  std::vector<Eigen::Vector4f> planes;
  const auto place = [&](std::int32_t point) -> Eigen::Vector3d
  { return (hull.points[point] - lattice.root.origin) / lattice.leafEdge(); };
  for (const Triangle& t : hull.triangles)
  {
    const Eigen::Vector3d a = place(t[0]);
    const Eigen::Vector3d across = (place(t[1]) - a).cross(place(t[2]) - a);
    if (across.norm() > 1e-9)
    {
      const Eigen::Vector3d normal = across.normalized();
      planes.emplace_back(float(normal[0]), float(normal[1]), float(normal[2]), float(-normal.dot(a)));
    }
  }
  return planes;
}

float depthInHull(const std::vector<Eigen::Vector4f>& planes, const LatticePoint& p)
{
  const Eigen::Vector4f point(float(p.i), float(p.j), float(p.k), 1.0f);
  float farthest = planes.front().dot(point);
  for (const Eigen::Vector4f& plane : planes)
  {
    farthest = std::max(farthest, plane.dot(point));
  }
  return -farthest;
}

/** By how much `hull` exceeds the field beside the surface, the median. */
float typicalExcess(const BrickField& field, const std::vector<float>& hull)
{
  std::vector<float> excess;
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    if (std::abs(field.values()[n]) < Beside)
    {
      excess.push_back(hull[n] - field.values()[n]);
    }
  }
  if (excess.empty())
  {
    return 0.0f;
  }
  const auto middle = excess.begin() + std::ptrdiff_t(excess.size() / 2);
  std::nth_element(excess.begin(), middle, excess.end());
  return *middle;
}

} // namespace

HullBase applyHullBase(BrickField& field, double leastConvexity, double band, Execution& execution)
{
  HullBase base;
  const Mesh surface = leastConvexity < 1.0 ? field.contourMesh(execution) : Mesh();
  const Mesh hull = convexHull(surface.points).value_or(Mesh());
  const auto planes = planesOf(hull, field.lattice());
  if (surface.triangles.empty() || planes.empty())
  {
    return base;
  }
  base.convexity = std::clamp(enclosedVolume(surface) / enclosedVolume(hull), 0.0, 1.0);
  base.applied = base.convexity > leastConvexity;
  if (!base.applied)
  {
    return base;
  }
  std::vector<float> depth(field.values());
  const auto isNear = [&](std::size_t n) { return std::abs(field.values()[n]) <= float(band); };
  execution.forRanges(depth.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t n = first; n < last; ++n)
      {
        if (isNear(n))
        {
          depth[n] = depthInHull(planes, fromMorton(field.code(n)));
        }
      }
    });
  const float excess = typicalExcess(field, depth);
  for (std::size_t n = 0; n < depth.size(); ++n)
  {
    if (isNear(n))
    {
      field.values()[n] = depth[n] - excess;
    }
  }
  return base;
}

} // namespace silhouette
