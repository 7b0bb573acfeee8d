// SPDX-License-Identifier: BSD-3-Clause
#include "LocalHulls.h"

#include "ConvexHull.h"
#include "ParameterRange.h"
#include "UnionFind.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <tuple>

namespace silhouette
{
namespace
{

struct Part
{
  std::vector<Eigen::Vector3d> corners; ///< enough points to span the hull
  std::vector<std::int32_t> points;     ///< all surface points, ascending
  std::set<std::int32_t> neighbours;
  Eigen::AlignedBox3d box;
  std::optional<Mesh> hull;
  bool alive = true;
};

/** Half-spaces of a convex mesh: normal . x <= offset, in lattice coordinates. */
std::vector<Eigen::Vector4d> halfSpaces(const Mesh& hull, const Lattice& lattice)
{
  const auto local = [&](std::int32_t i) -> Eigen::Vector3d
  { return (hull.points[i] - lattice.root.origin) / lattice.leafEdge(); };
  std::vector<Eigen::Vector4d> planes;
  for (const auto& t : hull.triangles)
  {
    const Eigen::Vector3d a = local(t[0]);
    const Eigen::Vector3d normal = (local(t[1]) - a).cross(local(t[2]) - a);
    const double length = normal.norm();
    if (length > 1e-12)
    {
      planes.emplace_back(normal.x() / length, normal.y() / length, normal.z() / length, normal.dot(a) / length);
    }
  }
  return planes;
}

/** Does the hull hold an outside corner deeper than `tolerance`? Row by row, skipping whole inside octants. */
bool holdsOutside(const Mesh& hull, const LatticeLabels& labels, double tolerance)
{
  const double depth = std::max(tolerance, 1e-9); // a corner in a facet is not in the hull
  const Octree& octree = labels.octree();
  const auto planes = halfSpaces(hull, octree.lattice);
  Eigen::AlignedBox3d box;
  for (const auto& p : hull.points)
  {
    box.extend(Eigen::Vector3d((p - octree.lattice.root.origin) / octree.lattice.leafEdge()));
  }
  const double last = octree.lattice.cells();
  if (!((box.min().array() >= -depth).all() && (box.max().array() <= last + depth).all()))
  {
    return true; // everything beyond the lattice is outside
  }
  for (int k = int(std::ceil(box.min().z())); k <= box.max().z(); ++k)
  {
    for (int j = int(std::ceil(box.min().y())); j <= box.max().y(); ++j)
    {
      double from = box.min().x(), to = box.max().x();
      for (const auto& plane : planes)
      {
        const double rest = plane[3] - depth - plane[1] * j - plane[2] * k;
        if (std::abs(plane[0]) < 1e-12)
        {
          to = rest < 0.0 ? -std::numeric_limits<double>::infinity() : to;
        }
        else if (plane[0] > 0.0)
        {
          to = std::min(to, rest / plane[0]);
        }
        else
        {
          from = std::max(from, rest / plane[0]);
        }
      }
      for (int i = int(std::ceil(from)); i <= to; ++i)
      {
        const auto location = octree.locate({ i, j, k });
        if (location.state == OctantState::Inside)
        {
          const int shift = octree.lattice.depth - location.generation;
          i = (((i >> shift) + 1) << shift) - 1;
        }
        else if (!labels.insideAt({ i, j, k }))
        {
          return true;
        }
      }
    }
  }
  return false;
}

/** The patches of the surface within blocks, joined through shared points. */
std::vector<Part> makeSeeds(const Mesh& surface, const Lattice& lattice, int block)
{
  const auto& triangles = surface.triangles;
  using BlockPoint = std::tuple<std::int32_t, std::int64_t, std::int64_t, std::int64_t, std::int32_t>;
  std::vector<BlockPoint> uses; // (point, block, triangle)
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const auto& T = triangles[t];
    const Eigen::Vector3d centroid = (surface.points[T[0]] + surface.points[T[1]] + surface.points[T[2]]) / 3.0;
    const Eigen::Array3d b = ((centroid - lattice.root.origin).array() / (lattice.leafEdge() * block)).floor();
    for (const auto point : T)
    {
      uses.emplace_back(point, std::int64_t(b[0]), std::int64_t(b[1]), std::int64_t(b[2]), std::int32_t(t));
    }
  }
  std::sort(uses.begin(), uses.end());
  UnionFind patches(triangles.size());
  for (std::size_t i = 1; i < uses.size(); ++i)
  {
    const auto& [p, x, y, z, t] = uses[i];
    const auto& [q, u, v, w, s] = uses[i - 1];
    if (p == q && x == u && y == v && z == w)
    {
      patches.unite(std::uint32_t(t), std::uint32_t(s));
    }
  }
  std::vector<std::int32_t> number(triangles.size(), -1);
  std::vector<Part> parts;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    const auto root = patches.find(std::uint32_t(t));
    if (number[root] < 0)
    {
      number[root] = std::int32_t(parts.size());
      parts.emplace_back();
    }
    auto& points = parts[number[root]].points;
    points.insert(points.end(), triangles[t].begin(), triangles[t].end());
  }
  for (std::size_t i = 1; i < uses.size(); ++i)
  {
    const auto a = number[patches.find(std::uint32_t(std::get<4>(uses[i])))];
    const auto b = number[patches.find(std::uint32_t(std::get<4>(uses[i - 1])))];
    if (std::get<0>(uses[i]) == std::get<0>(uses[i - 1]) && a != b)
    {
      parts[a].neighbours.insert(b);
      parts[b].neighbours.insert(a);
    }
  }
  return parts;
}

