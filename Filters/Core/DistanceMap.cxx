// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceMap.h"

#include "Bits.h"
#include "PieceDistances.h"
#include "Vectorised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace silhouette
{
namespace
{

constexpr int BlockSize = 8;

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

/** From each pixel's distance in its column to the other kind, on one side, that of the next row's. */
SILHOUETTE_VECTORISED void stepColumns(
  const std::uint8_t* own, const std::uint8_t* before, std::int16_t limit, std::int16_t* distance, int columns)
{
  for (int c = 0; c < columns; ++c)
  {
    const std::int16_t further = std::int16_t(distance[c] + 1);
    const std::int16_t next = own[c] != before[c] ? std::int16_t(1) : further;
    distance[c] = next < limit ? next : limit;
  }
}

SILHOUETTE_VECTORISED void takeLess(const std::int16_t* distance, std::int16_t* out, int columns)
{
  for (int c = 0; c < columns; ++c)
  {
    out[c] = distance[c] < out[c] ? distance[c] : out[c];
  }
}

/** Where the object and its surroundings are; nothing is kept where there is no object. */
DistanceFrame frameOf(const std::uint8_t* object, int width, int height, double reach, int spacing)
{
  DistanceFrame frame;
  frame.width = width;
  frame.height = height;
  frame.reach = float(std::clamp(reach, 1.0, 30000.0));
  frame.spacing = std::clamp(spacing, 1, int(frame.reach));
  frame.samplesPerPixel = 1.0 / frame.spacing;
  const auto box = objectBox(object, width, height);
  if (box[1] >= box[0])
  {
    const int margin = int(std::ceil(frame.reach)) + 1;
    frame.left = std::max(box[0] - margin, 0);
    frame.top = std::max(box[2] - margin, 0);
    frame.lastColumn = std::min(box[1] + margin, width - 1) - frame.left;
    frame.lastRow = std::min(box[3] + margin, height - 1) - frame.top;
    frame.columns = (frame.lastColumn + frame.spacing - 1) / frame.spacing + 1;
    frame.rows = (frame.lastRow + frame.spacing - 1) / frame.spacing + 1;
  }
  return frame;
}

} // namespace

class DistanceTransform
{
public:
  /** Take an image, which is not copied, in the memory that the last one took. */
  void begin(const std::uint8_t* object, const DistanceFrame& frame)
  {
    this->Object = object;
    this->Map = frame;
    this->Limit = int(std::ceil(frame.reach)) + 1;
    this->Width = frame.lastColumn + 1;
    this->Columns = PieceColumns(frame.spacing, this->Limit - 1, this->pieces());
    this->sweepColumns();
  }

  int pieces() const { return (this->Map.columns + TileSize - 1) / TileSize; }

  /** A piece of a row of samples; those that are not there, too, have a place in `out`. */
  void measure(int row, int piece, float* out)
  {
    this->squarePieces(row, piece, piece);
    this->measurePieceOf(row, piece, out);
  }

  /** One of all pixels, as measure() has it. */
  float pixel(int row, int column) const
  {
    const std::uint8_t* pixels = this->row(row);
    const std::int16_t* inColumn = &this->InColumn[std::size_t(row) * std::size_t(this->Width)];
    const auto square = [&](int c) { return pixels[c] == pixels[column] ? int(inColumn[c]) * inColumn[c] : 0; };
    int best = square(column);
    for (int d = 1; d < this->Limit && d * d < best; ++d)
    {
      best = column >= d ? std::min(best, d * d + square(column - d)) : best;
      best = column + d < this->Width ? std::min(best, d * d + square(column + d)) : best;
    }
    const float distance = std::min(std::sqrt(float(best)) - 0.5f, this->Map.reach);
    return pixels[column] != 0 ? distance : -distance;
  }

  /** All samples. */
  void run(DistanceMap& map)
  {
    map.across = this->pieces();
    map.pieces.reserve(std::size_t(map.across) * std::size_t(map.rows));
    this->Values.clear();
    for (const float far : { -this->Map.reach, this->Map.reach }) // what pieces of either kind are, if they are not mixed
    {
      this->Values.insert(this->Values.end(), std::size_t(PieceStride), far);
    }
    this->Kinds.resize(std::size_t(this->pieces()));
    for (int row = 0; row < this->Map.rows; ++row)
    {
      this->classifyRow(row);
      int first = this->pieces(), last = -1; // mixed ones
      for (int piece = 0; piece < this->pieces(); ++piece)
      {
        this->Kinds[std::size_t(piece)] = this->kindAround(piece);
        const bool isMixed = this->Kinds[std::size_t(piece)] == Mixed;
        first = isMixed ? std::min(first, piece) : first;
        last = isMixed ? piece : last;
      }
      if (first <= last)
      {
        this->squarePieces(row, first, last);
      }
      this->appendRow(row, map.pieces);
    }
    map.values = this->Values; // and no more memory than that
  }

private:
  static constexpr std::uint8_t Mixed = 2;
  static constexpr int PieceStride = DistanceMap::PieceSize + 1;
  static_assert(DistanceMap::PieceSize == TileSize, "they are measured in pieces, too");

  /** The pieces of a row whose mixed ones have squares. */
  void appendRow(int row, std::vector<std::uint32_t>& pieces)
  {
    const std::size_t before = pieces.size();
    for (int piece = 0; piece < this->pieces(); ++piece)
    {
      const std::uint8_t kind = this->Kinds[std::size_t(piece)];
      pieces.push_back(std::uint32_t(kind == Mixed ? this->Values.size() : std::size_t(kind) * PieceStride));
      if (kind == Mixed)
      {
        this->Values.resize(this->Values.size() + PieceStride);
        this->measurePieceOf(row, piece, &this->Values[pieces.back()]);
      }
    }
    for (std::size_t n = before; n + 1 < pieces.size(); ++n)
    {
      if (this->Kinds[n - before] == Mixed)
      {
        this->Values[pieces[n] + TileSize] = this->Values[pieces[n + 1]];
      }
    }
  }

  /** The pixels of a row; below the last one it goes on. */
  const std::uint8_t* row(int r) const
  {
    return this->Object + std::size_t(std::min(r, this->Map.lastRow) + this->Map.top) * this->Map.width + this->Map.left;
  }

  std::int16_t* inColumn(int row) { return &this->InColumn[std::size_t(row) * std::size_t(this->Width)]; }

  /** Distance to the nearest pixel of the other kind in the same column, at most Limit, in the rows of samples. */
  void sweepColumns()
  {
    const int spacing = this->Map.spacing, last = (this->Map.rows - 1) * spacing;
    const auto limit = std::int16_t(this->Limit);
    this->InColumn.resize(std::size_t(this->Width) * std::size_t(this->Map.rows));
    std::vector<std::int16_t> distance(std::size_t(this->Width), limit);
    std::copy(distance.begin(), distance.end(), this->inColumn(0));
    for (int r = 1; r <= last; ++r)
    {
      stepColumns(this->row(r), this->row(r - 1), limit, distance.data(), this->Width);
      if (r % spacing == 0)
      {
        std::copy(distance.begin(), distance.end(), this->inColumn(r / spacing));
      }
    }
    std::fill(distance.begin(), distance.end(), limit);
    for (int r = this->Map.lastRow - 1; r >= 0; --r)
    {
      stepColumns(this->row(r), this->row(r + 1), limit, distance.data(), this->Width);
      if (r % spacing == 0)
      {
        takeLess(distance.data(), this->inColumn(r / spacing), this->Width);
      }
    }
  }

  /** For each TileSize pixels of a row of samples: 0 or 1 where all are, and all within reach in their columns, else Mixed. */
  void classifyRow(int row)
  {
    const std::uint8_t* pixels = this->row(row * this->Map.spacing);
    const std::int16_t* inColumn = this->inColumn(row);
    this->Tiles.resize(std::size_t((this->Width + TileSize - 1) / TileSize));
    for (std::size_t tile = 0; tile < this->Tiles.size(); ++tile)
    {
      const int first = int(tile) * TileSize;
      const bool isWhole = first + TileSize <= this->Width;
      this->Tiles[tile] = isWhole ? this->kindOfTile(pixels + first, inColumn + first) : this->kindOf(pixels + first, inColumn + first, this->Width - first);
    }
  }

  /** The kind of some pixels that all are of, all within reach in their columns, or Mixed. */
  std::uint8_t kindOf(const std::uint8_t* pixels, const std::int16_t* inColumn, int count) const
  {
    const bool alike = std::all_of(pixels, pixels + count, [&](std::uint8_t pixel) { return pixel == *pixels; }) &&
      std::all_of(inColumn, inColumn + count, [this](std::int16_t distance) { return distance == this->Limit; });
    return alike ? *pixels : Mixed;
  }

  /** The same of TileSize, by words. */
  std::uint8_t kindOfTile(const std::uint8_t* pixels, const std::int16_t* inColumn) const
  {
    static_assert(TileSize == 16, "two words of pixels, four of distances");
    constexpr std::uint64_t Ones = 0x0101010101010101ULL, Places = 0x0001000100010001ULL;
    const std::uint64_t first = wordAt(pixels), second = wordAt(pixels + 8);
    std::uint64_t distances[4], nearer = 0;
    std::memcpy(distances, inColumn, sizeof distances);
    for (const std::uint64_t word : distances)
    {
      nearer |= word ^ (Places * std::uint64_t(this->Limit));
    }
    const bool none = (first | second) == 0, all = (first & second) == Ones;
    return nearer == 0 && (none || all) ? std::uint8_t(all) : Mixed;
  }

  /** The kind of everything within reach of a piece of the classified row, or Mixed. */
  std::uint8_t kindAround(int piece) const
  {
    const int span = TileSize * this->Map.spacing, first = piece * span;
    const int from = std::max(first - this->Limit, 0) / TileSize;
    const int to = std::min(first + span - 1 + this->Limit, this->Map.lastColumn) / TileSize;
    for (int tile = from; tile <= to; ++tile)
    {
      if (this->Tiles[tile] != this->Tiles[from])
      {
        return Mixed;
      }
    }
    return this->Tiles[from];
  }

  bool isShort() const { return this->Limit <= LongestShort; }
  /** Where a piece's columns begin; some may be missing before the first. */
  int firstColumn(int piece) const { return piece * TileSize * this->Map.spacing - this->Columns.most(); }

  /** Squares of the columns of some pieces of a row of samples, for both kinds. */
  void squarePieces(int row, int firstPiece, int lastPiece)
  {
    this->FirstPiece = firstPiece;
    this->isShort() ? this->squarePieces(row, lastPiece, this->Short) : this->squarePieces(row, lastPiece, this->Long);
  }

  template <typename Square>
  void squarePieces(int row, int lastPiece, RowSquares<Square> (&squares)[2])
  {
    const int begin = this->firstColumn(this->FirstPiece), length = this->firstColumn(lastPiece) + this->Columns.length() - begin;
    const int from = std::max(begin, 0), to = std::min(begin + length, this->Width);
    const RowPixels pixels{ this->row(row * this->Map.spacing) + from, this->inColumn(row) + from, to - from };
    for (const std::uint8_t kind : { 0, 1 })
    {
      squares[kind].columns.resize(std::size_t(length));
      squares[kind].groups.resize(std::size_t(length));
      squareColumns(pixels, kind, from - begin, Square(this->Limit * this->Limit), this->Columns, squares[kind]);
    }
  }

  /** measure(), of pieces with squares. */
  void measurePieceOf(int row, int piece, float* out)
  {
    const int first = piece * TileSize * this->Map.spacing, offset = this->firstColumn(piece) - this->firstColumn(this->FirstPiece);
    const std::uint8_t* pixels = this->row(row * this->Map.spacing);
    bool any[2] = { false, false };
    std::uint8_t kinds[TileSize];
    for (int c = 0; c < TileSize; ++c)
    {
      kinds[c] = pixels[std::min(first + c * this->Map.spacing, this->Map.lastColumn)];
      any[kinds[c]] = true;
    }
    float distances[TileSize];
    for (const std::uint8_t kind : { 0, 1 })
    {
      if (!any[kind])
      {
        continue;
      }
      this->isShort() ? measurePiece(offset, this->Columns, this->Short[kind], distances)
                      : measurePiece(offset, this->Columns, this->Long[kind], distances);
      for (int c = 0; c < TileSize; ++c)
      {
        const float distance = std::min(distances[c], this->Map.reach);
        out[c] = kinds[c] == kind ? (kind != 0 ? distance : -distance) : out[c];
      }
    }
  }

  const std::uint8_t* Object = nullptr;
  DistanceFrame Map;
  int Limit = 0;
  int Width = 0; ///< pixels of a row
  PieceColumns Columns{ 1, 0, 0 };
  std::vector<std::uint8_t> Tiles;
  std::vector<std::int16_t> InColumn; ///< a row of pixels for each row of samples
  std::vector<std::uint8_t> Kinds;    ///< of a row's pieces
  std::vector<float> Values;          ///< of the map's pieces
  int FirstPiece = 0;                 ///< that there are squares of
  RowSquares<std::int16_t> Short[2];
  RowSquares<std::int32_t> Long[2]; ///< for limits that are too long for the others
};

namespace
{

/** Is a value below the reach? */
std::int32_t isAnyBelow(const float* values, int count, float reach)
{
  std::int32_t below = 0;
  for (int n = 0; n < count; ++n)
  {
    below |= values[n] < reach ? 1 : 0;
  }
  return below;
}

/** How many blocks are not wholly at the reach, summed over both directions. */
void countBlocks(DistanceMap& map)
{
  static_assert(DistanceMap::PieceSize % BlockSize == 0, "a row of a block lies in one piece");
  const int across = (map.columns + BlockSize - 1) / BlockSize, down = (map.rows + BlockSize - 1) / BlockSize;
  const std::size_t stride = std::size_t(across) + 1;
  map.blocksNear.assign(stride * (std::size_t(down) + 1), 0);
  for (int r = 0; r < map.rows; ++r)
  {
    std::int32_t* near = &map.blocksNear[(std::size_t(r / BlockSize) + 1) * stride + 1];
    for (int block = 0; block < across; ++block)
    {
      const int count = std::min(BlockSize, map.columns - block * BlockSize);
      near[block] |= isAnyBelow(map.sample(r, block * BlockSize), count, map.reach);
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
  if (this->empty() || !(u >= 0.0 && v >= 0.0 && lastInU < this->lastColumn && lastInV < this->lastRow))
  {
    return false;
  }
  const int stride = (this->columns + BlockSize - 1) / BlockSize + 1;
  const int step = this->spacing;
  const int a = int(u) / step / BlockSize, b = (int(lastInU) / step + 1) / BlockSize + 1;
  const int c = int(v) / step / BlockSize * stride, d = ((int(lastInV) / step + 1) / BlockSize + 1) * stride;
  return this->blocksNear[d + b] - this->blocksNear[c + b] - this->blocksNear[d + a] + this->blocksNear[c + a] == 0;
}

DistanceMapper::DistanceMapper()
  : Transform(std::make_unique<DistanceTransform>())
{
}

DistanceMapper::~DistanceMapper() = default;
DistanceMapper::DistanceMapper(DistanceMapper&&) noexcept = default;
DistanceMapper& DistanceMapper::operator=(DistanceMapper&&) noexcept = default;

DistanceMap DistanceMapper::map(const std::uint8_t* object, int width, int height, double reach, int spacing)
{
  DistanceMap map;
  static_cast<DistanceFrame&>(map) = frameOf(object, width, height, reach, spacing);
  if (map.columns > 0)
  {
    this->Transform->begin(object, map);
    this->Transform->run(map);
    countBlocks(map);
  }
  return map;
}

DistancesOnDemand::DistancesOnDemand(const std::uint8_t* object, int width, int height, double reach)
  : Frame(frameOf(object, width, height, reach, 1))
{
  if (this->Frame.columns > 0)
  {
    this->Transform = std::make_unique<DistanceTransform>();
    this->Transform->begin(object, this->Frame);
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

DistanceProbe::DistanceProbe(const std::uint8_t* object, int width, int height, double reach)
  : Frame(frameOf(object, width, height, reach, 1))
{
  if (this->Frame.columns > 0)
  {
    auto transform = std::make_unique<DistanceTransform>();
    transform->begin(object, this->Frame);
    this->Transform = std::move(transform);
  }
}

DistanceProbe::~DistanceProbe() = default;

float DistanceProbe::at(double u, double v) const
{
  return this->Transform
    ? this->Frame.interpolate(u, v, [this](int row, int column) { return this->Transform->pixel(row, column); })
    : -this->Frame.reach;
}

} // namespace silhouette
