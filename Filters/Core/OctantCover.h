// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which pixels of an image octants project to.
 */
#pragma once

#include "PreparedViews.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** A window of an image: columns and rows from the first to before the last. */
struct ImageWindow
{
  int left, right, top, bottom;

  int width() const { return this->right - this->left; }
  int height() const { return this->bottom - this->top; }
};

/** A count for each pixel of a window of how many boxes and spans hold it, kept as differences along both axes. */
class CoverCount
{
public:
  /** Of a window, in the memory of the last one. */
  void begin(const ImageWindow& window)
  {
    this->TheWindow = window;
    this->Stride = std::size_t(window.width()) + 1;
    this->Differences.assign(this->Stride * (std::size_t(window.height()) + 1), 0);
    this->Across = std::size_t(window.width() + TileSize - 1) / TileSize;
    this->WholeTiles.assign(this->Across * (std::size_t(window.height() + TileSize - 1) / TileSize), 0);
  }

  /** All pixels of a tile of the window are held by something. */
  void markWhole(std::size_t tileColumn, std::size_t tileRow) { this->WholeTiles[tileRow * this->Across + tileColumn] = 1; }

  /** Are some columns and rows, as addPixels() takes them, known to be held already? Then they need not be added. */
  bool isHeld(std::size_t column, std::size_t endColumn, std::size_t row, std::size_t endRow) const
  {
    for (std::size_t r = row / TileSize; r * TileSize < endRow; ++r)
    {
      for (std::size_t c = column / TileSize; c * TileSize < endColumn; ++c)
      {
        if (this->WholeTiles[r * this->Across + c] == 0)
        {
          return false;
        }
      }
    }
    return true;
  }

  /** The same of all pixels of the window whose squares a closed box of the image touches. */
  bool isBoxHeld(double leastX, double greatestX, double leastY, double greatestY) const
  {
    bool isHeld = true; // of none
    this->withPixels(leastX, greatestX, leastY, greatestY, [&](auto... pixels) { isHeld = this->isHeld(pixels...); });
    return isHeld;
  }

  /** All pixels of the image whose squares the closed box touches; it may reach outside. */
  void add(double leastX, double greatestX, double leastY, double greatestY)
  {
    this->withPixels(leastX, greatestX, leastY, greatestY, [&](auto... pixels) { this->addPixels(pixels...); });
  }

  /** Some columns and rows of the window, from a first one to before a last one; none where these are equal. */
  void addPixels(std::size_t column, std::size_t endColumn, std::size_t row, std::size_t endRow)
  {
    ++this->Differences[row * this->Stride + column];
    --this->Differences[row * this->Stride + endColumn];
    --this->Differences[endRow * this->Stride + column];
    ++this->Differences[endRow * this->Stride + endColumn];
  }

  /** Call `work(row, held)` for every row of the window, with how often each of its pixels is held. */
  template <typename Work>
  void forRows(const Work& work) const
  {
    std::vector<std::int32_t> held(this->Stride, 0);
    for (int row = 0; row < this->TheWindow.height(); ++row)
    {
      const std::int32_t* differences = &this->Differences[std::size_t(row) * this->Stride];
      std::int32_t along = 0;
      for (int column = 0; column < this->TheWindow.width(); ++column)
      {
        along += differences[column];
        held[std::size_t(column)] += along;
      }
      work(row, held.data());
    }
  }

  const ImageWindow& window() const { return this->TheWindow; }

  static constexpr int TileSize = 8;

private:
  /** Call `work` with the columns and rows of the window, as addPixels() takes them, that a box touches, if it touches any. */
  template <typename Work> void withPixels(double leastX, double greatestX, double leastY, double greatestY, const Work& work) const
  {
    const double left = leastX - this->TheWindow.left, right = greatestX - this->TheWindow.left;
    const double top = leastY - this->TheWindow.top, bottom = greatestY - this->TheWindow.top;
    if (right >= -0.5 && bottom >= -0.5 && left < this->TheWindow.width() && top < this->TheWindow.height())
    {
      work(first(left), end(right, this->TheWindow.width()), first(top), end(bottom, this->TheWindow.height()));
    }
  }

  static std::size_t first(double least) { return std::size_t(std::max(0.0, std::floor(least + 0.5))); }
  static std::size_t end(double greatest, int size)
  {
    return std::size_t(std::min(double(size - 1), std::floor(greatest + 0.5))) + 1;
  }

  ImageWindow TheWindow{ 0, 0, 0, 0 };
  std::size_t Stride = 1;
  std::vector<std::int32_t> Differences;
  std::size_t Across = 0;               ///< tiles of a row
  std::vector<std::uint8_t> WholeTiles; ///< 1 where all pixels are known to be held
};

/** The corners of least coordinates of some octants of one size, in lattice coordinates. */
struct OctantBlock
{
  static constexpr int Most = 256; ///< they are projected together

  double i[Most], j[Most], k[Most];
  int count = 0;

  void add(const LatticePoint& lowest)
  {
    this->i[this->count] = lowest.i;
    this->j[this->count] = lowest.j;
    this->k[this->count] = lowest.k;
    ++this->count;
  }
};

/**
 * Add the boxes around the projections of a block of last-generation octants, widened by `reach` pixels, and empty the block. Of what is not in front of the camera nothing is added. A box is that of the octant
 * as a camera without perspective would see it from its middle, where it is as good as right.
 */
void addLeaves(const LatticeProjection& projection, double reach, OctantBlock& leaves, CoverCount& count);

/**
 * Add the projections of a block of octants of a size, in last-generation octants, and empty the block; pixels count by their middles' rows. Octants that lie behind others are told by these and left out, which leaves a pixel that is met held by some. Cost: the octants, and the rows of those that show.
 */
void addOctants(const LatticeProjection& projection, std::int32_t size, OctantBlock& octants, CoverCount& count);

/** Are all pixels of the window that an octant's projection, widened by `reach` pixels, may touch known to be held already? Then nothing in it need be added. */
bool isOctantHeld(const LatticeProjection& projection, const LatticePoint& lowest, std::int32_t size, double reach, const CoverCount& count);

/** The projected corners of an octant; false where one is not in front of the camera. */
bool projectOctant(const LatticeProjection& projection, const LatticePoint& lowest, std::int32_t size, Vector2 (&corners)[8]);

} // namespace silhouette
