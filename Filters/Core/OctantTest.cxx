// SPDX-License-Identifier: BSD-3-Clause
#include "OctantTest.h"

#include "MarchingCubesTable.h"

#include <limits>
#include <vector>

namespace silhouette
{
namespace
{

struct ProjectedOctant
{
  double x[8];
  double y[8];
  double leastX, greatestX, leastY, greatestY;
};

enum class Side
{
  InFront,
  Behind,
  Straddling
};

/** Project the corners; each gets the bits that LatticeProjection gives it. */
Side project(const LatticeProjection& p, const OctantBox& octant, ProjectedOctant& out)
{
  const auto& o = octant.lowest;
  double W[8];
  double leastW = std::numeric_limits<double>::infinity();
  double greatestW = -leastW;
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint d = cornerOffset(c);
    const auto h = p({ o.i + d.i * octant.size, o.j + d.j * octant.size, o.k + d.k * octant.size });
    out.x[c] = h.U;
    out.y[c] = h.V;
    W[c] = h.W;
    leastW = std::min(leastW, h.W);
    greatestW = std::max(greatestW, h.W);
  }
  // A margin, so that no lattice point of the octant is on the other side by rounding.
  const double margin = 1e-6 * p.minimumDepth;
  if (greatestW < p.minimumDepth - margin)
  {
    return Side::Behind;
  }
  if (leastW < p.minimumDepth + margin)
  {
    return Side::Straddling;
  }
  out.leastX = out.leastY = std::numeric_limits<double>::infinity();
  out.greatestX = out.greatestY = -out.leastX;
  for (int c = 0; c < 8; ++c)
  {
    out.x[c] /= W[c];
    out.y[c] /= W[c];
    out.leastX = std::min(out.leastX, out.x[c]);
    out.greatestX = std::max(out.greatestX, out.x[c]);
    out.leastY = std::min(out.leastY, out.y[c]);
    out.greatestY = std::max(out.greatestY, out.y[c]);
  }
  return Side::InFront;
}

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

/** For each image row, with one band above the image and one below, the polygon's extent in x. */
struct RowSpans
{
  int firstRow; ///< -1 is the band above
  std::vector<double> least, greatest;
};

/** Widen the spans by the part of segment a-b that lies in each row's band of half-open pixels. */
void addEdge(RowSpans& spans, int height, double ax, double ay, double bx, double by)
{
  if (ay > by)
  {
    std::swap(ax, bx);
    std::swap(ay, by);
  }
  const int last = spans.firstRow + int(spans.least.size()) - 1;
  const int from = std::max(spans.firstRow, PreparedView::nearestPixel(ay - OctantGuard, height));
  const int to = std::min(last, PreparedView::nearestPixel(by + OctantGuard, height));
  const double dy = by - ay;
  for (int row = from; row <= to; ++row)
  {
    const double low = row < 0 ? ay : std::max(ay, row - 0.5 - OctantGuard);
    const double high = row >= height ? by : std::min(by, row + 0.5 + OctantGuard);
    const double s = dy > 0.0 ? std::clamp((low - ay) / dy, 0.0, 1.0) : 0.0;
    const double t = dy > 0.0 ? std::clamp((high - ay) / dy, 0.0, 1.0) : 1.0;
    const double x0 = ax + s * (bx - ax);
    const double x1 = ax + t * (bx - ax);
    double& least = spans.least[row - spans.firstRow];
    double& greatest = spans.greatest[row - spans.firstRow];
    least = std::min(least, std::min(x0, x1));
    greatest = std::max(greatest, std::max(x0, x1));
  }
}

/** The exact polygon. The outline of a projected cube consists of projected edges, so the twelve edges suffice. */
ViewRelation relatePolygon(const PreparedView& view, const ProjectedOctant& p, int firstRow, int lastRow)
{
  thread_local RowSpans spans;
  const std::size_t rows = std::size_t(lastRow - firstRow + 1);
  spans.firstRow = firstRow;
  spans.least.assign(rows, std::numeric_limits<double>::infinity());
  spans.greatest.assign(rows, -std::numeric_limits<double>::infinity());
  for (const auto& edge : edgeCorners)
  {
    addEdge(spans, view.height, p.x[edge[0]], p.y[edge[0]], p.x[edge[1]], p.y[edge[1]]);
  }
  PixelContent content;
  for (int row = firstRow; row <= lastRow; ++row)
  {
    const double least = spans.least[row - firstRow];
    const double greatest = spans.greatest[row - firstRow];
    if (least <= greatest)
    {
      merge(content,
        view.content(PreparedView::nearestPixel(least - OctantGuard, view.width),
          PreparedView::nearestPixel(greatest + OctantGuard, view.width), row, row));
    }
    if (content.background && (content.object || content.abstain))
    {
      return ViewRelation::Mixed;
    }
  }
  return relation(content);
}

ViewRelation relateInStages(
  const PreparedView& view, const LatticeProjection& projection, const OctantBox& octant, bool polygon)
{
  ProjectedOctant p;
  const Side side = project(projection, octant, p);
  if (side != Side::InFront)
  {
    return side == Side::Behind ? ViewRelation::Abstain : ViewRelation::Mixed;
  }
  const int firstColumn = PreparedView::nearestPixel(p.leastX - OctantGuard, view.width);
  const int lastColumn = PreparedView::nearestPixel(p.greatestX + OctantGuard, view.width);
  const int firstRow = PreparedView::nearestPixel(p.leastY - OctantGuard, view.height);
  const int lastRow = PreparedView::nearestPixel(p.greatestY + OctantGuard, view.height);
  const ViewRelation box = relation(view.content(firstColumn, lastColumn, firstRow, lastRow));
  // The polygon touches every row and every column of its box: only a box of two and more each leaves pixels out.
  if (!polygon || (box != ViewRelation::Mixed && box != ViewRelation::Partial) || firstColumn == lastColumn ||
    firstRow == lastRow)
  {
    return box;
  }
  return relatePolygon(view, p, firstRow, lastRow);
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

} // namespace silhouette
