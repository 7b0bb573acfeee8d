// SPDX-License-Identifier: BSD-3-Clause
#include "OctantCover.h"

#include "MarchingCubesTable.h"
#include "Vectorised.h"

#include <cmath>
#include <limits>

namespace silhouette
{
namespace
{

constexpr int Block = OctantBlock::Most;

/** The pixels of a window that the octants of a block may project to, from a first column and row to before a last one; of what is not seen these are equal. */
struct BlockPixels
{
  std::int32_t column[Block], endColumn[Block], row[Block], endRow[Block];
};

struct WindowFrame
{
  double left, top, width, height;

  explicit WindowFrame(const ImageWindow& window)
    : left(window.left - 0.5) // pixels reach half a pixel to either side, so that a place is truncated to its pixel
    , top(window.top - 0.5)
    , width(window.width())
    , height(window.height())
  {
  }
};

/** The pixels of a window that a box touches, the n-th of some. */
inline void setPixels(const WindowFrame& frame, bool isInFront, double leastX, double greatestX, double leastY, double greatestY, BlockPixels& pixels, int n)
{
  const double left = leastX - frame.left, right = greatestX - frame.left, top = leastY - frame.top, bottom = greatestY - frame.top;
  const bool isSeen = isInFront && right >= 0.0 && bottom >= 0.0 && left < frame.width && top < frame.height;
  const double first = isSeen && left > 0.0 ? left : 0.0, last = right < frame.width - 1.0 ? right : frame.width - 1.0;
  const double upper = isSeen && top > 0.0 ? top : 0.0, lower = bottom < frame.height - 1.0 ? bottom : frame.height - 1.0;
  pixels.column[n] = std::int32_t(first);
  pixels.endColumn[n] = isSeen ? std::int32_t(last) + 1 : 0;
  pixels.row[n] = std::int32_t(upper);
  pixels.endRow[n] = isSeen ? std::int32_t(lower) + 1 : 0;
}

/**
 * The boxes around the projections of last-generation octants, widened by `reach` pixels. About its middle the projection is as good as linear over an octant, which saves seven
 * divisions of eight.
 */
SILHOUETTE_VECTORISED void boxLeaves(const LatticeProjection& projection, const OctantBlock& leaves, double reach, const WindowFrame& frame, BlockPixels& pixels)
{
  const auto &a = projection.step[0], &b = projection.step[1], &c = projection.step[2];
  for (int n = 0; n < leaves.count; ++n)
  {
    const double i = leaves.i[n] + 0.5, j = leaves.j[n] + 0.5, k = leaves.k[n] + 0.5;
    const double W = projection.constant[2] + ((a[2] * i + b[2] * j) + c[2] * k);
    const double inverse = 1.0 / W;
    const double x = (projection.constant[0] + ((a[0] * i + b[0] * j) + c[0] * k)) * inverse;
    const double y = (projection.constant[1] + ((a[1] * i + b[1] * j) + c[1] * k)) * inverse;
    const double across = std::abs(a[0] - x * a[2]) + std::abs(b[0] - x * b[2]) + std::abs(c[0] - x * c[2]);
    const double down = std::abs(a[1] - y * a[2]) + std::abs(b[1] - y * b[2]) + std::abs(c[1] - y * c[2]);
    const double halfWidth = 0.5 * across * inverse + reach, halfHeight = 0.5 * down * inverse + reach;
    setPixels(frame, W > projection.minimumDepth, x - halfWidth, x + halfWidth, y - halfHeight, y + halfHeight, pixels, n);
  }
}

/** The boxes around the projections of octants of a size. */
SILHOUETTE_VECTORISED void boxOctants(const LatticeProjection& projection, const OctantBlock& octants, double size, const WindowFrame& frame, BlockPixels& pixels)
{
  const auto &a = projection.step[0], &b = projection.step[1], &c = projection.step[2];
  for (int n = 0; n < octants.count; ++n)
  {
    double leastX = 1e300, greatestX = -1e300, leastY = 1e300, greatestY = -1e300, leastW = 1e300;
    for (int corner = 0; corner < 8; ++corner)
    {
      const double i = octants.i[n] + (corner & 1) * size, j = octants.j[n] + (corner >> 1 & 1) * size, k = octants.k[n] + (corner >> 2) * size;
      const double W = projection.constant[2] + ((a[2] * i + b[2] * j) + c[2] * k);
      const double inverse = 1.0 / W;
      const double x = (projection.constant[0] + ((a[0] * i + b[0] * j) + c[0] * k)) * inverse;
      const double y = (projection.constant[1] + ((a[1] * i + b[1] * j) + c[1] * k)) * inverse;
      leastX = x < leastX ? x : leastX;
      greatestX = x > greatestX ? x : greatestX;
      leastY = y < leastY ? y : leastY;
      greatestY = y > greatestY ? y : greatestY;
      leastW = W < leastW ? W : leastW;
    }
    setPixels(frame, leastW > projection.minimumDepth, leastX, greatestX, leastY, greatestY, pixels, n);
  }
}

/** Tiles of a window of which spans of rows, which come one after another, leave nothing out. */
class TileBand
{
public:
  explicit TileBand(CoverCount& count)
    : Count(count)
  {
  }

