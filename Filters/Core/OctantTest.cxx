// SPDX-License-Identifier: BSD-3-Clause
#include "OctantTest.h"

#include "Bits.h"
#include "MarchingCubesTable.h"
#include "Vectorised.h"

#include <cstring>
#include <limits>

namespace silhouette
{
namespace
{

constexpr double Infinite = std::numeric_limits<double>::infinity();

/**
 * The 27 lattice points of an octant and its children, in rows along i of three points and a spare one: the place of
 * corner c of the octant whose lowest point is at 0.
 */
constexpr int gridPlace(int c)
{
  return (c & 1) + 4 * (c >> 1 & 1) + 12 * (c >> 2 & 1);
}

/** Where the corners of an octant in front of the camera come to lie, and the pixels of their bounding box. */
struct ProjectedOctant
{
  const double* x; ///< of corner c at gridPlace(c)
  const double* y;
  int firstColumn, lastColumn, firstRow, lastRow;
};

ViewRelation relation(const PixelContent& content)
{
  if (content.background)
  {
    return content.object || content.abstain ? ViewRelation::Mixed : ViewRelation::Background;
  }
  if (content.abstain)
  {
    return content.object ? ViewRelation::Partial : ViewRelation::Abstain;
  }
  return ViewRelation::Inside;
}

void merge(PixelContent& into, const PixelContent& other)
{
  into.object |= other.object;
  into.background |= other.background;
  into.abstain |= other.abstain;
}

/** The twelve edges of a projected octant, each from its upper end to its lower one. */
struct Outline
{
  double x[12], y[12];             ///< the upper end
  double endY[12];                 ///< the lower end
  double width[12];                ///< from the upper end to the lower one
  double perRow[12];               ///< share of the edge to a row; 0 where it is level
  double level[12];                ///< 1 where the edge is level
};

SILHOUETTE_VECTORISED void makeOutline(const ProjectedOctant& p, Outline& out)
{
  double ax[12], ay[12], bx[12], by[12];
  for (int e = 0; e < 12; ++e)
  {
    ax[e] = p.x[gridPlace(edgeCorners[e][0])];
    ay[e] = p.y[gridPlace(edgeCorners[e][0])];
    bx[e] = p.x[gridPlace(edgeCorners[e][1])];
    by[e] = p.y[gridPlace(edgeCorners[e][1])];
  }
  for (int e = 0; e < 12; ++e)
  {
    const bool swap = ay[e] > by[e];
    const double upperX = swap ? bx[e] : ax[e], lowerX = swap ? ax[e] : bx[e];
    const double upperY = swap ? by[e] : ay[e], lowerY = swap ? ay[e] : by[e];
    const double dy = lowerY - upperY;
    out.x[e] = upperX;
    out.y[e] = upperY;
    out.endY[e] = lowerY;
    out.width[e] = lowerX - upperX;
    out.level[e] = dy > 0.0 ? 0.0 : 1.0;
    out.perRow[e] = dy > 0.0 ? 1.0 / dy : 0.0;
  }
}

/**
 * Extent in x of the part of the polygon that lies in a row's band of half-open pixels, widened by the guard above
 * and below; least > greatest where there is none. Row -1 is all that is above an image of `height` rows, row
 * `height` all that is below.
 */
SILHOUETTE_VECTORISED void spanOfRow(const Outline& edges, int row, int height, double& least, double& greatest)
{
  const double top = row < 0 ? -Infinite : row - 0.5 - OctantGuard;
  const double bottom = row >= height ? Infinite : row + 0.5 + OctantGuard;
  const double above = row < 0 ? -Infinite : double(row), below = row >= height ? Infinite : row + 1.0;
  double low[12], high[12];
  for (int e = 0; e < 12; ++e)
  {
    const double from = top > edges.y[e] ? top : edges.y[e];
    const double to = bottom < edges.endY[e] ? bottom : edges.endY[e];
    double s = (from - edges.y[e]) * edges.perRow[e];
    double t = (to - edges.y[e]) * edges.perRow[e] + edges.level[e];
    s = s < 0.0 ? 0.0 : s;
    s = s > 1.0 ? 1.0 : s;
    t = t < 0.0 ? 0.0 : t;
    t = t > 1.0 ? 1.0 : t;
    const double x0 = edges.x[e] + s * edges.width[e];
    const double x1 = edges.x[e] + t * edges.width[e];
    const bool meets = (edges.y[e] - OctantGuard + 0.5 < below) & (edges.endY[e] + OctantGuard + 0.5 >= above);
    const double smaller = x0 < x1 ? x0 : x1, larger = x0 < x1 ? x1 : x0;
    low[e] = meets ? smaller : Infinite;
    high[e] = meets ? larger : -Infinite;
  }
  for (int e = 0; e < 4; ++e)
  {
    low[e] = low[e + 4] < low[e] ? low[e + 4] : low[e];
    low[e] = low[e + 8] < low[e] ? low[e + 8] : low[e];
    high[e] = high[e + 4] > high[e] ? high[e + 4] : high[e];
    high[e] = high[e + 8] > high[e] ? high[e + 8] : high[e];
  }
  least = std::min(std::min(low[0], low[1]), std::min(low[2], low[3]));
  greatest = std::max(std::max(high[0], high[1]), std::max(high[2], high[3]));
}

/** Columns of the polygon in a row, within those of its box; false where there are none. */
bool columnsOfRow(
  const PreparedView& view, const ProjectedOctant& p, const Outline& edges, int row, int& first, int& last)
{
  double least = 0.0, greatest = 0.0;
  spanOfRow(edges, row, view.height, least, greatest);
  if (!(least <= greatest))
  {
    return false;
  }
  first = std::max(p.firstColumn, PreparedView::nearestPixel(least - OctantGuard, view.width));
  last = std::min(p.lastColumn, PreparedView::nearestPixel(greatest + OctantGuard, view.width));
  return true;
}

/** The exact polygon, wherever it lies. */
ViewRelation relatePolygon(const PreparedView& view, const ProjectedOctant& p)
{
  Outline edges;
  makeOutline(p, edges);
  PixelContent content;
  for (int row = p.firstRow; row <= p.lastRow; ++row)
  {
    int first = 0, last = 0;
    if (columnsOfRow(view, p, edges, row, first, last))
    {
      merge(content, view.content(first, last, row, row));
    }
    if (content.background && (content.object || content.abstain))
    {
      return ViewRelation::Mixed;
    }
  }
  return relation(content);
}

/**
 * The exact polygon of an octant whose box lies in the image and holds both kinds of pixels. The corners' own pixels
 * lie in the polygon: where they differ, nothing else need be asked. Where they agree, only rows that hold the other
 * kind somewhere in the box can matter.
 */
ViewRelation relatePolygonInImage(const PreparedView& view, const ProjectedOctant& p)
{
  const auto column = [&](int c) { return int(p.x[gridPlace(c)] + 0.5); };
  const auto row = [&](int c) { return int(p.y[gridPlace(c)] + 0.5); };
  const bool object = view.objectInImage(column(0), row(0));
  for (int c = 1; c < 8; ++c)
  {
    if (view.objectInImage(column(c), row(c)) != object)
    {
      return ViewRelation::Mixed;
    }
  }
  Outline edges;
  makeOutline(p, edges);
  const auto differs = [&](int c0, int c1, int r0, int r1)
  {
    const TileContent content = view.contentInImage(c0, c1, r0, r1);
    return object ? content.background : content.object;
  };
  for (int r0 = p.firstRow; r0 <= p.lastRow; r0 = (r0 | 7) + 1)
  {
    const int r1 = std::min(p.lastRow, r0 | 7);
    if (!differs(p.firstColumn, p.lastColumn, r0, r1))
    {
      continue;
    }
    for (int r = r0; r <= r1; ++r)
    {
      int first = 0, last = 0;
      if (columnsOfRow(view, p, edges, r, first, last) && differs(first, last, r, r))
      {
        return ViewRelation::Mixed;
      }
    }
  }
  return object ? ViewRelation::Inside : ViewRelation::Background;
}

/** The same for a box of at most 8 x 8 pixels, of which `objects` are object and `box` all. */
ViewRelation relatePolygonInWindow(
  const PreparedView& view, const ProjectedOctant& p, std::uint64_t objects, std::uint64_t box)
{
  std::uint64_t corners = 0;
  for (int c = 0; c < 8; ++c)
  {
    const int row = int(p.y[gridPlace(c)] + 0.5) - p.firstRow, column = int(p.x[gridPlace(c)] + 0.5) - p.firstColumn;
    corners |= std::uint64_t(1) << (8 * row + column);
  }
  const bool object = (corners & objects) != 0;
  if (object && (corners & ~objects) != 0)
  {
    return ViewRelation::Mixed;
  }
  Outline edges;
  makeOutline(p, edges);
  const std::uint64_t others = object ? box & ~objects : objects;
  for (int row = p.firstRow; row <= p.lastRow; ++row)
  {
    const unsigned differ = unsigned(others >> 8 * (row - p.firstRow)) & 0xffu;
    int first = 0, last = 0;
    if (differ != 0 && columnsOfRow(view, p, edges, row, first, last) &&
      (differ & 0xffu >> (7 - (last - first)) << (first - p.firstColumn)) != 0)
    {
      return ViewRelation::Mixed;
    }
  }
  return object ? ViewRelation::Inside : ViewRelation::Background;
}

/** The stages, from the bounding box on. */
ViewRelation relateProjected(const PreparedView& view, const ProjectedOctant& p, bool polygon)
{
  const int columns = p.lastColumn - p.firstColumn + 1, rows = p.lastRow - p.firstRow + 1;
  // The polygon touches every row and every column of its box: only a box of two and more each leaves pixels out.
  const bool narrow = columns == 1 || rows == 1;
  if (!view.inImage(p.firstColumn, p.lastColumn, p.firstRow, p.lastRow))
  {
    const ViewRelation box = relation(view.content(p.firstColumn, p.lastColumn, p.firstRow, p.lastRow));
    const bool decided = !polygon || narrow || (box != ViewRelation::Mixed && box != ViewRelation::Partial);
    return decided ? box : relatePolygon(view, p);
  }
  if (columns <= PixelTiles::Size && rows <= PixelTiles::Size)
  {
    const std::uint64_t box = PixelTiles::windowPart(columns, rows);
    const std::uint64_t objects = view.window(p.firstColumn, p.firstRow) & box;
    if (objects == 0 || objects == box)
    {
      return objects == 0 ? ViewRelation::Background : ViewRelation::Inside;
    }
    return !polygon || narrow ? ViewRelation::Mixed : relatePolygonInWindow(view, p, objects, box);
  }
  const TileContent content = view.contentInImage(p.firstColumn, p.lastColumn, p.firstRow, p.lastRow);
  if (!content.object || !content.background)
  {
    return content.object ? ViewRelation::Inside : ViewRelation::Background;
  }
  return !polygon || narrow ? ViewRelation::Mixed : relatePolygonInImage(view, p);
}

ViewRelation relateInStages(
  const PreparedView& view, const LatticeProjection& projection, const OctantBox& octant, bool polygon)
{
  double x[18], y[18];
  double leastW = Infinite, greatestW = -Infinite;
  double leastX = Infinite, greatestX = -Infinite, leastY = Infinite, greatestY = -Infinite;
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint d = cornerOffset(c);
    const auto& o = octant.lowest;
    const auto h = projection({ o.i + d.i * octant.size, o.j + d.j * octant.size, o.k + d.k * octant.size });
    const double u = h.U / h.W, v = h.V / h.W;
    x[gridPlace(c)] = u;
    y[gridPlace(c)] = v;
    leastW = std::min(leastW, h.W);
    greatestW = std::max(greatestW, h.W);
    leastX = std::min(leastX, u);
    greatestX = std::max(greatestX, u);
    leastY = std::min(leastY, v);
    greatestY = std::max(greatestY, v);
  }
  // A margin, so that no lattice point of the octant is on the other side by rounding.
  const double margin = 1e-6 * projection.minimumDepth;
  if (leastW < projection.minimumDepth + margin)
  {
    return greatestW < projection.minimumDepth - margin ? ViewRelation::Abstain : ViewRelation::Mixed;
  }
  const ProjectedOctant p{ x, y, PreparedView::nearestPixel(leastX - OctantGuard, view.width),
    PreparedView::nearestPixel(greatestX + OctantGuard, view.width),
    PreparedView::nearestPixel(leastY - OctantGuard, view.height),
    PreparedView::nearestPixel(greatestY + OctantGuard, view.height) };
  return relateProjected(view, p, polygon);
}

/** Four numbers that are worked on together; by reference alone, since how they are passed depends on the machine. */
using Lanes = double __attribute__((vector_size(32)));
using Pixels = std::int32_t __attribute__((vector_size(16)));

/** The children's lattice points: row j + 3 k holds three and a spare one, which is the third again. */
struct ChildGrid
{
  Lanes x[9], y[9];
  double leastW;
};

/** For each child the bounding box's pixels. */
struct ChildBoxes
{
  std::int32_t firstColumn[8], lastColumn[8], firstRow[8], lastRow[8];
};

/**
 * One coordinate of the grid: the sums of LatticeProjection in its own order, so that each point gets the bits that
 * it gets there.
 */
inline void projectCoordinate(const LatticeProjection& p, int row, const OctantBox& parent, Lanes (&values)[9])
{
  const auto& o = parent.lowest;
  const std::int32_t half = parent.size / 2;
  const Lanes i = { double(o.i), double(o.i + half), double(o.i + 2 * half), double(o.i + 2 * half) };
  const Lanes start = p.constant[row] + p.step[0][row] * i;
  for (int j = 0; j < 3; ++j)
  {
    const Lanes plane = start + p.step[1][row] * double(o.j + j * half);
    for (int k = 0; k < 3; ++k)
    {
      values[j + 3 * k] = plane + p.step[2][row] * double(o.k + k * half);
    }
  }
}

struct Smaller
{
  static void of(const Lanes& a, const Lanes& b, Lanes& result) { result = a < b ? a : b; }
};

struct Larger
{
  static void of(const Lanes& a, const Lanes& b, Lanes& result) { result = a > b ? a : b; }
};

/** The nearest pixels of the children's least (or greatest) coordinates, moved outward by the guard. */
template <typename Pick>
inline void boundPixels(const Lanes (&values)[9], double guard, int size, std::int32_t (&pixels)[8])
{
  Lanes planes[6], rows[4];
  for (int n = 0; n < 6; ++n)
  {
    Pick::of(values[n], values[n + 3], planes[n]);
  }
  for (int n = 0; n < 4; ++n)
  {
    const int first = n / 2 * 3 + n % 2;
    Pick::of(planes[first], planes[first + 1], rows[n]);
  }
  for (int k = 0; k < 2; ++k)
  {
    const Lanes& a = rows[2 * k];
    const Lanes& b = rows[2 * k + 1];
    const Lanes left = { a[0], a[1], b[0], b[1] }, right = { a[1], a[2], b[1], b[2] };
    Lanes bound;
    Pick::of(left, right, bound);
    const Lanes outside = { -1.0, -1.0, -1.0, -1.0 }, end = Lanes{} + double(size);
    bound = (bound + guard) + 0.5;
    bound = bound >= 0.0 ? bound : outside; // so is what is behind the camera and no number at all
    bound = bound >= end ? end : bound;
    const Pixels nearest = __builtin_convertvector(bound, Pixels);
    std::memcpy(&pixels[4 * k], &nearest, sizeof(nearest));
  }
}

SILHOUETTE_VECTORISED void projectChildren(const PreparedView& view, const LatticeProjection& projection,
  const OctantBox& parent, ChildGrid& grid, ChildBoxes& boxes)
{
  Lanes U[9], V[9], W[9];
  projectCoordinate(projection, 0, parent, U);
  projectCoordinate(projection, 1, parent, V);
  projectCoordinate(projection, 2, parent, W);
  Lanes least = W[0];
  for (int n = 0; n < 9; ++n)
  {
    Smaller::of(W[n], least, least);
    grid.x[n] = U[n] / W[n];
    grid.y[n] = V[n] / W[n];
  }
  grid.leastW = std::min(std::min(least[0], least[1]), least[2]);
  boundPixels<Smaller>(grid.x, -OctantGuard, view.width, boxes.firstColumn);
  boundPixels<Larger>(grid.x, OctantGuard, view.width, boxes.lastColumn);
  boundPixels<Smaller>(grid.y, -OctantGuard, view.height, boxes.firstRow);
  boundPixels<Larger>(grid.y, OctantGuard, view.height, boxes.lastRow);
}

} // namespace

