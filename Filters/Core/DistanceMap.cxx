// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceMap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace silhouette
{
namespace
{

constexpr int TileSize = 16;

/** Least and greatest column and row of the object; the greatest are below the least where there is none. */
std::array<int, 4> objectBox(const std::uint8_t* object, int width, int height)
{
  std::array<int, 4> box{ width, -1, height, -1 };
  for (int row = 0; row < height; ++row)
  {
    const std::uint8_t* first = object + std::size_t(row) * width;
    const std::uint8_t* last = first + width;
    const std::uint8_t* from = std::find(first, last, std::uint8_t(1));
    if (from == last)
    {
      continue;
    }
    while (last[-1] == 0)
    {
      --last;
    }
    box = { std::min(box[0], int(from - first)), std::max(box[1], int(last - first) - 1), std::min(box[2], row), row };
  }
  return box;
}

class Transform
{
public:
  Transform(const std::uint8_t* object, DistanceMap& map)
    : Object(object)
    , Map(map)
    , Limit(int(std::ceil(map.reach)) + 1)
    , TileColumns((map.columns + TileSize - 1) / TileSize)
    , TileRows((map.rows + TileSize - 1) / TileSize)
  {
  }

  void run()
  {
    this->classifyTiles();
    this->sweepColumns();
    for (int tile = 0; tile < this->TileColumns * this->TileRows; ++tile)
    {
      this->fill(tile % this->TileColumns, tile / this->TileColumns);
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
      for (int c = 0; c < this->Map.columns; ++c)
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
    this->InColumn.assign(std::size_t(columns) * this->Map.rows, std::uint16_t(this->Limit));
    for (int pass = 0; pass < 2; ++pass)
    {
      for (int n = 1; n < this->Map.rows; ++n)
      {
        const int r = pass == 0 ? n : this->Map.rows - 1 - n;
        const int before = pass == 0 ? r - 1 : r + 1;
        const std::uint8_t *own = this->row(r), *other = this->row(before);
        std::uint16_t* out = &this->InColumn[std::size_t(r) * columns];
        const std::uint16_t* last = &this->InColumn[std::size_t(before) * columns];
        for (int c = 0; c < columns; ++c)
        {
          const int distance = own[c] != other[c] ? 1 : last[c] + 1;
          out[c] = std::uint16_t(std::min<int>(out[c], distance));
        }
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
    const std::uint16_t* vertical = &this->InColumn[std::size_t(row) * this->Map.columns];
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

  void fill(int tileColumn, int tileRow)
  {
    const int lastRow = std::min((tileRow + 1) * TileSize, this->Map.rows);
    const int firstColumn = tileColumn * TileSize;
    const int lastColumn = std::min(firstColumn + TileSize, this->Map.columns);
    const bool far = this->alone(tileColumn, tileRow);
    const float value = this->row(tileRow * TileSize)[firstColumn] != 0 ? this->Map.reach : -this->Map.reach;
    for (int r = tileRow * TileSize; r < lastRow; ++r)
    {
      float* out = &this->Map.value[std::size_t(r) * this->Map.columns];
      for (int c = firstColumn; c < lastColumn; ++c)
      {
        out[c] = far ? value : this->distanceAt(c, r);
      }
    }
  }

  const std::uint8_t* Object;
  DistanceMap& Map;
  int Limit;
  int TileColumns;
  int TileRows;
  std::vector<std::uint8_t> Tiles;
  std::vector<std::uint16_t> InColumn;
};

} // namespace

float DistanceMap::at(double u, double v) const
{
  if (this->value.empty())
  {
    return -this->reach;
  }
  // Beyond the part that is kept there is only background.
  const double x = std::clamp(u - this->left, 0.0, double(this->columns - 1));
  const double y = std::clamp(v - this->top, 0.0, double(this->rows - 1));
  const int c = std::min(int(x), std::max(this->columns - 2, 0));
  const int r = std::min(int(y), std::max(this->rows - 2, 0));
  const int right = this->columns > 1 ? 1 : 0;
  const std::size_t below = this->rows > 1 ? std::size_t(this->columns) : 0;
  const float s = float(x - c), t = float(y - r);
  const float* p = &this->value[std::size_t(r) * this->columns + c];
  const float inner =
    (p[0] * (1 - s) + p[right] * s) * (1 - t) + (p[below] * (1 - s) + p[below + right] * s) * t;
  const double dx = u - this->left - x, dy = v - this->top - y;
  return dx == 0.0 && dy == 0.0 ? inner : std::max(-this->reach, inner - float(std::sqrt(dx * dx + dy * dy)));
}

DistanceMap distanceMap(const std::uint8_t* object, int width, int height, double reach)
{
  DistanceMap map;
  map.width = width;
  map.height = height;
  map.reach = float(std::clamp(reach, 1.0, 30000.0));
  const auto box = objectBox(object, width, height);
  if (box[1] < box[0])
  {
    return map;
  }
  const int margin = int(std::ceil(map.reach)) + 1;
  map.left = std::max(box[0] - margin, 0);
  map.top = std::max(box[2] - margin, 0);
  map.columns = std::min(box[1] + margin, width - 1) - map.left + 1;
  map.rows = std::min(box[3] + margin, height - 1) - map.top + 1;
  map.value.resize(std::size_t(map.columns) * map.rows);
  Transform(object, map).run();
  return map;
}

} // namespace silhouette
