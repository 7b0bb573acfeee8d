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

Eigen::Vector4f toPoint(const LatticePoint& p)
{
  return { float(p.i), float(p.j), float(p.k), 1.0f };
}

/** Those of the planes that may be the farthest out for a point of a cube of `side` lattice points from `lowest` on. */
void farthestFor(const std::vector<Eigen::Vector4f>& planes, const LatticePoint& lowest, int side,
  std::vector<float>& values, std::vector<Eigen::Vector4f>& farthest)
{
  const float half = 0.5f * float(side - 1);
  const Eigen::Vector4f centre = toPoint(lowest) + Eigen::Vector4f(half, half, half, 0.0f);
  values.resize(planes.size());
  float most = planes.front().dot(centre);
  for (std::size_t n = 0; n < planes.size(); ++n)
  {
    values[n] = planes[n].dot(centre);
    most = std::max(most, values[n]);
  }
  // From the centre to a point no plane's value changes by more than the way.
  const float least = most - 2.0f * std::sqrt(3.0f) * half - 0.01f;
  farthest.clear();
  for (std::size_t n = 0; n < planes.size(); ++n)
  {
    if (values[n] >= least)
    {
      farthest.push_back(planes[n]);
    }
  }
}

float depthInHull(const std::vector<Eigen::Vector4f>& planes, const LatticePoint& p)
{
  const Eigen::Vector4f point = toPoint(p);
  float farthest = planes.front().dot(point);
  for (const Eigen::Vector4f& plane : planes)
  {
    farthest = std::max(farthest, plane.dot(point));
  }
  return -farthest;
}

constexpr std::size_t BlockPoints = 64; ///< consecutive in Morton order, 4 x 4 x 4
constexpr std::size_t CellPoints = 8;   ///< likewise, 2 x 2 x 2

/** Depths of those points of a block of the field that lie within `band` of its surface; others are left as they are. */
class BlockDepths
{
public:
  BlockDepths(const BrickField& field, const std::vector<Eigen::Vector4f>& planes, double band)
    : Field(field)
    , Planes(planes)
    , Band(float(band))
  {
  }

  bool isNear(std::size_t n) const { return std::abs(this->Field.values()[n]) <= this->Band; }

  void fill(std::size_t block, std::vector<float>& depth)
  {
    if (!this->anyNear(block, BlockPoints))
    {
      return;
    }
    farthestFor(this->Planes, fromMorton(this->Field.code(block)), 4, this->Values, this->OfBlock);
    for (std::size_t cell = block; cell < block + BlockPoints; cell += CellPoints)
    {
      if (this->anyNear(cell, CellPoints))
      {
        farthestFor(this->OfBlock, fromMorton(this->Field.code(cell)), 2, this->Values, this->OfCell);
        for (std::size_t n = cell; n < cell + CellPoints; ++n)
        {
          depth[n] = this->isNear(n) ? depthInHull(this->OfCell, fromMorton(this->Field.code(n))) : depth[n];
        }
      }
    }
  }

private:
  bool anyNear(std::size_t first, std::size_t count) const
  {
    bool any = false;
    for (std::size_t n = first; n < first + count; ++n)
    {
      any = any || this->isNear(n);
    }
    return any;
  }

  const BrickField& Field;
  const std::vector<Eigen::Vector4f>& Planes;
  float Band;
  std::vector<float> Values;
  std::vector<Eigen::Vector4f> OfBlock, OfCell;
};

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
  base.convexity = std::clamp(signedVolume(surface.points, surface.triangles) / signedVolume(hull.points, hull.triangles), 0.0, 1.0);
  base.applied = base.convexity > leastConvexity;
  if (!base.applied)
  {
    return base;
  }
  std::vector<float> depth(field.values());
  execution.forRanges(depth.size() / BlockPoints, 64,
    [&](std::size_t first, std::size_t last)
    {
      BlockDepths depths(field, planes, band);
      for (std::size_t block = first; block < last; ++block)
      {
        depths.fill(block * BlockPoints, depth);
      }
    });
  const float excess = typicalExcess(field, depth);
  for (std::size_t n = 0; n < depth.size(); ++n)
  {
    if (std::abs(field.values()[n]) <= float(band))
    {
      field.values()[n] = depth[n] - excess;
    }
  }
  return base;
}

} // namespace silhouette