  /** The columns of a row of the image, closed. */
  void add(int row, double least, double greatest)
  {
    const int here = row - this->Count.window().top;
    if (here % CoverCount::TileSize == 0)
    {
      this->Rows = 0;
      this->Least = -std::numeric_limits<double>::infinity();
      this->Greatest = -this->Least;
    }
    ++this->Rows;
    this->Least = std::max(this->Least, least);
    this->Greatest = std::min(this->Greatest, greatest);
    if (this->Rows == CoverCount::TileSize)
    {
      this->mark(std::size_t(here / CoverCount::TileSize));
    }
  }

private:
  void mark(std::size_t tileRow)
  {
    const ImageWindow& window = this->Count.window();
    const double first = std::max(std::ceil((this->Least - window.left) / CoverCount::TileSize), 0.0);
    const double end = std::floor((std::min(this->Greatest, window.right - 1.0) - window.left + 1.0) / CoverCount::TileSize);
    for (double tile = first; tile < end; ++tile)
    {
      this->Count.markWhole(std::size_t(tile), tileRow);
    }
  }

  CoverCount& Count;
  int Rows = -CoverCount::TileSize; ///< of the tiles that have been added; fewer than none before the first tiles' first row
  double Least = 0.0, Greatest = 0.0; ///< columns that are in all of them
};

/**
 * The polygon, row by row at the rows' middles: what it leaves out at its border the octants around it cover.
 */
void addPolygon(const Vector2 (&p)[8], CoverCount& count)
{
  const auto y = std::minmax_element(p, p + 8, [](const Vector2& a, const Vector2& b) { return a[1] < b[1]; });
  const int from = int(std::clamp(std::ceil(y.first->y()), double(count.window().top), double(count.window().bottom)));
  const int to = int(std::clamp(std::floor(y.second->y()), count.window().top - 1.0, count.window().bottom - 1.0));
  TileBand band(count);
  for (int row = from; row <= to; ++row)
  {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const auto& edge : edgeCorners)
    {
      const Vector2 a = p[edge[0]], b = p[edge[1]];
      if ((a[1] <= row) != (b[1] <= row))
      {
        const double x = a[0] + (row - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        least = std::min(least, x);
        greatest = std::max(greatest, x);
      }
    }
    if (least <= greatest)
    {
      count.add(least, greatest, row, row);
    }
    band.add(row, least, greatest);
  }
}

} // namespace

bool projectOctant(
  const LatticeProjection& projection, const LatticePoint& lowest, std::int32_t size, Vector2 (&out)[8])
{
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint d = cornerOffset(c);
    const auto h = projection({ lowest.i + d.i * size, lowest.j + d.j * size, lowest.k + d.k * size });
    if (!(h.W > projection.minimumDepth))
    {
      return false;
    }
    out[c] = { h.U / h.W, h.V / h.W };
  }
  return true;
}

bool isOctantHeld(const LatticeProjection& projection, const LatticePoint& lowest, std::int32_t size, double reach, const CoverCount& count)
{
  constexpr double Guard = 1.0; // pixels: what is in the octant is boxed as if the projection were linear there
  Vector2 p[8];
  if (!projectOctant(projection, lowest, size, p))
  {
    return false;
  }
  Vector2 least = p[0], greatest = p[0];
  for (const Vector2& corner : p)
  {
    least = least.cwiseMin(corner);
    greatest = greatest.cwiseMax(corner);
  }
  const double wider = reach + Guard;
  return count.isBoxHeld(least[0] - wider, greatest[0] + wider, least[1] - wider, greatest[1] + wider);
}

void addLeaves(const LatticeProjection& projection, double reach, OctantBlock& leaves, CoverCount& count)
{
  BlockPixels pixels;
  boxLeaves(projection, leaves, reach, WindowFrame(count.window()), pixels);
  for (int n = 0; n < leaves.count; ++n)
  {
    count.addPixels(std::size_t(pixels.column[n]), std::size_t(pixels.endColumn[n]), std::size_t(pixels.row[n]), std::size_t(pixels.endRow[n]));
  }
  leaves.count = 0;
}

void addOctants(const LatticeProjection& projection, std::int32_t size, OctantBlock& octants, CoverCount& count)
{
  BlockPixels pixels;
  boxOctants(projection, octants, size, WindowFrame(count.window()), pixels);
  for (int n = 0; n < octants.count; ++n)
  {
    const LatticePoint lowest{ std::int32_t(octants.i[n]), std::int32_t(octants.j[n]), std::int32_t(octants.k[n]) };
    Vector2 p[8];
    if (!count.isHeld(std::size_t(pixels.column[n]), std::size_t(pixels.endColumn[n]), std::size_t(pixels.row[n]), std::size_t(pixels.endRow[n])) &&
      projectOctant(projection, lowest, size, p))
    {
      addPolygon(p, count);
    }
  }
  octants.count = 0;
}

} // namespace silhouette
