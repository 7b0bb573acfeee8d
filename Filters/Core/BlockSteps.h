// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which points of blocks of 4 x 4 x 4 are neighbours: within a block and in those around it, for all points of a word at a time.
 */
#pragma once

#include "BlockBits.h"
#include "Lattice.h"

#include <cstdint>
#include <cstdlib>

namespace silhouette
{

/** In how many coordinates neighbours may differ, by one. */
enum class Steps : int
{
  Faces = 1,
  Edges = 2,
  Corners = 3
};

/** The points of a block, and those one step before and behind on an axis. */
inline std::uint64_t spreadInBlock(std::uint64_t points, int axis)
{
  return points | fromAhead(points, 0, axis) | fromBehind(points, 0, axis);
}

/** The points of a block, and their neighbours in it. */
inline std::uint64_t withNeighbours(std::uint64_t points, Steps steps)
{
  const std::uint64_t alongX = spreadInBlock(points, 0), alongY = spreadInBlock(points, 1);
  switch (steps)
  {
    case Steps::Faces:
      return alongX | alongY | spreadInBlock(points, 2);
    case Steps::Edges:
      return spreadInBlock(alongX, 1) | spreadInBlock(alongX | alongY, 2);
    default:
      return spreadInBlock(spreadInBlock(alongX, 1), 2);
  }
}

/** Those of `points` that meet the lowest of them. */
inline std::uint64_t partOfLowest(std::uint64_t points, Steps steps)
{
  std::uint64_t part = points & (0 - points);
  for (std::uint64_t before = 0; before != part;)
  {
    before = part;
    part = withNeighbours(part, steps) & points;
  }
  return part;
}

/** To one of the blocks around a block. */
struct BlockDirection
{
  LatticePoint step;
  int spreads = 0; ///< so many further coordinates of neighbours may differ

  /** `n`: of neighbourOf(). */
  BlockDirection(int n, Steps steps)
    : step(neighbourOf({ 0, 0, 0 }, n))
    , spreads(int(steps) - std::abs(this->step.i) - std::abs(this->step.j) - std::abs(this->step.k))
  {
  }

  /** Where the points of a block come to lie in the block in this direction, if they go one step. */
  std::uint64_t moved(std::uint64_t points) const
  {
    const int steps[3] = { this->step.i, this->step.j, this->step.k };
    for (int axis = 0; axis < 3; ++axis)
    {
      points = steps[axis] > 0 ? fromBehind(0, points, axis) : steps[axis] < 0 ? fromAhead(0, points, axis) : points;
    }
    return points;
  }

  /** All neighbours in that block. */
  std::uint64_t reached(std::uint64_t points) const
  {
    const std::uint64_t there = this->moved(points);
    if (this->spreads == 0 || there == 0)
    {
      return there;
    }
    const int steps[3] = { this->step.i, this->step.j, this->step.k };
    std::uint64_t one = there, several = there; // of the coordinates that are left, and of as many as there are
    for (int axis = 0; axis < 3; ++axis)
    {
      if (steps[axis] == 0)
      {
        one |= spreadInBlock(there, axis);
        several = spreadInBlock(several, axis);
      }
    }
    return this->spreads == 1 ? one : several;
  }
};

} // namespace silhouette
