// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cubes of lattice points, which stand for their points where there are many.
 */
#pragma once

#include "Lattice.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace silhouette
{

constexpr std::int32_t LeastCube = 4; ///< points along the edge of a cube, which is a block then

/** The points whose coordinates are `side` from the corner's on; `side` is a power of two, 4 and more, that divides the coordinates. */
struct PointCube
{
  std::uint64_t corner = 0; ///< Morton code of the lowest point
  std::int32_t side = 0;    ///< points along an edge

  std::uint64_t size() const { return std::uint64_t(this->side) * std::uint64_t(this->side) * std::uint64_t(this->side); }
  /** The least code that is greater than those of the points, which follow one another. */
  std::uint64_t end() const { return this->corner + this->size(); }
  bool operator==(const PointCube& o) const { return this->corner == o.corner && this->side == o.side; }
};

/** Of cubes, ascending and without a point in common, the one that holds a point, or nothing. Cost: a binary search. */
inline const PointCube* cubeOf(const std::vector<PointCube>& cubes, std::uint64_t point)
{
  const auto after = std::upper_bound(cubes.begin(), cubes.end(), point, [](std::uint64_t code, const PointCube& cube) { return code < cube.corner; });
  return after == cubes.begin() || (after - 1)->end() <= point ? nullptr : &*(after - 1);
}

/** One side of a cube. */
struct CubeFace
{
  int axis = 0;
  bool ahead = false; ///< or behind
};

namespace point_cubes
{
template <typename IsDone, typename Work>
void forBlocksAt(const CubeFace& face, const LatticePoint& low, std::int32_t side, const IsDone& isDone, const Work& work)
{
  if (std::min({ low.i, low.j, low.k }) < 0 || isDone(PointCube{ mortonCode(low), side }))
  {
    return;
  }
  if (side == LeastCube)
  {
    work(low, face);
    return;
  }
  for (int c = 0; c < 8; ++c)
  {
    if ((c >> face.axis & 1) == (face.ahead ? 0 : 1))
    {
      const LatticePoint o = cornerOffset(c);
      forBlocksAt(face, { low.i + side / 2 * o.i, low.j + side / 2 * o.j, low.k + side / 2 * o.k }, side / 2, isDone, work);
    }
  }
}
}

/**
 * Call `work(low, face)` for each block of 4 x 4 x 4 points, by its lowest, that lies beside a cube across a face of it, but for those in cubes, no larger than the
 * cube itself, that are done: `isDone(cube)`, asked from the largest on. None of negative coordinates.
 */
template <typename IsDone, typename Work> void forBlocksBeside(const PointCube& cube, const IsDone& isDone, const Work& work)
{
  const LatticePoint low = fromMorton(cube.corner);
  for (int n = 0; n < 6; ++n)
  {
    const LatticePoint step = neighbourOf({ 0, 0, 0 }, EdgeNeighbours[n]);
    const CubeFace face{ step.i != 0 ? 0 : (step.j != 0 ? 1 : 2), step.i + step.j + step.k > 0 };
    point_cubes::forBlocksAt(face, { low.i + cube.side * step.i, low.j + cube.side * step.j, low.k + cube.side * step.k }, cube.side, isDone, work);
  }
}

} // namespace silhouette
