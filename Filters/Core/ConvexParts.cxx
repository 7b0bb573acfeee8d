// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexParts.h"

#include "RowIntervals.h"
#include "UnionFind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace silhouette
{
namespace
{

using Cell = std::array<std::int64_t, 2>; ///< place in the row, row

std::int64_t cross(const Cell& o, const Cell& a, const Cell& b)
{
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/** Hull of the runs' cell centres, counter-clockwise, exact: Andrew's monotone chain. */
std::vector<Cell> centreHull(const SliceRuns& runs)
{
  std::vector<Cell> points; // ascending by row, then place
  for (std::size_t n = 0; n < runs.size(); ++n)
  {
    const auto& run = runs[n];
    if (n == 0 || runs[n - 1].v != run.v)
    {
      points.push_back({ run.from, run.v });
    }
    if (n + 1 == runs.size() || runs[n + 1].v != run.v)
    {
      points.push_back({ run.to - 1, run.v });
    }
  }
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3)
  {
    return points;
  }
  std::vector<Cell> hull;
  for (int pass = 0; pass < 2; ++pass)
  {
    const std::size_t begin = hull.size();
    for (const auto& p : points)
    {
      // Rows ascend and the hull lies to the left; swapped coordinates turn the orientation round.
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0)
      {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/** The least distance of a cell's centre from the hull's sides; negative outside. */
double depthBelow(const std::vector<Cell>& hull, const Cell& cell)
{
  double depth = 1e300;
  for (std::size_t n = 0; n < hull.size(); ++n)
  {
    const Cell &a = hull[n], &b = hull[(n + 1) % hull.size()];
    depth = std::min(depth, double(cross(a, b, cell)) / std::hypot(double(b[0] - a[0]), double(b[1] - a[1])));
  }
  return depth;
}

struct Deepest
{
  double depth = 0.0;
  Cell cell{};
};

/** The deepest of the cells [from, to] of a row: depth is concave along it. */
void searchGap(const std::vector<Cell>& hull, std::int64_t from, std::int64_t to, std::int64_t v, Deepest& deepest)
{
  if (from > to)
  {
    return;
  }
  while (from < to)
  {
    const std::int64_t middle = (from + to) / 2;
    (depthBelow(hull, { middle, v }) < depthBelow(hull, { middle + 1, v }) ? from : to) =
      depthBelow(hull, { middle, v }) < depthBelow(hull, { middle + 1, v }) ? middle + 1 : middle;
  }
  const double depth = depthBelow(hull, { from, v });
  if (depth > deepest.depth)
  {
    deepest = { depth, { from, v } };
  }
}

/** The part of row v within the hull. */
std::array<double, 2> hullRow(const std::vector<Cell>& hull, std::int64_t v)
{
  double low = 1e300, high = -1e300;
  for (std::size_t n = 0; n < hull.size(); ++n)
  {
    const Cell &a = hull[n], &b = hull[(n + 1) % hull.size()];
    if (std::min(a[1], b[1]) <= v && v <= std::max(a[1], b[1]))
    {
      const double t = a[1] == b[1] ? 0.0 : double(v - a[1]) / double(b[1] - a[1]);
      const double place = double(a[0]) + t * double(b[0] - a[0]);
      low = std::min(low, place);
      high = std::max(high, place);
    }
  }
  return { low, high };
}

/** The background cell of the slice that lies deepest below the hull of a part. */
Deepest deepestBackground(const SliceRuns& part, const SliceRuns& slice)
{
  Deepest deepest;
  const auto hull = centreHull(part);
  if (hull.size() < 3)
  {
    return deepest;
  }
  auto run = std::lower_bound(slice.begin(), slice.end(), part.front().v,
    [](const SliceRun& a, std::int32_t row) { return a.v < row; });
  for (std::int32_t v = part.front().v; v <= part.back().v; ++v)
  {
    const auto [low, high] = hullRow(hull, v);
    auto next = std::int64_t(std::ceil(low - RowTolerance));
    const auto last = std::int64_t(std::floor(high + RowTolerance));
    for (; run != slice.end() && run->v == v; ++run)
    {
      searchGap(hull, next, std::min<std::int64_t>(last, run->from - 1), v, deepest);
      next = std::max<std::int64_t>(next, run->to);
    }
    searchGap(hull, next, last, v, deepest);
  }
  return deepest;
}

struct Part
{
  SliceRuns runs;
  Deepest deepest;
};

/** The cells whose distance from the line through `through` with the given normal is at most `margin`, or on its far side. */
SliceRuns clipped(const SliceRuns& runs, const Cell& through, double nu, double nv, double margin)
{
  SliceRuns kept;
  for (SliceRun run : runs)
  {
    // nu (u - u0) + nv (v - v0) <= margin
    const double rest = margin - nv * double(run.v - through[1]);
    if (std::abs(nu) < RowTolerance)
    {
      run.to = rest < 0.0 ? run.from : run.to;
    }
    else if (nu > 0.0)
    {
      run.to = std::min(run.to, std::int32_t(std::floor(double(through[0]) + rest / nu + RowTolerance)) + 1);
    }
    else
    {
      run.from = std::max(run.from, std::int32_t(std::ceil(double(through[0]) + rest / nu - RowTolerance)));
    }
    if (run.from < run.to)
    {
      kept.push_back(run);
    }
  }
  return kept;
}

/** What becomes of the cells on a cut's line. */
enum class CutLine : int
{
  Both, ///< they belong to both sides
  Near, ///< to the first side
  Far   ///< to the second one
};

/** Both sides' connected pieces, the largest first, without those that lie wholly within another. */
std::vector<SliceRuns> cut(const SliceRuns& part, const Cell& through, double nu, double nv, CutLine line)
{
  const double band = 0.5 * (std::abs(nu) + std::abs(nv)), less = -1e-6;
  const double near = line == CutLine::Both ? band : line == CutLine::Near ? 0.0 : less;
  const double far = line == CutLine::Both ? band : line == CutLine::Far ? 0.0 : less;
  std::vector<SliceRuns> pieces = connectedRegions(clipped(part, through, nu, nv, near));
  const auto others = connectedRegions(clipped(part, through, -nu, -nv, far));
  pieces.insert(pieces.end(), others.begin(), others.end());
  std::stable_sort(pieces.begin(), pieces.end(),
    [](const SliceRuns& a, const SliceRuns& b) { return cellCount(a) > cellCount(b); });
  std::vector<SliceRuns> kept;
  for (auto& piece : pieces)
  {
    const std::int64_t cells = cellCount(piece);
    if (std::none_of(kept.begin(), kept.end(), [&](const SliceRuns& k) { return overlap(k, piece) == cells; }))
    {
      kept.push_back(std::move(piece));
    }
  }
  return kept;
}

/**
 * Is a cut of use? Cells that belong to both sides are worth their while only where the pieces are clearly
 * smaller, which also bounds the number of pieces.
 */
bool helps(const std::vector<SliceRuns>& pieces, std::int64_t cells, CutLine line)
{
  const std::int64_t largest = cellCount(pieces.front());
  return pieces.size() > 1 && (line == CutLine::Both ? 4 * largest <= 3 * cells : largest < cells);
}

/** The cut whose worst piece is best, then the one with fewest pieces; nothing where no cut helps. */
std::vector<Part> bestCut(const Part& part, const SliceRuns& slice, double tolerance)
{
  static const double pi = std::acos(-1.0);
  const std::int64_t cells = cellCount(part.runs);
  std::vector<Part> best;
  std::tuple<double, std::size_t> bestScore;
  for (const CutLine line : { CutLine::Both, CutLine::Near, CutLine::Far })
  {
    for (int direction = 0; direction < 8; ++direction)
    {
      const double angle = pi * direction / 8.0;
      const auto pieces = cut(part.runs, part.deepest.cell, std::cos(angle), std::sin(angle), line);
      if (!helps(pieces, cells, line))
      {
        continue;
      }
      std::vector<Part> parts;
      double worst = tolerance;
      for (const auto& piece : pieces)
      {
        parts.push_back({ piece, deepestBackground(piece, slice) });
        worst = std::max(worst, parts.back().deepest.depth);
      }
      const std::tuple<double, std::size_t> score(worst, parts.size());
      if (best.empty() || score < bestScore)
      {
        bestScore = score;
        best = std::move(parts);
      }
    }
  }
  return best;
}

} // namespace

std::int64_t cellCount(const SliceRuns& runs)
{
  std::int64_t count = 0;
  for (const auto& run : runs)
  {
    count += run.to - run.from;
  }
  return count;
}

std::int64_t overlap(const SliceRuns& a, const SliceRuns& b)
{
  std::int64_t count = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();)
  {
    if (a[i].v == b[j].v)
    {
      count += std::max(0, std::min(a[i].to, b[j].to) - std::max(a[i].from, b[j].from));
    }
    const bool first = a[i].v != b[j].v ? a[i].v < b[j].v : a[i].to < b[j].to;
    ++(first ? i : j);
  }
  return count;
}

std::vector<SliceRuns> connectedRegions(const SliceRuns& runs)
{
  UnionFind sets(runs.size());
  for (std::size_t above = 0, below = 0; above < runs.size(); ++above)
  {
    // `below` is the first run of the row before that may still touch.
    while (below < above && (runs[below].v < runs[above].v - 1 ||
      (runs[below].v == runs[above].v - 1 && runs[below].to <= runs[above].from)))
    {
      ++below;
    }
    for (std::size_t b = below; b < above && runs[b].v == runs[above].v - 1 && runs[b].from < runs[above].to; ++b)
    {
      sets.unite(std::uint32_t(b), std::uint32_t(above));
    }
  }
  std::vector<SliceRuns> regions;
  std::vector<std::size_t> number(runs.size());
  for (std::size_t n = 0; n < runs.size(); ++n)
  {
    const std::uint32_t root = sets.find(std::uint32_t(n)); // the set's least member
    if (root == n)
    {
      number[n] = regions.size();
      regions.emplace_back();
    }
    regions[number[root]].push_back(runs[n]);
  }
  return regions;
}

std::vector<SliceRuns> convexParts(const SliceRuns& region, const SliceRuns& slice, double tolerance)
{
  std::vector<Part> open{ { region, deepestBackground(region, slice) } };
  std::vector<SliceRuns> parts;
  while (!open.empty())
  {
    Part part = std::move(open.back());
    open.pop_back();
    std::vector<Part> pieces;
    if (part.deepest.depth > std::max(tolerance, RowTolerance))
    {
      pieces = bestCut(part, slice, tolerance);
    }
    if (!pieces.empty())
    {
      std::move(pieces.begin(), pieces.end(), std::back_inserter(open));
    }
    else
    {
      parts.push_back(std::move(part.runs));
    }
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

std::vector<SliceRuns> halves(const SliceRuns& part)
{
  std::int32_t low = part.front().from, high = part.front().to;
  for (const auto& run : part)
  {
    low = std::min(low, run.from);
    high = std::max(high, run.to);
  }
  const std::int32_t rows = part.back().v - part.front().v + 1;
  const bool along = high - low >= rows; // of equal sides, the row's
  const Cell middle{ low + (high - low - 1) / 2, part.front().v + (rows - 1) / 2 };
  for (const CutLine line : { CutLine::Both, CutLine::Near })
  {
    auto pieces = cut(part, middle, along ? 1.0 : 0.0, along ? 0.0 : 1.0, line);
    if (helps(pieces, cellCount(part), line))
    {
      return pieces;
    }
  }
  return { part };
}

} // namespace silhouette
