// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceMap.h"

#include "Bits.h"
#include "Vectorised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace silhouette
{
namespace
{

constexpr int TileSize = 16;
static_assert(TileSize == 16, "classifyTiles() reads a tile's row as two words");
constexpr int BlockSize = 8;
constexpr int LongestShort = 127; ///< px: two squares of distances up to here add up within sixteen bits

/** Least and greatest column and row of the object; the greatest are below the least where there is none. */
std::array<int, 4> objectBox(const std::uint8_t* object, int width, int height)
{
  std::array<int, 4> box{ width, -1, height, -1 };
  for (int row = 0; row < height; ++row)
  {
    const std::uint8_t* first = object + std::size_t(row) * width;
    const std::uint8_t* last = first + width;
    const void* found = std::memchr(first, 1, std::size_t(width));
    if (!found)
    {
      continue;
    }
    const auto* from = static_cast<const std::uint8_t*>(found);
    const std::uint8_t* sure = first + std::max(box[1], int(from - first)); // no column before it can be the greatest
    while (last - sure > 8 && wordAt(last - 8) == 0)
    {
      last -= 8;
    }
    while (last > sure + 1 && last[-1] == 0)
    {
      --last;
    }
    box = { std::min(box[0], int(from - first)), std::max(box[1], int(last - first) - 1), std::min(box[2], row), row };
  }
  return box;
}

/**
 * For a row's TileSize pixels, from the squares of the distances within the columns (0 at pixels of the other kind): the least
 * d * d + column[d]^2 over |d| <= `most`. Stops where no larger d can matter.
 */
template <typename Square>
inline void leastSquares(const Square* squares, int most, Square* best)
{
  std::copy(squares, squares + TileSize, best);
  for (int d = 1; d <= most; ++d)
  {
    const Square square = Square(d * d);
    Square greatest = 0;
    for (int c = 0; c < TileSize; ++c)
    {
      const Square nearer = std::min(squares[c - d], squares[c + d]);
      best[c] = std::min(best[c], Square(nearer + square));
      greatest = std::max(greatest, best[c]);
    }
    if (long(d + 1) * (d + 1) >= long(greatest))
    {
      return;
    }
  }
}

/** Some pixels of a row, with those around them that count. */
struct RowPiece
{
  const std::uint8_t* pixels;   ///< the first one that there is
  const std::int16_t* inColumn; ///< its distance within the column
  int before;                   ///< so many are missing before it
  int count;                    ///< so many there are
  int most;                     ///< so many count before and after the piece
};

/** Distances of a piece's TileSize pixels if they are of one kind; `squares` is where there are no pixels their limit. */
template <typename Square>
inline void measureKind(const RowPiece& row, std::uint8_t kind, Square* squares, float* distances)
{
  Square* const own = squares + row.before;
  for (int c = 0; c < row.count; ++c)
  {
    const Square square = Square(row.inColumn[c] * row.inColumn[c]);
    own[c] = row.pixels[c] == kind ? square : Square(0);
  }
  Square best[TileSize];
  leastSquares(squares + row.most, row.most, best);
  for (int c = 0; c < TileSize; ++c)
  {
    distances[c] = std::sqrt(float(best[c])) - 0.5f;
  }
}

SILHOUETTE_VECTORISED void measureShort(const RowPiece& row, std::uint8_t kind, std::int16_t* squares, float* distances)
{
  measureKind(row, kind, squares, distances);
}

SILHOUETTE_VECTORISED void measureLong(const RowPiece& row, std::uint8_t kind, std::int32_t* squares, float* distances)
{
  measureKind(row, kind, squares, distances);
}

/** Each pixel's distance in its column to the other kind, at most one more a row. */
SILHOUETTE_VECTORISED void stepColumns(
  const std::uint8_t* own, const std::uint8_t* other, const std::int16_t* last, std::int16_t* out, int columns)
{
  for (int c = 0; c < columns; ++c)
  {
    const std::int16_t next = std::int16_t(own[c] != other[c] ? 1 : last[c] + 1);
    out[c] = next < out[c] ? next : out[c];
  }
}

/** Where the object and its surroundings are; nothing is kept where there is no object. */
DistanceFrame frameOf(const std::uint8_t* object, int width, int height, double reach)
{
  DistanceFrame frame;
  frame.width = width;
  frame.height = height;
  frame.reach = float(std::clamp(reach, 1.0, 30000.0));
  const auto box = objectBox(object, width, height);
  if (box[1] >= box[0])
  {
    const int margin = int(std::ceil(frame.reach)) + 1;
    frame.left = std::max(box[0] - margin, 0);
    frame.top = std::max(box[2] - margin, 0);
    frame.columns = std::min(box[1] + margin, width - 1) - frame.left + 1;
    frame.rows = std::min(box[3] + margin, height - 1) - frame.top + 1;
  }
  return frame;
}

} // namespace

class DistanceTransform
{
public:
  DistanceTransform(const std::uint8_t* object, const DistanceFrame& frame)
    : Object(object)
    , Map(frame)
    , Limit(int(std::ceil(frame.reach)) + 1)
    , TileColumns((frame.columns + TileSize - 1) / TileSize)
    , TileRows((frame.rows + TileSize - 1) / TileSize)
  {
    this->sweepColumns();
  }

  int pieces() const { return this->TileColumns; }

  /** TileSize pixels of a row, or as many as there are. */
  void measure(int row, int piece, float* out)
  {
    const int first = piece * TileSize, last = std::min(first + TileSize, this->Map.columns);
    if (first + TileSize <= this->Map.columns)
    {
      this->fillRow(row, first, out);
      return;
    }
    for (int c = first; c < last; ++c)
    {
      out[c - first] = this->distanceAt(c, row);
    }
  }

  /** All pixels. */
  void run(std::vector<float>& value)
  {
    value.resize(std::size_t(this->Map.columns) * this->Map.rows);
    this->classifyTiles();
    for (int tile = 0; tile < this->TileColumns * this->TileRows; ++tile)
    {
      this->fill(tile % this->TileColumns, tile / this->TileColumns, value);
    }
  }

private:
  const std::uint8_t* row(int r) const
  {
    return this->Object + std::size_t(r + this->Map.top) * this->Map.width + this->Map.left;
  }

  /** 0 or 1 where all of a tile is, else 2. */
  void classifyTiles()
  {
    this->Tiles.assign(std::size_t(this->TileColumns) * this->TileRows, 3);
    for (int r = 0; r < this->Map.rows; ++r)
    {
      const std::uint8_t* pixels = this->row(r);
      std::uint8_t* tiles = &this->Tiles[std::size_t(r / TileSize) * this->TileColumns];
      int c = 0;
      for (; c + TileSize <= this->Map.columns; c += TileSize)
      {
        constexpr std::uint64_t ones = 0x0101010101010101ULL;
        const std::uint64_t a = wordAt(pixels + c), b = wordAt(pixels + c + 8);
        const std::uint8_t own = a != b ? 2 : a == 0 ? 0 : a == ones ? 1 : 2;
        std::uint8_t& tile = tiles[c / TileSize];
        tile = tile == 3 ? own : (tile == own ? tile : std::uint8_t(2));
      }
      for (; c < this->Map.columns; ++c)
      {
        std::uint8_t& tile = tiles[c / TileSize];
        tile = tile == 3 ? pixels[c] : (tile == pixels[c] ? tile : std::uint8_t(2));
      }
    }
  }

  /** Distance to the nearest pixel of the other kind in the same column, at most Limit. */
  void sweepColumns()
  {
    const int columns = this->Map.columns;
    this->InColumn.assign(std::size_t(columns) * this->Map.rows, std::int16_t(this->Limit));
    for (int pass = 0; pass < 2; ++pass)
    {
      for (int n = 1; n < this->Map.rows; ++n)
      {
        const int r = pass == 0 ? n : this->Map.rows - 1 - n;
        const int before = pass == 0 ? r - 1 : r + 1;
        const std::uint8_t *own = this->row(r), *other = this->row(before);
        stepColumns(own, other, &this->InColumn[std::size_t(before) * columns], &this->InColumn[std::size_t(r) * columns], columns);
      }
    }
  }

  /** Is everything within reach of a tile of one kind? */
  bool alone(int column, int row) const
  {
    const int ring = (this->Limit + TileSize - 1) / TileSize;
    const std::uint8_t kind = this->Tiles[std::size_t(row) * this->TileColumns + column];
    for (int r = std::max(row - ring, 0); r <= std::min(row + ring, this->TileRows - 1); ++r)
    {
      for (int c = std::max(column - ring, 0); c <= std::min(column + ring, this->TileColumns - 1); ++c)
      {
        if (this->Tiles[std::size_t(r) * this->TileColumns + c] != kind || kind == 2)
        {
          return false;
        }
      }
    }
    return true;
  }

  float distanceAt(int column, int row) const
  {
    const std::uint8_t* pixels = this->row(row);
    const std::int16_t* vertical = &this->InColumn[std::size_t(row) * this->Map.columns];
    const int kind = pixels[column];
    long best = long(vertical[column]) * vertical[column];
    for (int d = 1; d < this->Limit && long(d) * d < best; ++d)
    {
      for (const int other : { column - d, column + d })
      {
        if (other >= 0 && other < this->Map.columns)
        {
          const long v = pixels[other] != kind ? 0 : vertical[other];
          best = std::min(best, long(d) * d + v * v);
        }
      }
    }
    const float distance = std::min(std::sqrt(float(best)) - 0.5f, this->Map.reach);
    return kind != 0 ? distance : -distance;
  }

  /** distanceAt() for TileSize pixels of a row, once for each kind that is among them. */
  void fillRow(int row, int firstColumn, float* out)
  {
    const int most = this->Limit - 1, length = TileSize + 2 * most;
    const int from = std::max(firstColumn - most, 0), to = std::min(firstColumn + TileSize + most, this->Map.columns);
    const std::uint8_t* pixels = this->row(row);
    const std::int16_t* inColumn = &this->InColumn[std::size_t(row) * this->Map.columns];
    const RowPiece piece{ pixels + from, inColumn + from, from - (firstColumn - most), to - from, most };
    const bool isShort = this->Limit <= LongestShort;
    isShort ? this->Short.resize(std::size_t(length)) : this->Long.resize(std::size_t(length));
    if (piece.count < length)
    {
      std::fill(this->Short.begin(), this->Short.end(), std::int16_t(this->Limit * this->Limit));
      std::fill(this->Long.begin(), this->Long.end(), this->Limit * this->Limit);
    }
    float distances[TileSize];
    for (const std::uint8_t kind : { 0, 1 })
    {
      if (std::memchr(pixels + firstColumn, kind, TileSize) == nullptr)
      {
        continue;
      }
      isShort ? measureShort(piece, kind, this->Short.data(), distances)
              : measureLong(piece, kind, this->Long.data(), distances);
      for (int c = 0; c < TileSize; ++c)
      {
        const float distance = std::min(distances[c], this->Map.reach);
        out[c] = pixels[firstColumn + c] == kind ? (kind != 0 ? distance : -distance) : out[c];
      }
    }
  }

  void fill(int tileColumn, int tileRow, std::vector<float>& value)
  {
    const int lastRow = std::min((tileRow + 1) * TileSize, this->Map.rows);
    const int firstColumn = tileColumn * TileSize;
    const int lastColumn = std::min(firstColumn + TileSize, this->Map.columns);
    const bool far = this->alone(tileColumn, tileRow);
    const float most = this->row(tileRow * TileSize)[firstColumn] != 0 ? this->Map.reach : -this->Map.reach;
    for (int r = tileRow * TileSize; r < lastRow; ++r)
    {
      float* out = &value[std::size_t(r) * this->Map.columns];
      if (far)
      {
        std::fill(out + firstColumn, out + lastColumn, most);
      }
      else
      {
        this->measure(r, tileColumn, out + firstColumn);
      }
    }
  }

  const std::uint8_t* Object;
  const DistanceFrame& Map;
  int Limit;
  int TileColumns;
  int TileRows;
  std::vector<std::uint8_t> Tiles;
  std::vector<std::int16_t> InColumn;
  std::vector<std::int16_t> Short; ///< squares, as many as a piece needs
  std::vector<std::int32_t> Long;  ///< the same for limits that are too long for the others
};

namespace
{

/** Mark those of a row's whole blocks that have a value below the reach. */
SILHOUETTE_VECTORISED void markNear(const float* values, int blocks, float reach, std::int32_t* near)
{
  for (int block = 0; block < blocks; ++block)
  {
    std::int32_t below = 0;
    for (int c = 0; c < BlockSize; ++c)
    {
      below |= values[block * BlockSize + c] < reach ? 1 : 0;
    }
    near[block] |= below;
  }
}

/** How many blocks are not wholly at the reach, summed over both directions. */
void countBlocks(DistanceMap& map)
{
  const int across = (map.columns + BlockSize - 1) / BlockSize, down = (map.rows + BlockSize - 1) / BlockSize;
  const std::size_t stride = std::size_t(across) + 1;
  map.blocksNear.assign(stride * (std::size_t(down) + 1), 0);
  for (int r = 0; r < map.rows; ++r)
  {
    const float* values = &map.value[std::size_t(r) * map.columns];
    std::int32_t* near = &map.blocksNear[(std::size_t(r / BlockSize) + 1) * stride + 1];
    markNear(values, map.columns / BlockSize, map.reach, near);
    if (map.columns % BlockSize != 0)
    {
      near[across - 1] |=
        *std::min_element(values + map.columns / BlockSize * BlockSize, values + map.columns) < map.reach;
    }
  }
  for (std::size_t n = stride + 1; n < map.blocksNear.size(); ++n)
  {
    if (n % stride != 0)
    {
      map.blocksNear[n] += map.blocksNear[n - 1] + map.blocksNear[n - stride] - map.blocksNear[n - stride - 1];
    }
  }
}

} // namespace

bool DistanceMap::farInside(double firstU, double lastU, double firstV, double lastV) const
{
  const double u = firstU - this->left, lastInU = lastU - this->left, v = firstV - this->top, lastInV = lastV - this->top;
  if (this->value.empty() || !(u >= 0.0 && v >= 0.0 && lastInU < this->columns - 1 && lastInV < this->rows - 1))
  {
    return false;
  }
  const int stride = (this->columns + BlockSize - 1) / BlockSize + 1;
  const int a = int(u) / BlockSize, b = (int(lastInU) + 1) / BlockSize + 1;
  const int c = int(v) / BlockSize * stride, d = ((int(lastInV) + 1) / BlockSize + 1) * stride;
  return this->blocksNear[d + b] - this->blocksNear[c + b] - this->blocksNear[d + a] + this->blocksNear[c + a] == 0;
}

DistanceMap distanceMap(const std::uint8_t* object, int width, int height, double reach)
{
  DistanceMap map;
  static_cast<DistanceFrame&>(map) = frameOf(object, width, height, reach);
  if (map.columns > 0)
  {
    DistanceTransform(object, map).run(map.value);
    countBlocks(map);
  }
  return map;
}

DistancesOnDemand::DistancesOnDemand(const std::uint8_t* object, int width, int height, double reach)
  : Frame(frameOf(object, width, height, reach))
{
  if (this->Frame.columns > 0)
  {
    this->Transform = std::make_unique<DistanceTransform>(object, this->Frame);
    this->Known.assign(std::size_t(this->Frame.rows) * this->Transform->pieces(), -1);
  }
}

DistancesOnDemand::~DistancesOnDemand() = default;

float DistancesOnDemand::at(double u, double v)
{
  return this->Transform
    ? this->Frame.interpolate(u, v, [this](int row, int column) { return this->pixel(row, column); })
    : -this->Frame.reach;
}

float DistancesOnDemand::pixel(int row, int column)
{
  const int piece = column / TileSize;
  std::int32_t& known = this->Known[std::size_t(row) * this->Transform->pieces() + piece];
  if (known < 0)
  {
    known = std::int32_t(this->Values.size() / TileSize);
    this->Values.resize(this->Values.size() + TileSize);
    this->Transform->measure(row, piece, &this->Values[std::size_t(known) * TileSize]);
  }
  return this->Values[std::size_t(known) * TileSize + column % TileSize];
}

} // namespace silhouette
