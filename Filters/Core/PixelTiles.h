// SPDX-License-Identifier: BSD-3-Clause
/**
 * A two-valued image as tiles of 8 x 8 pixels, a bit each, with a summed-area table of the tiles: small enough that
 * dozens of images stay in the processor's caches. It answers what an octant asks: do these pixels hold object, do
 * they hold background? Small ranges take four words, large ones the table and the tiles along their border.
 *
 * Private to PreparedViews: whoever asks about a pixel asks there.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** What a range of an image's pixels holds. */
struct TileContent
{
  bool object = false;
  bool background = false;
};

class PixelTiles
{
public:
  static constexpr int Size = 8; ///< pixels of a tile's side

  PixelTiles() = default;
  /** Of width x height values, the top row first; what is not 0 is object. Memory: a fifth of a byte a pixel. */
  PixelTiles(const std::uint8_t* pixels, int width, int height);

  /** Is pixel (column, row), which lies in the image, object? */
  bool object(int column, int row) const
  {
    return this->tile(column >> 3, row >> 3) >> (8 * (row & 7) + (column & 7)) & 1u;
  }

  /**
   * The 8 x 8 pixels from (column, row), which lies in the image, to the right and downwards: bit 8 r + c is set
   * where the pixel r below and c to the right is object. Beyond the image no bit is set.
   */
  std::uint64_t window(int column, int row) const
  {
    const std::uint64_t* t = this->Tiles.data() + std::size_t(row >> 3) * this->Stride + (column >> 3);
    const int down = 8 * (row & 7), across = column & 7;
    // Two shifts instead of one by 64, which would be undefined.
    const std::uint64_t left = t[0] >> down | t[this->Stride] << 1 << (63 - down);
    const std::uint64_t right = t[1] >> down | t[this->Stride + 1] << 1 << (63 - down);
    const std::uint64_t kept = 0x0101010101010101ULL * (0xffu >> across);
    return (left >> across & kept) | (right << (8 - across) & ~kept);
  }

  /** The bits of a window that lie in its first `columns` and `rows`, 1 to 8 each. */
  static std::uint64_t windowPart(int columns, int rows)
  {
    return 0x0101010101010101ULL * (0xffu >> (8 - columns)) & ~std::uint64_t(0) >> (64 - 8 * rows);
  }

  /** What the pixels of the inclusive ranges hold, which are not empty and lie in the image. */
  TileContent content(int firstColumn, int lastColumn, int firstRow, int lastRow) const;

  /** Number of object pixels in [c0, c1) x [r0, r1), which lies in the image. */
  std::int64_t count(int c0, int c1, int r0, int r1) const;

  /** Least and greatest column, least and greatest row of the object; width, -1, height, -1 where there is none. */
  std::array<int, 4> objectBox() const;

  /** All bits, tile by tile, for a hash of them. */
  const std::vector<std::uint64_t>& words() const { return this->Tiles; }

private:
  std::uint64_t tile(int x, int y) const { return this->Tiles[std::size_t(y) * this->Stride + x]; }
  std::int64_t countTiles(int x0, int x1, int y0, int y1) const;
  TileContent fromTiles(int x0, int x1, int y0, int y1) const;
  void sumTiles();

  int Width = 0;
  int Height = 0;
  int Columns = 0;            ///< of tiles
  int Rows = 0;               ///< of tiles
  std::size_t Stride = 0;     ///< one tile more than Columns, so that a window needs no border case
  std::vector<std::uint64_t> Tiles; ///< Stride x (Rows + 1)
  std::vector<std::int32_t> Sums;   ///< (Columns + 1) x (Rows + 1): object pixels of the tiles above and left
};

} // namespace silhouette
