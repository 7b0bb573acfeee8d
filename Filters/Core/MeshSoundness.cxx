// SPDX-License-Identifier: BSD-3-Clause
#include "MeshSoundness.h"

#include "MeshCheck.h"
#include "MeshComponents.h"
#include "SelfIntersections.h"
#include "UnionFind.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <vector>

namespace silhouette
{

namespace
{

/**
 * For each point the triangles around it: corner 3 t + c of triangle t is in its point's part of `corners`.
 */
struct Corners
{
  std::vector<std::size_t> first; ///< one more than points
  std::vector<std::size_t> corners;
};

Corners cornersOfPoints(const Mesh& mesh)
{
  Corners result;
  result.first.assign(mesh.points.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
  {
    for (const std::int32_t p : t)
    {
      ++result.first[p + 1];
    }
  }
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  std::vector<std::size_t> next(result.first.begin(), result.first.end() - 1);
  result.corners.resize(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      result.corners[next[mesh.triangles[t][c]]++] = 3 * t + c;
    }
  }
  return result;
}

/**
 * One end of the edge that faces a point: which neighbour, and of which of the triangles around the point.
 */
struct LinkEnd
{
  std::int32_t neighbour;
  std::int32_t triangle;
  bool operator<(const LinkEnd& o) const
  {
    return this->neighbour != o.neighbour ? this->neighbour < o.neighbour : this->triangle < o.triangle;
  }
};

/**
 * Are these triangles around a point one fan? The edges that face the point have to form one path or one
 * cycle: each neighbour ends at most two of them, and all hang together.
 */
bool isOneFan(std::vector<LinkEnd>& ends, std::int32_t point)
{
  std::sort(ends.begin(), ends.end());
  UnionFind fans(ends.size() / 2);
  std::size_t pieces = fans.size();
  for (std::size_t first = 0; first < ends.size();)
  {
    std::size_t last = first + 1;
    while (last < ends.size() && ends[last].neighbour == ends[first].neighbour)
    {
      ++last;
    }
    if (last - first > 2 || ends[first].neighbour == point)
    {
      return false;
    }
    if (last - first == 2 && fans.find(ends[first].triangle) != fans.find(ends[first + 1].triangle))
    {
      fans.unite(ends[first].triangle, ends[first + 1].triangle);
      --pieces;
    }
    first = last;
  }
  return pieces == 1;
}

void assessPoints(const Mesh& mesh, Execution& execution, MeshSoundness& result)
{
  const Corners around = cornersOfPoints(mesh);
  std::vector<std::uint8_t> oneFan(mesh.points.size(), 1);
  execution.forRanges(mesh.points.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      std::vector<LinkEnd> ends;
      for (std::size_t p = first; p < last; ++p)
      {
        ends.clear();
        for (std::size_t i = around.first[p]; i < around.first[p + 1]; ++i)
        {
          const std::size_t corner = around.corners[i];
          const Triangle& t = mesh.triangles[corner / 3];
          const auto number = std::int32_t(i - around.first[p]);
          ends.push_back({ t[(corner + 1) % 3], number });
          ends.push_back({ t[(corner + 2) % 3], number });
        }
        oneFan[p] = ends.empty() || isOneFan(ends, std::int32_t(p));
      }
    });
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    const bool used = around.first[p] != around.first[p + 1];
    ++(used ? result.points : result.unusedPoints);
    result.nonManifoldVertices += oneFan[p] == 0;
  }
}

