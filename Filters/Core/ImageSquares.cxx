// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSquares.h"

#include "Bits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace silhouette
{
namespace
{

constexpr double Guard = 1e-6; ///< squares: so far a point's image may be rounded beyond those of a box's corners

std::uint64_t tileOf(std::int64_t column, std::int64_t row)
{
  return std::uint64_t(std::uint32_t(column >> 3)) << 32 | std::uint32_t(row >> 3);
}

} // namespace

std::int64_t ImageSquares::squareOf(double coordinate) const
{
  return std::int64_t(std::floor(std::clamp(coordinate, -1e9, 1e9)));
}

void ImageSquares::add(const LatticePoint& p)
{
  const auto h = this->Projection(p);
  const std::int64_t column = this->squareOf(h.U / h.W / this->Pixels), row = this->squareOf(h.V / h.W / this->Pixels);
  this->Tiles[tileOf(column, row)] |= std::uint64_t(1) << (8 * (row & 7) + (column & 7));
}

void ImageSquares::add(const PointCube& cube)
{
  this->addBox(fromMorton(cube.corner), cube.side);
}

/** Are all squares there that a point of a cube may fall into? */
bool ImageSquares::areAllThere(const LatticePoint& low, std::int32_t side) const
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double least[2] = { infinite, infinite }, most[2] = { -infinite, -infinite };
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint o = cornerOffset(c);
    const auto h = this->Projection({ low.i + (side - 1) * o.i, low.j + (side - 1) * o.j, low.k + (side - 1) * o.k });
    const double image[2] = { h.U / h.W / this->Pixels, h.V / h.W / this->Pixels };
    for (int axis = 0; axis < 2; ++axis)
    {
      least[axis] = std::min(least[axis], image[axis] - Guard);
      most[axis] = std::max(most[axis], image[axis] + Guard);
    }
  }
  const std::int64_t lastColumn = this->squareOf(most[0]), lastRow = this->squareOf(most[1]);
  for (std::int64_t row = this->squareOf(least[1]), nextRow; row <= lastRow; row = nextRow)
  {
    nextRow = std::min((row | 7), lastRow) + 1;
    for (std::int64_t column = this->squareOf(least[0]), nextColumn; column <= lastColumn; column = nextColumn)
    {
      nextColumn = std::min((column | 7), lastColumn) + 1;
      const auto rows = ~std::uint64_t(0) >> (64 - 8 * (nextRow - row)) << 8 * (row & 7);
      const auto columns = 0x0101010101010101ULL * ((0xffu >> (8 - (nextColumn - column)) << (column & 7)) & 0xffu);
      const auto tile = this->Tiles.find(tileOf(column, row));
      if (tile == this->Tiles.end() || (~tile->second & rows & columns) != 0)
      {
        return false;
      }
    }
  }
  return true;
}

void ImageSquares::addBox(const LatticePoint& low, std::int32_t side)
{
  if (this->areAllThere(low, side))
  {
    return;
  }
  if (side == 1)
  {
    this->add(low);
    return;
  }
  const std::int32_t half = side / 2;
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint o = cornerOffset(c);
    this->addBox({ low.i + half * o.i, low.j + half * o.j, low.k + half * o.k }, half);
  }
}

std::size_t ImageSquares::count() const
{
  std::size_t sum = 0;
  for (const auto& tile : this->Tiles)
  {
    sum += std::size_t(countBits(tile.second));
  }
  return sum;
}

} // namespace silhouette
