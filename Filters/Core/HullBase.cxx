// SPDX-License-Identifier: BSD-3-Clause
#include "HullBase.h"

#include "ConvexHull.h"
#include "Vectorised.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace silhouette
{
namespace
{

constexpr float Beside = 0.5f; ///< octants from the surface within which the median is taken

/** Planes n.x + d, coordinate by coordinate; their number is filled up to a multiple of Lanes with the first one. */
class Planes
{
public:
  static constexpr std::size_t Lanes = 8;

  bool empty() const { return this->Count == 0; }
  std::size_t size() const { return this->Count; }
  std::size_t padded() const { return this->X.size(); }
  const float* x() const { return this->X.data(); }
  const float* y() const { return this->Y.data(); }
  const float* z() const { return this->Z.data(); }
  const float* d() const { return this->D.data(); }

  void clear()
  {
    this->Count = 0;
    for (auto* numbers : { &this->X, &this->Y, &this->Z, &this->D })
    {
      numbers->clear();
    }
  }
  void add(float x, float y, float z, float d)
  {
    ++this->Count;
    this->X.push_back(x);
    this->Y.push_back(y);
    this->Z.push_back(z);
    this->D.push_back(d);
  }
  /** Once all are there. */
  void pad()
  {
    for (auto* numbers : { &this->X, &this->Y, &this->Z, &this->D })
    {
      numbers->resize((this->Count + Lanes - 1) / Lanes * Lanes, numbers->empty() ? 0.0f : numbers->front());
    }
  }

private:
  std::size_t Count = 0;
  std::vector<float> X, Y, Z, D;
};

/** Each plane's value at a point; returns the greatest. */
SILHOUETTE_VECTORISED float valuesAt(const Planes& planes, float x, float y, float z, float* values)
{
  const float *nx = planes.x(), *ny = planes.y(), *nz = planes.z(), *d = planes.d();
  float most[Planes::Lanes];
  std::fill(most, most + Planes::Lanes, -std::numeric_limits<float>::infinity());
  for (std::size_t n = 0; n < planes.padded(); n += Planes::Lanes)
  {
    for (std::size_t lane = 0; lane < Planes::Lanes; ++lane)
    {
      const float value = (nx[n + lane] * x + nz[n + lane] * z) + (ny[n + lane] * y + d[n + lane]);
      values[n + lane] = value;
      most[lane] = most[lane] < value ? value : most[lane];
    }
  }
  return *std::max_element(most, most + Planes::Lanes);
}

/** The planes of a hull's facets in lattice coordinates, positive outside; facets without an area have none. */
Planes planesOf(const Mesh& hull, const Lattice& lattice)
{
  Planes planes;
  const auto place = [&](std::int32_t point) -> Eigen::Vector3d
  { return (hull.points[point] - lattice.root.origin) / lattice.leafEdge(); };
  for (const Triangle& t : hull.triangles)
  {
    const Eigen::Vector3d a = place(t[0]);
    const Eigen::Vector3d across = (place(t[1]) - a).cross(place(t[2]) - a);
    if (across.norm() > 1e-9)
    {
      const Eigen::Vector3d normal = across.normalized();
      planes.add(float(normal[0]), float(normal[1]), float(normal[2]), float(-normal.dot(a)));
    }
  }
  planes.pad();
  return planes;
}

/** Those of the planes that may be the farthest out for a point of a cube of `side` lattice points from `lowest` on. */
void farthestFor(
  const Planes& planes, const LatticePoint& lowest, int side, std::vector<float>& values, Planes& farthest)
{
  const float half = 0.5f * float(side - 1);
  values.resize(planes.padded());
  const float most =
    valuesAt(planes, float(lowest.i) + half, float(lowest.j) + half, float(lowest.k) + half, values.data());
  // From the centre to a point no plane's value changes by more than the way.
  const float least = most - 2.0f * std::sqrt(3.0f) * half - 0.01f;
  farthest.clear();
  for (std::size_t n = 0; n < planes.size(); ++n)
  {
    if (values[n] >= least)
    {
      farthest.add(planes.x()[n], planes.y()[n], planes.z()[n], planes.d()[n]);
    }
  }
  farthest.pad();
}

constexpr std::size_t BlockPoints = 64; ///< consecutive in Morton order, 4 x 4 x 4
constexpr std::size_t CellPoints = 8;   ///< likewise, 2 x 2 x 2

/** Depths of those points of a block of the field that lie within `band` of its surface; others are left as they are. */
class BlockDepths
{
public:
  BlockDepths(const BrickField& field, const Planes& planes, double band)
    : Field(field)
    , OfHull(planes)
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
    farthestFor(this->OfHull, fromMorton(this->Field.code(block)), 4, this->Values, this->OfBlock);
    for (std::size_t cell = block; cell < block + BlockPoints; cell += CellPoints)
    {
      if (this->anyNear(cell, CellPoints))
      {
        farthestFor(this->OfBlock, fromMorton(this->Field.code(cell)), 2, this->Values, this->OfCell);
        for (std::size_t n = cell; n < cell + CellPoints; ++n)
        {
          depth[n] = this->isNear(n) ? this->depthInHull(fromMorton(this->Field.code(n))) : depth[n];
        }
      }
    }
  }

private:
  /** By the planes of the point's cell. */
  float depthInHull(const LatticePoint& p)
  {
    return -valuesAt(this->OfCell, float(p.i), float(p.j), float(p.k), this->Values.data());
  }

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
  const Planes& OfHull;
  float Band;
  std::vector<float> Values;
  Planes OfBlock, OfCell;
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

constexpr std::size_t FewPoints = 2000; ///< of a surface, whose hull is made first

/** The volume of a surface as a share of some points' hull, at most 1; 0 where there is no hull. */
double shareOf(const Mesh& hull, const Mesh& surface)
{
  return hull.triangles.empty()
    ? 0.0
    : std::clamp(signedVolume(surface.points, surface.triangles) / signedVolume(hull.points, hull.triangles), 0.0, 1.0);
}

/** The share of a hull that lies within the points' and takes little time; 1 where that tells nothing. */
double greatestConvexity(const Mesh& surface)
{
  if (surface.points.size() < 2 * FewPoints)
  {
    return 1.0;
  }
  std::vector<Eigen::Vector3d> some;
  const std::size_t step = surface.points.size() / FewPoints;
  for (std::size_t n = 0; n < surface.points.size(); n += step)
  {
    some.push_back(surface.points[n]);
  }
  const Mesh hull = convexHull(some).value_or(Mesh());
  return hull.triangles.empty() ? 1.0 : shareOf(hull, surface);
}

} // namespace

HullBase applyHullBase(BrickField& field, const Mesh& surface, double leastConvexity, double band, Execution& execution)
{
  HullBase base;
  if (leastConvexity >= 1.0 || surface.triangles.empty())
  {
    return base;
  }
  base.convexity = greatestConvexity(surface);
  if (base.convexity <= leastConvexity)
  {
    return base;
  }
  const Mesh hull = convexHull(surface.points).value_or(Mesh());
  const auto planes = planesOf(hull, field.lattice());
  base.convexity = planes.empty() ? 0.0 : shareOf(hull, surface);
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
