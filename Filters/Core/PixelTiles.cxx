// SPDX-License-Identifier: BSD-3-Clause
#include "PixelTiles.h"

#include "Bits.h"

#include <algorithm>
#include <cstring>

namespace silhouette
{
namespace
{

/** Bit i says whether byte i of eight is other than 0. */
std::uint64_t eightPixels(const std::uint8_t* pixels)
{
  std::uint64_t word = 0;
  std::memcpy(&word, pixels, 8);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  word = __builtin_bswap64(word);
#endif
  constexpr std::uint64_t Low = 0x7f7f7f7f7f7f7f7fULL;
  word = (((word & Low) + Low) | word) >> 7 & 0x0101010101010101ULL;
  return word * 0x0102040810204080ULL >> 56;
}

std::uint64_t fewPixels(const std::uint8_t* pixels, int count)
{
  std::uint64_t bits = 0;
  for (int i = 0; i < count; ++i)
  {
    bits |= std::uint64_t(pixels[i] != 0) << i;
  }
  return bits;
}

/** The bits of a tile in columns first to last and rows first to last of the image, cut to the tile at (x, y). */
std::uint64_t tilePart(int x, int y, int firstColumn, int lastColumn, int firstRow, int lastRow)
{
  const int c0 = std::max(firstColumn - 8 * x, 0), c1 = std::min(lastColumn - 8 * x, 7);
  const int r0 = std::max(firstRow - 8 * y, 0), r1 = std::min(lastRow - 8 * y, 7);
  return PixelTiles::windowPart(c1 - c0 + 1, r1 - r0 + 1) << (8 * r0 + c0);
}

} // namespace

PixelTiles::PixelTiles(const std::uint8_t* pixels, int width, int height)
  : Width(width)
  , Height(height)
  , Columns((width + 7) / 8)
  , Rows((height + 7) / 8)
  , Stride(std::size_t(this->Columns) + 1)
  , Tiles(this->Stride * (std::size_t(this->Rows) + 1), 0)
{
  const int whole = width / 8;
  for (int row = 0; row < height; ++row)
  {
    const std::uint8_t* from = pixels + std::size_t(row) * width;
    std::uint64_t* to = &this->Tiles[std::size_t(row / 8) * this->Stride];
    const int shift = 8 * (row & 7);
    for (int x = 0; x < whole; ++x)
    {
      to[x] |= eightPixels(from + 8 * x) << shift;
    }
    if (width > 8 * whole)
    {
      to[whole] |= fewPixels(from + 8 * whole, width - 8 * whole) << shift;
    }
  }
  this->sumTiles();
}

void PixelTiles::sumTiles()
{
  const std::size_t stride = std::size_t(this->Columns) + 1;
  this->Sums.assign(stride * (std::size_t(this->Rows) + 1), 0);
  for (int y = 0; y < this->Rows; ++y)
  {
    std::int32_t inRow = 0;
    const std::int32_t* above = &this->Sums[std::size_t(y) * stride];
    std::int32_t* sums = &this->Sums[std::size_t(y + 1) * stride];
    for (int x = 0; x < this->Columns; ++x)
    {
      inRow += countBits(this->tile(x, y));
      sums[x + 1] = above[x + 1] + inRow;
    }
  }
}

std::int64_t PixelTiles::countTiles(int x0, int x1, int y0, int y1) const
{
  const std::size_t stride = std::size_t(this->Columns) + 1;
  const std::int32_t* s = this->Sums.data();
  return std::int64_t(s[y1 * stride + x1]) - s[y0 * stride + x1] - s[y1 * stride + x0] + s[y0 * stride + x0];
}

/** What the pixels of whole tiles [x0, x1) x [y0, y1) hold, of which there are some. */
TileContent PixelTiles::fromTiles(int x0, int x1, int y0, int y1) const
{
  const std::int64_t objects = this->countTiles(x0, x1, y0, y1);
  const std::int64_t pixels =
    std::int64_t(std::min(8 * x1, this->Width) - 8 * x0) * (std::min(8 * y1, this->Height) - 8 * y0);
  return { objects > 0, objects < pixels };
}

TileContent PixelTiles::content(int firstColumn, int lastColumn, int firstRow, int lastRow) const
{
  const int columns = lastColumn - firstColumn + 1, rows = lastRow - firstRow + 1;
  if (columns <= 8 && rows <= 8)
  {
    const std::uint64_t asked = windowPart(columns, rows);
    const std::uint64_t objects = this->window(firstColumn, firstRow) & asked;
    return { objects != 0, objects != asked };
  }
  const int x0 = firstColumn / 8, x1 = lastColumn / 8, y0 = firstRow / 8, y1 = lastRow / 8;
  const TileContent around = this->fromTiles(x0, x1 + 1, y0, y1 + 1);
  if (!around.object || !around.background)
  {
    return around;
  }
  // Whole tiles at once, ...
  const int inX0 = (firstColumn + 7) / 8, inX1 = (lastColumn + 1) / 8;
  const int inY0 = (firstRow + 7) / 8, inY1 = (lastRow + 1) / 8;
  const bool anyWhole = inX0 < inX1 && inY0 < inY1;
  TileContent content = anyWhole ? this->fromTiles(inX0, inX1, inY0, inY1) : TileContent();
  // ... and those along the border one by one, until both have been seen.
  for (int y = y0; y <= y1; ++y)
  {
    const bool skip = anyWhole && y >= inY0 && y < inY1;
    for (int x = x0; x <= x1 && !(content.object && content.background); ++x)
    {
      if (skip && x == inX0)
      {
        x = inX1;
        if (x > x1)
        {
          break;
        }
      }
      const std::uint64_t asked = tilePart(x, y, firstColumn, lastColumn, firstRow, lastRow);
      const std::uint64_t objects = this->tile(x, y) & asked;
      content.object |= objects != 0;
      content.background |= objects != asked;
    }
  }
  return content;
}

std::int64_t PixelTiles::count(int c0, int c1, int r0, int r1) const
{
  if (c0 >= c1 || r0 >= r1)
  {
    return 0;
  }
  if (c0 == 0 && r0 == 0 && c1 == this->Width && r1 == this->Height)
  {
    return this->Sums.back();
  }
  std::int64_t total = 0;
  for (int y = r0 / 8; y <= (r1 - 1) / 8; ++y)
  {
    for (int x = c0 / 8; x <= (c1 - 1) / 8; ++x)
    {
      total += countBits(this->tile(x, y) & tilePart(x, y, c0, c1 - 1, r0, r1 - 1));
    }
  }
  return total;
}

std::array<int, 4> PixelTiles::objectBox() const
{
  std::array<int, 4> box = { this->Width, -1, this->Height, -1 };
  const auto widen = [](int& least, int& greatest, int value)
  {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  };
  std::vector<std::uint64_t> down(std::size_t(this->Columns), 0);
  for (int y = 0; y < this->Rows; ++y)
  {
    std::uint64_t across = 0;
    for (int x = 0; x < this->Columns; ++x)
    {
      across |= this->tile(x, y);
      down[x] |= this->tile(x, y);
    }
    if (across != 0)
    {
      widen(box[2], box[3], 8 * y + lowestBit(across) / 8);
      widen(box[2], box[3], 8 * y + highestBit(across) / 8);
    }
  }
  for (int x = 0; x < this->Columns; ++x)
  {
    for (int i = 0; down[x] != 0 && i < 8; ++i)
    {
      if (down[x] >> i & 0x0101010101010101ULL)
      {
        widen(box[0], box[1], 8 * x + i);
      }
    }
  }
  return box;
}

} // namespace silhouette
