// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cubes of lattice points, which stand for their points where there are many: a solid set of points is known by its cubes' outermost points.
 */
#pragma once

#include "Lattice.h"

#include <array>
#include <cstdint>

namespace silhouette
{

/** The points whose coordinates are `side` from the corner's on; `side` is a power of two that divides the coordinates. */
struct PointCube
{
  std::uint64_t corner = 0; ///< Morton code of the lowest point
  std::int32_t side = 0;    ///< points along an edge

  /** The least code that is greater than those of the points, which follow one another. */
  std::uint64_t end() const { return this->corner + this->count(this->side); }
  /** How many of the points have a neighbour outside. */
  std::uint64_t outermost() const { return this->count(this->side) - (this->side > 2 ? this->count(this->side - 2) : 0); }

  bool operator==(const PointCube& o) const { return this->corner == o.corner && this->side == o.side; }

private:
  static std::uint64_t count(std::int32_t side) { return std::uint64_t(side) * std::uint64_t(side) * std::uint64_t(side); }
};

/** Call `work(p)` for each point of a box of so many points along the axes. */
template <typename Work> void forBox(const LatticePoint& low, const std::array<std::int32_t, 3>& sizes, const Work& work)
{
  for (std::int32_t k = 0; k < sizes[2]; ++k)
  {
    for (std::int32_t j = 0; j < sizes[1]; ++j)
    {
      for (std::int32_t i = 0; i < sizes[0]; ++i)
      {
        work(LatticePoint{ low.i + i, low.j + j, low.k + k });
      }
    }
  }
}

/** Call `work(p)` once for each point of a cube of side 2 and more that has a neighbour outside. */
template <typename Work> void forOutermost(const PointCube& cube, const Work& work)
{
  const LatticePoint low = fromMorton(cube.corner);
  const std::int32_t side = cube.side;
  for (const std::int32_t far : { 0, side - 1 })
  {
    forBox({ low.i + far, low.j, low.k }, { 1, side, side }, work);
    forBox({ low.i + 1, low.j + far, low.k }, { side - 2, 1, side }, work);
    forBox({ low.i + 1, low.j + 1, low.k + far }, { side - 2, side - 2, 1 }, work);
  }
}

/** Call `work(p)` once for each point one step along a lattice edge from a cube, outside; coordinates may be negative. */
template <typename Work> void forBeside(const PointCube& cube, const Work& work)
{
  const LatticePoint low = fromMorton(cube.corner);
  const std::int32_t side = cube.side;
  for (const std::int32_t far : { -1, side })
  {
    forBox({ low.i + far, low.j, low.k }, { 1, side, side }, work);
    forBox({ low.i, low.j + far, low.k }, { side, 1, side }, work);
    forBox({ low.i, low.j, low.k + far }, { side, side, 1 }, work);
  }
}

} // namespace silhouette