void finishSeed(const Mesh& surface, Part& part)
{
  std::sort(part.points.begin(), part.points.end());
  part.points.erase(std::unique(part.points.begin(), part.points.end()), part.points.end());
  for (const auto point : part.points)
  {
    part.corners.push_back(surface.points[point]);
    part.box.extend(surface.points[point]);
  }
  part.hull = convexHull(part.corners);
  if (part.hull)
  {
    part.corners = part.hull->points;
  }
}

/** Merges neighbouring parts, smallest joint box first. */
class Merger
{
public:
  Merger(std::vector<Part>& parts, const LatticeLabels& labels, double tolerance)
    : Parts(parts)
    , Labels(labels)
    , Tolerance(tolerance)
  {
  }

  void run(Execution& execution)
  {
    for (std::size_t a = 0; a < this->Parts.size(); ++a)
    {
      this->offer(std::int32_t(a), true);
    }
    const double initial = double(std::max<std::size_t>(1, this->Queue.size()));
    for (std::size_t step = 0; !this->Queue.empty(); ++step)
    {
      const auto [volume, a, b] = this->Queue.top();
      this->Queue.pop();
      if (this->Parts[a].alive && this->Parts[b].alive)
      {
        this->tryMerge(a, b);
      }
      if (step % 64 == 0)
      {
        execution.checkpoint(1.0 - 1.0 / (1.0 + double(step) / initial));
      }
    }
  }

private:
  using Pair = std::tuple<double, std::int32_t, std::int32_t>;

  void offer(std::int32_t a, bool onlyLater)
  {
    for (const std::int32_t b : this->Parts[a].neighbours)
    {
      if (!onlyLater || b > a)
      {
        const auto joint = this->Parts[a].box.merged(this->Parts[b].box);
        this->Queue.emplace(joint.volume(), std::min(a, b), std::max(a, b));
      }
    }
  }

  void tryMerge(std::int32_t a, std::int32_t b)
  {
    std::vector<Eigen::Vector3d> corners = this->Parts[a].corners;
    corners.insert(corners.end(), this->Parts[b].corners.begin(), this->Parts[b].corners.end());
    auto hull = convexHull(corners);
    if (hull && holdsOutside(*hull, this->Labels, this->Tolerance))
    {
      return;
    }
    Part merged;
    merged.corners = hull ? hull->points : corners;
    merged.hull = std::move(hull);
    merged.box = this->Parts[a].box.merged(this->Parts[b].box);
    std::merge(this->Parts[a].points.begin(), this->Parts[a].points.end(), this->Parts[b].points.begin(),
      this->Parts[b].points.end(), std::back_inserter(merged.points));
    merged.points.erase(std::unique(merged.points.begin(), merged.points.end()), merged.points.end());
    const auto number = std::int32_t(this->Parts.size());
    for (const std::int32_t part : { a, b })
    {
      this->Parts[part].alive = false;
      for (const std::int32_t other : this->Parts[part].neighbours)
      {
        this->Parts[other].neighbours.erase(part);
        if (other != a && other != b)
        {
          merged.neighbours.insert(other);
          this->Parts[other].neighbours.insert(number);
        }
      }
      this->Parts[part] = Part();
      this->Parts[part].alive = false;
    }
    this->Parts.push_back(std::move(merged));
    this->offer(number, false);
  }

  std::vector<Part>& Parts;
  const LatticeLabels& Labels;
  double Tolerance;
  std::priority_queue<Pair, std::vector<Pair>, std::greater<Pair>> Queue;
};

} // namespace

std::vector<LocalHull> localHulls(
  const Mesh& surface, const LatticeLabels& labels, const LocalHullsOptions& options, Execution& execution)
{
  requireRange("seed block", options.seedBlock, 1);
  requireRange("hull tolerance", options.tolerance, 0.0);
  std::vector<Part> parts = makeSeeds(surface, labels.octree().lattice, options.seedBlock);
  execution.forRanges(parts.size(), 16,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        finishSeed(surface, parts[p]);
      }
    });
  execution.checkpoint(0.2);
  Phase merging(execution, 0.2, 1.0);
  Merger(parts, labels, options.tolerance).run(merging);

  std::vector<LocalHull> hulls;
  for (auto& part : parts)
  {
    if (part.alive && part.hull)
    {
      hulls.push_back({ std::move(*part.hull), std::move(part.points) });
    }
  }
  std::sort(hulls.begin(), hulls.end(),
    [](const LocalHull& a, const LocalHull& b) { return a.surfacePoints < b.surfacePoints; });
  execution.checkpoint(1.0);
  return hulls;
}

} // namespace silhouette