/** Counts the edges' faults; returns the number of edges. */
std::uint64_t assessEdges(const Mesh& mesh, MeshSoundness& result)
{
  // An edge's lesser point, its greater one, and in the lowest bit which way the triangle runs along it.
  std::vector<std::uint64_t> runs;
  runs.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
  {
    for (int c = 0; c < 3; ++c)
    {
      const auto [low, high] = std::minmax({ t[c], t[(c + 1) % 3] });
      runs.push_back(std::uint64_t(low) << 32 | std::uint64_t(high) << 1 | std::uint64_t(low == t[c]));
    }
  }
  std::sort(runs.begin(), runs.end());
  std::uint64_t edges = 0;
  for (std::size_t first = 0; first < runs.size();)
  {
    std::size_t last = first + 1;
    while (last < runs.size() && runs[last] >> 1 == runs[first] >> 1)
    {
      ++last;
    }
    const bool loop = runs[first] >> 32 == (runs[first] & 0xffffffffU) >> 1;
    result.nonManifoldEdges += loop || last - first > 2;
    result.openEdges += !loop && last - first == 1;
    result.inconsistentEdges += !loop && last - first == 2 && runs[first] == runs[first + 1];
    ++edges;
    first = last;
  }
  return edges;
}

void measure(const Mesh& mesh, MeshSoundness& result)
{
  Eigen::AlignedBox3d bounds;
  for (const Triangle& t : mesh.triangles)
  {
    for (const std::int32_t p : t)
    {
      bounds.extend(mesh.points[p]);
    }
  }
  // About the centre, lest a mesh far from the origin lose the digits of its volume.
  const Eigen::Vector3d centre =
    mesh.triangles.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(bounds.center());
  for (const Triangle& t : mesh.triangles)
  {
    const Eigen::Vector3d a = mesh.points[t[0]] - centre;
    const Eigen::Vector3d b = mesh.points[t[1]] - centre;
    const Eigen::Vector3d c = mesh.points[t[2]] - centre;
    result.volume += a.dot(b.cross(c)) / 6.0;
    result.area += (b - a).cross(c - a).norm() / 2.0;
  }
}

} // namespace

MeshSoundness assessMesh(const Mesh& mesh, Execution& execution)
{
  checkMesh(mesh);
  MeshSoundness result;
  result.triangles = mesh.triangles.size();
  execution.checkpoint(0.0);
  assessPoints(mesh, execution, result);
  execution.checkpoint(0.15);
  const std::uint64_t edges = assessEdges(mesh, result);
  result.components = countComponents(mesh, execution) - result.unusedPoints; // each of these is a set of its own
  measure(mesh, result);
  const bool hasGenus = result.closed() && result.nonManifoldEdges == 0 && result.nonManifoldVertices == 0 &&
    result.inconsistentEdges == 0;
  if (hasGenus)
  {
    // Euler: points - edges + triangles = 2 components - 2 genus.
    const auto characteristic =
      std::int64_t(result.points) - std::int64_t(edges) + std::int64_t(result.triangles);
    result.genus = std::int64_t(result.components) - characteristic / 2;
  }
  Phase intersections(execution, 0.3, 1.0);
  result.selfIntersections = selfIntersections(mesh, intersections).size();
  return result;
}

Mesh weldCoincidentPoints(const Mesh& mesh)
{
  std::vector<std::int32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&mesh](std::int32_t a, std::int32_t b)
  {
    const Eigen::Vector3d& p = mesh.points[a];
    const Eigen::Vector3d& q = mesh.points[b];
    for (int axis = 0; axis < 3; ++axis)
    {
      if (p[axis] != q[axis])
      {
        return p[axis] < q[axis];
      }
    }
    return a < b;
  };
  checkMesh(mesh); // an order of NaNs would be none
  std::sort(order.begin(), order.end(), compare);
  std::vector<std::int32_t> firstEqual(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool equal = i > 0 && mesh.points[order[i]] == mesh.points[order[i - 1]];
    firstEqual[order[i]] = equal ? firstEqual[order[i - 1]] : order[i];
  }
  Mesh result;
  std::vector<std::int32_t> newIndex(mesh.points.size());
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    if (firstEqual[p] == std::int32_t(p))
    {
      newIndex[p] = std::int32_t(result.points.size());
      result.points.push_back(mesh.points[p]);
    }
  }
  result.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
  {
    result.triangles.push_back(
      { newIndex[firstEqual[t[0]]], newIndex[firstEqual[t[1]]], newIndex[firstEqual[t[2]]] });
  }
  return result;
}

} // namespace silhouette
