// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which points of a mesh are connected through its triangles.
 */
#pragma once

#include "ConcurrentUnionFind.h"
#include "Mesh.h"

#include <vector>

namespace silhouette
{

/** Sets of the numbers below `points`: the corners of each triangle are in one. A point of no triangle is alone. Cost: near-linear. */
inline ConcurrentUnionFind connectPoints(const std::vector<Triangle>& triangles, std::size_t points, Execution& execution)
{
  ConcurrentUnionFind sets(points, execution);
  execution.forRanges(triangles.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t t = first; t < last; ++t)
      {
        sets.unite(std::uint32_t(triangles[t][0]), std::uint32_t(triangles[t][1]));
        sets.unite(std::uint32_t(triangles[t][0]), std::uint32_t(triangles[t][2]));
      }
    });
  return sets;
}

/** Number of these sets, points of no triangle counted. */
inline std::uint64_t countComponents(const Mesh& mesh, Execution& execution)
{
  ConcurrentUnionFind sets = connectPoints(mesh.triangles, mesh.points.size(), execution);
  std::uint64_t count = 0;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p)
  {
    count += sets.find(p) == p;
  }
  return count;
}

} // namespace silhouette
