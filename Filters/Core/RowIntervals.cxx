// SPDX-License-Identifier: BSD-3-Clause
#include "RowIntervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace silhouette
{
namespace
{

int firstAt(double place, int least)
{
  return std::max(least, int(std::ceil(place - RowTolerance)));
}

int lastAt(double place, int greatest)
{
  return std::min(greatest, int(std::floor(place + RowTolerance)));
}

/** The part of a segment from a to b at coordinate `axis` == plane, as the share of the way from a. */
double shareAt(double a, double b, double plane)
{
  return std::abs(b - a) < RowTolerance ? 0.0 : std::clamp((plane - a) / (b - a), 0.0, 1.0);
}

/** Least and greatest coordinate along the axis, on a window of rows. */
class RowWindow
{
public:
  RowWindow(const Mesh& hull, int axis, const Lattice& lattice)
    : Along(axis)
    , V((axis + 1) % 3)
    , W((axis + 2) % 3)
  {
    Eigen::Vector3d low = hull.points.front(), high = low;
    for (const auto& p : hull.points)
    {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const int greatest = lattice.cells() - 1;
    this->FirstV = firstAt(low[this->V], 1);
    this->LastV = lastAt(high[this->V], greatest);
    this->FirstW = firstAt(low[this->W], 1);
    this->LastW = lastAt(high[this->W], greatest);
    if (this->FirstV <= this->LastV && this->FirstW <= this->LastW)
    {
      this->Columns = std::size_t(this->LastV - this->FirstV + 1);
      constexpr double infinity = std::numeric_limits<double>::infinity();
      this->Low.assign(this->Columns * std::size_t(this->LastW - this->FirstW + 1), infinity);
      this->High.assign(this->Low.size(), -infinity);
    }
  }

  void add(const std::array<Eigen::Vector3d, 3>& corners)
  {
    const auto [least, most] = std::minmax({ corners[0][this->W], corners[1][this->W], corners[2][this->W] });
    for (int w = firstAt(least, this->FirstW); w <= lastAt(most, this->LastW); ++w)
    {
      // Where the triangle's edges meet the plane; all between these points belongs to the convex solid.
      std::array<Eigen::Vector2d, 6> met;
      int count = 0;
      for (int e = 0; e < 3; ++e)
      {
        this->meet(corners[e], corners[(e + 1) % 3], w, met, count);
      }
      for (int a = 0; a < count; ++a)
      {
        for (int b = a + 1; b < count; ++b)
        {
          this->span(w, met[a], met[b]);
        }
      }
    }
  }

  std::vector<RowInterval> rows() const
  {
    std::vector<RowInterval> found;
    for (std::size_t n = 0; n < this->Low.size(); ++n)
    {
      if (this->Low[n] <= this->High[n])
      {
        const auto v = std::uint64_t(this->FirstV) + n % this->Columns;
        const auto w = std::uint64_t(this->FirstW) + n / this->Columns;
        found.push_back({ w << 32 | v, this->Low[n], this->High[n] });
      }
    }
    return found;
  }

private:
  void meet(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int w, std::array<Eigen::Vector2d, 6>& met, int& count)
  {
    const double wa = a[this->W], wb = b[this->W];
    if (std::min(wa, wb) > w + RowTolerance || std::max(wa, wb) < w - RowTolerance)
    {
      return;
    }
    const bool inPlane = std::abs(wb - wa) < RowTolerance;
    const double s = shareAt(wa, wb, w);
    met[count++] = { a[this->Along] + s * (b[this->Along] - a[this->Along]), a[this->V] + s * (b[this->V] - a[this->V]) };
    if (inPlane)
    {
      met[count++] = { b[this->Along], b[this->V] };
    }
  }

  void span(int w, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
  {
    const auto [least, most] = std::minmax(a[1], b[1]);
    for (int v = firstAt(least, this->FirstV); v <= lastAt(most, this->LastV); ++v)
    {
      const std::size_t n = std::size_t(w - this->FirstW) * this->Columns + std::size_t(v - this->FirstV);
      const bool along = std::abs(b[1] - a[1]) < RowTolerance;
      const double s = shareAt(a[1], b[1], v);
      const double place = a[0] + s * (b[0] - a[0]);
      const double other = along ? b[0] : place;
      this->Low[n] = std::min({ this->Low[n], place, other });
      this->High[n] = std::max({ this->High[n], place, other });
    }
  }

  int Along, V, W;
  int FirstV = 0, LastV = -1, FirstW = 0, LastW = -1;
  std::size_t Columns = 0;
  std::vector<double> Low, High;
};

bool before(const RowInterval& a, const RowInterval& b)
{
  return a.row != b.row ? a.row < b.row : a.from != b.from ? a.from < b.from : a.to < b.to;
}

} // namespace

LatticePoint pointOnRow(std::uint64_t row, int axis, std::int32_t along)
{
  std::array<std::int32_t, 3> c{};
  c[axis] = along;
  c[(axis + 1) % 3] = std::int32_t(row & 0xffffffffu);
  c[(axis + 2) % 3] = std::int32_t(row >> 32);
  return { c[0], c[1], c[2] };
}

Eigen::Vector3d latticeCoordinates(const Eigen::Vector3d& p, const Lattice& lattice, double snap)
{
  Eigen::Vector3d g = (p - lattice.root.origin) / lattice.leafEdge();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double whole = std::round(g[axis]);
    g[axis] = std::abs(g[axis] - whole) < snap ? whole : g[axis];
  }
  return g;
}

std::vector<RowInterval> convexRows(const Mesh& hull, int axis, const Lattice& lattice)
{
  if (hull.triangles.empty())
  {
    return {};
  }
  RowWindow window(hull, axis, lattice);
  for (const auto& t : hull.triangles)
  {
    window.add({ hull.points[t[0]], hull.points[t[1]], hull.points[t[2]] });
  }
  return window.rows();
}

std::vector<RowInterval> surfaceRows(const SurfaceCrossings& crossings, int axis)
{
  std::vector<std::pair<std::uint64_t, double>> places;
  for (const auto& crossing : crossings.crossings)
  {
    if (int(crossing.edge & 3) == axis)
    {
      const LatticePoint lower = fromMorton(crossing.edge >> 2);
      places.emplace_back(rowKey(lower, axis), coordinateOf(lower, axis) + crossing.fraction);
    }
  }
  std::sort(places.begin(), places.end());
  std::vector<RowInterval> rows;
  // A closed surface is crossed inwards and outwards in turn.
  for (std::size_t n = 0; n + 1 < places.size();)
  {
    const bool pair = places[n].first == places[n + 1].first;
    if (pair)
    {
      rows.push_back({ places[n].first, places[n].second, places[n + 1].second });
    }
    n += pair ? 2 : 1;
  }
  return rows;
}

void uniteRows(std::vector<RowInterval>& rows)
{
  std::sort(rows.begin(), rows.end(), before);
  std::size_t kept = 0;
  for (std::size_t n = 1; n < rows.size(); ++n)
  {
    if (rows[n].row == rows[kept].row && rows[n].from <= rows[kept].to + RowTolerance)
    {
      rows[kept].to = std::max(rows[kept].to, rows[n].to);
    }
    else
    {
      rows[++kept] = rows[n];
    }
  }
  rows.resize(rows.empty() ? 0 : kept + 1);
}

const RowInterval* findInterval(const std::vector<RowInterval>& rows, std::uint64_t row, double place)
{
  const RowInterval sought{ row, place + RowTolerance, std::numeric_limits<double>::infinity() };
  const auto after = std::upper_bound(rows.begin(), rows.end(), sought, before);
  if (after == rows.begin())
  {
    return nullptr;
  }
  const RowInterval& interval = *(after - 1);
  return interval.row == row && place <= interval.to + RowTolerance ? &interval : nullptr;
}

} // namespace silhouette