ViewRelation relate(const PreparedView& view, const LatticeProjection& projection, const OctantBox& octant)
{
  return relateInStages(view, projection, octant, true);
}

ViewRelation relateBoundingBox(
  const PreparedView& view, const LatticeProjection& projection, const OctantBox& octant)
{
  return relateInStages(view, projection, octant, false);
}

void relateChildren(const PreparedView& view, const LatticeProjection& projection, const OctantBox& parent,
  unsigned children, std::array<ViewRelation, 8>& relations)
{
  ChildGrid grid;
  ChildBoxes boxes;
  projectChildren(view, projection, parent, grid, boxes);
  const bool inFront = !(grid.leastW < projection.minimumDepth + 1e-6 * projection.minimumDepth);
  for (unsigned left = children; left != 0; left &= left - 1)
  {
    const int child = lowestBit(left);
    if (!inFront)
    {
      const std::int32_t half = parent.size / 2;
      const LatticePoint d = cornerOffset(child);
      const auto& o = parent.lowest;
      relations[child] = relate(view, projection, { { o.i + d.i * half, o.j + d.j * half, o.k + d.k * half }, half });
      continue;
    }
    const auto* x = reinterpret_cast<const double*>(grid.x) + gridPlace(child);
    const auto* y = reinterpret_cast<const double*>(grid.y) + gridPlace(child);
    const ProjectedOctant p{ x, y, boxes.firstColumn[child], boxes.lastColumn[child], boxes.firstRow[child],
      boxes.lastRow[child] };
    relations[child] = relateProjected(view, p, true);
  }
}

} // namespace silhouette
