// SPDX-License-Identifier: BSD-3-Clause
/**
 * How much of a view's image lattice points cover, counted in squares that hold one.
 */
#pragma once

#include "PointCubes.h"
#include "PreparedViews.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace silhouette
{

class ImageSquares
{
public:
  /** Squares of so many pixels; more than 0. Points have to lie in front of the camera. */
  ImageSquares(const LatticeProjection& projection, double pixels)
    : Projection(projection)
    , Pixels(pixels)
  {
  }

  void add(const LatticePoint& p);
  /** The same as with each point of a cube. Cost: where its outermost points are there already, in proportion to these. */
  void add(const PointCube& cube);
  /** How many squares hold a point. */
  std::size_t count() const;

private:
  std::int64_t squareOf(double coordinate) const;
  bool areAllThere(const LatticePoint& low, std::int32_t side) const;
  void addBox(const LatticePoint& low, std::int32_t side);

  LatticeProjection Projection;
  double Pixels;
  std::unordered_map<std::uint64_t, std::uint64_t> Tiles; ///< of 8 x 8 squares, a bit each
};

} // namespace silhouette
