// SPDX-License-Identifier: BSD-3-Clause
#include "HullChains.h"

#include "ConvexHull.h"
#include "ParameterRange.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace silhouette
{
namespace
{

constexpr std::uint32_t None = 0xffffffffu;

/**
 * Share of the tolerance that a single part may use up. Nothing in a slice lies deeper than half an octant; just below
 * it, the default tolerance sees a gap that is as thick as the slice.
 */
constexpr double PartShare = 0.9;

/** Half-spaces of a convex mesh: normal . x <= offset. */
std::vector<Eigen::Vector4d> halfSpaces(const Mesh& hull)
{
  std::vector<Eigen::Vector4d> planes;
  for (const auto& t : hull.triangles)
  {
    const Eigen::Vector3d& a = hull.points[t[0]];
    const Eigen::Vector3d normal = (hull.points[t[1]] - a).cross(hull.points[t[2]] - a);
    const double length = normal.norm();
    if (length > 1e-12)
    {
      planes.emplace_back(normal.x() / length, normal.y() / length, normal.z() / length, normal.dot(a) / length);
    }
  }
  return planes;
}

/** Does the hull, each of its sides moved inwards by `depth`, hold a place of [from, to] on a row? */
bool reaches(const std::vector<Eigen::Vector4d>& planes, std::uint64_t row, int axis, double from, double to, double depth)
{
  const LatticePoint p = pointOnRow(row, axis, 0);
  for (const auto& plane : planes)
  {
    const double rest = plane[3] - depth - plane[0] * p.i - plane[1] * p.j - plane[2] * p.k;
    const double slope = plane[axis];
    if (std::abs(slope) < 1e-12)
    {
      to = rest < 0.0 ? -std::numeric_limits<double>::infinity() : to;
    }
    else if (slope > 0.0)
    {
      to = std::min(to, rest / slope);
    }
    else
    {
      from = std::max(from, rest / slope);
    }
    if (!(from < to))
    {
      return false;
    }
  }
  return from < to;
}

/** holdsOutside along one axis. */
bool holdsOutsideAlong(int axis, const Mesh& hull, const std::vector<Eigen::Vector4d>& planes,
  const std::vector<RowInterval>& solid, const Lattice& lattice, double depth)
{
  auto held = solid.begin();
  for (const auto& row : convexRows(hull, axis, lattice))
  {
    // What is deeper than `depth` is so along the row too.
    double next = row.from + depth;
    const double last = row.to - depth;
    if (next >= last)
    {
      continue;
    }
    held = std::lower_bound(held, solid.end(), row.row, [](const RowInterval& a, std::uint64_t r) { return a.row < r; });
    for (auto at = held; at != solid.end() && at->row == row.row && at->from < last; ++at)
    {
      if (next < at->from && reaches(planes, row.row, axis, next, at->from, depth))
      {
        return true;
      }
      next = std::max(next, at->to);
    }
    if (next < last && reaches(planes, row.row, axis, next, last, depth))
    {
      return true;
    }
  }
  return false;
}

/** Numbers of the cells whose closed cube holds a coordinate: one, or two where it is a lattice plane's. */
std::pair<std::int32_t, std::int32_t> cellsOf(double coordinate)
{
  const double below = std::floor(coordinate);
  return { std::int32_t(below) - (coordinate == below), std::int32_t(below) };
}

std::vector<Eigen::Vector3d> select(const std::vector<Eigen::Vector3d>& points, const std::vector<std::int32_t>& indices)
{
  std::vector<Eigen::Vector3d> selected;
  selected.reserve(indices.size());
  for (const std::int32_t index : indices)
  {
    selected.push_back(points[index]);
  }
  return selected;
}

/** Call `work` for each number below `count`, `block` of them between two looks at whether to stop. */
template <typename Work>
void forBlocks(std::size_t count, std::size_t block, Execution& execution, const Work& work)
{
  for (std::size_t begin = 0; begin < count; begin += block)
  {
    execution.checkpoint(double(begin) / double(count));
    execution.forRanges(std::min(block, count - begin), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = begin + first; n < begin + last; ++n)
        {
          work(n);
        }
      });
  }
  execution.checkpoint(1.0);
}

/** The stretch of a chain that was accepted last. */
struct Stretch
{
  std::vector<Eigen::Vector3d> corners; ///< enough points to span the hull
  std::optional<Mesh> hull;
};

class ChainCutter
{
public:
  ChainCutter(const SlicedVolume& volume, const SlicePoints& slicePoints, const std::vector<Eigen::Vector3d>& points,
    const SolidRows& solid, const Lattice& lattice, double tolerance)
    : Volume(volume)
    , InSlices(slicePoints)
    , Points(points)
    , Solid(solid)
    , TheLattice(lattice)
    , Tolerance(tolerance)
  {
  }

  std::vector<LocalHull> operator()(const PartChain& chain) const
  {
    std::vector<std::vector<std::int32_t>> inParts;
    std::vector<std::vector<Eigen::Vector3d>> corners;
    for (const auto& [slice, part] : chain)
    {
      inParts.push_back(this->InSlices.inPart(slice, this->Volume.parts[slice][part]));
      corners.push_back(this->cornersOf(inParts.back()));
    }
    std::vector<LocalHull> hulls;
    for (std::size_t first = 0; first < chain.size();)
    {
      Stretch stretch = this->joined(Stretch(), corners, first, first + 1);
      const std::size_t end = this->extend(stretch, corners, first + 1);
      if (stretch.hull)
      {
        LocalHull hull{ std::move(*stretch.hull), united(inParts, first, end) };
        for (auto& p : hull.mesh.points)
        {
          p = { this->TheLattice.coordinate(0, p.x()), this->TheLattice.coordinate(1, p.y()),
            this->TheLattice.coordinate(2, p.z()) };
        }
        hulls.push_back(std::move(hull));
      }
      first = end;
    }
    return hulls;
  }

private:
  /** The points that span a part's hull; all where they lie in a plane. */
  std::vector<Eigen::Vector3d> cornersOf(const std::vector<std::int32_t>& part) const
  {
    auto corners = select(this->Points, part);
    auto hull = convexHull(corners);
    return hull ? std::move(hull->points) : corners;
  }

  Stretch joined(const Stretch& before, const std::vector<std::vector<Eigen::Vector3d>>& corners, std::size_t first,
    std::size_t end) const
  {
    Stretch stretch;
    stretch.corners = before.corners;
    for (std::size_t n = first; n < end; ++n)
    {
      stretch.corners.insert(stretch.corners.end(), corners[n].begin(), corners[n].end());
    }
    stretch.hull = convexHull(stretch.corners);
    if (stretch.hull)
    {
      stretch.corners = stretch.hull->points;
    }
    return stretch;
  }

  /** Lengthen a stretch that ends before `end` as far as it goes; returns its new end. */
  std::size_t extend(
    Stretch& stretch, const std::vector<std::vector<Eigen::Vector3d>>& corners, std::size_t end) const
  {
    bool failed = false;
    for (std::size_t step = 1; step > 0 && end < corners.size();)
    {
      const std::size_t next = std::min(corners.size(), end + step);
      Stretch longer = this->joined(stretch, corners, end, next);
      if (longer.hull && holdsOutside(*longer.hull, this->Solid, this->TheLattice, this->Tolerance))
      {
        failed = true;
        step = (next - end) / 2;
        continue;
      }
      stretch = std::move(longer);
      end = next;
      step = failed ? step / 2 : 2 * step;
    }
    return end;
  }

  static std::vector<std::int32_t> united(
    const std::vector<std::vector<std::int32_t>>& inParts, std::size_t first, std::size_t end)
  {
    std::vector<std::int32_t> all;
    for (std::size_t n = first; n < end; ++n)
    {
      all.insert(all.end(), inParts[n].begin(), inParts[n].end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  const SlicedVolume& Volume;
  const SlicePoints& InSlices;
  const std::vector<Eigen::Vector3d>& Points;
  const SolidRows& Solid;
  const Lattice& TheLattice;
  double Tolerance;
};

/** For each part of `lower` the part of `upper` that it is linked with, or None. */
std::vector<std::uint32_t> linksBetween(
  const std::vector<SliceRuns>& lower, const std::vector<SliceRuns>& upper, double share)
{
  std::vector<std::tuple<std::int64_t, std::uint32_t, std::uint32_t>> candidates;
  for (std::uint32_t a = 0; a < lower.size(); ++a)
  {
    for (std::uint32_t b = 0; b < upper.size(); ++b)
    {
      // Parts of which one ends before the other begins share nothing; most pairs are such.
      if (lower[a].back().v < upper[b].front().v || upper[b].back().v < lower[a].front().v)
      {
        continue;
      }
      const std::int64_t common = overlap(lower[a], upper[b]);
      if (common > 0 && double(common) >= share * double(std::min(cellCount(lower[a]), cellCount(upper[b]))))
      {
        candidates.emplace_back(-common, a, b);
      }
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::uint32_t> above(lower.size(), None);
  std::vector<bool> taken(upper.size(), false);
  for (const auto& [common, a, b] : candidates)
  {
    if (above[a] == None && !taken[b])
    {
      above[a] = b;
      taken[b] = true;
    }
  }
  return above;
}

} // namespace

std::vector<PartChain> linkParts(const SlicedVolume& volume, double overlap)
{
  std::vector<PartChain> chains;
  std::vector<std::uint32_t> chainOf; // of the parts of the slice before
  for (std::uint32_t s = 0; s < volume.parts.size(); ++s)
  {
    std::vector<std::uint32_t> chain(volume.parts[s].size(), None);
    if (s > 0)
    {
      const auto above = linksBetween(volume.parts[s - 1], volume.parts[s], overlap);
      for (std::size_t a = 0; a < above.size(); ++a)
      {
        if (above[a] != None)
        {
          chain[above[a]] = chainOf[a];
        }
      }
    }
    for (std::uint32_t p = 0; p < chain.size(); ++p)
    {
      if (chain[p] == None)
      {
        chain[p] = std::uint32_t(chains.size());
        chains.emplace_back();
      }
      chains[chain[p]].emplace_back(s, p);
    }
    chainOf = std::move(chain);
  }
  return chains;
}

SlicePoints::SlicePoints(const SlicedVolume& volume, const std::vector<Eigen::Vector3d>& points)
  : Slices(volume.parts.size())
{
  const int axisU = (volume.axis + 1) % 3, axisV = (volume.axis + 2) % 3;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    const auto [firstW, lastW] = cellsOf(points[p][volume.axis]);
    const auto [firstU, lastU] = cellsOf(points[p][axisU]);
    const auto [firstV, lastV] = cellsOf(points[p][axisV]);
    for (std::int32_t w = firstW; w <= lastW; ++w)
    {
      const std::int64_t slice = std::int64_t(w) - volume.firstSlice;
      for (std::int32_t v = firstV; v <= lastV && slice >= 0 && slice < std::int64_t(this->Slices.size()); ++v)
      {
        for (std::int32_t u = firstU; u <= lastU; ++u)
        {
          this->Slices[std::size_t(slice)].push_back({ v, u, std::int32_t(p) });
        }
      }
    }
  }
  for (auto& slice : this->Slices)
  {
    std::sort(slice.begin(), slice.end(), [](const Entry& a, const Entry& b)
      { return std::tie(a.v, a.u, a.point) < std::tie(b.v, b.u, b.point); });
  }
}

std::vector<std::int32_t> SlicePoints::inPart(std::size_t slice, const SliceRuns& part) const
{
  const auto& entries = this->Slices[slice];
  std::vector<std::int32_t> inside;
  for (const auto& run : part)
  {
    auto at = std::lower_bound(entries.begin(), entries.end(), run, [](const Entry& a, const SliceRun& r)
      { return std::tie(a.v, a.u) < std::tie(r.v, r.from); });
    for (; at != entries.end() && at->v == run.v && at->u < run.to; ++at)
    {
      inside.push_back(at->point);
    }
  }
  std::sort(inside.begin(), inside.end());
  inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
  return inside;
}

void refineParts(SlicedVolume& volume, const SlicePoints& slicePoints, const std::vector<Eigen::Vector3d>& points,
  const SolidRows& solid, const Lattice& lattice, double tolerance, Execution& execution)
{
  const auto fits = [&](std::size_t slice, const SliceRuns& part)
  {
    const auto hull = convexHull(select(points, slicePoints.inPart(slice, part)));
    return !hull || !holdsOutside(*hull, solid, lattice, PartShare * tolerance);
  };
  forBlocks(volume.parts.size(), 64, execution,
    [&](std::size_t slice)
    {
      std::vector<SliceRuns> done, open = std::move(volume.parts[slice]);
      std::reverse(open.begin(), open.end());
      while (!open.empty())
      {
        SliceRuns part = std::move(open.back());
        open.pop_back();
        std::vector<SliceRuns> pieces;
        if (!fits(slice, part))
        {
          pieces = halves(part);
        }
        if (pieces.size() > 1)
        {
          std::move(pieces.rbegin(), pieces.rend(), std::back_inserter(open));
        }
        else
        {
          done.push_back(std::move(part));
        }
      }
      volume.parts[slice] = std::move(done);
    });
}

bool holdsOutside(const Mesh& hull, const SolidRows& solid, const Lattice& lattice, double tolerance)
{
  const double depth = std::max(tolerance, RowTolerance);
  const auto planes = halfSpaces(hull);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (holdsOutsideAlong(axis, hull, planes, solid[axis], lattice, depth))
    {
      return true;
    }
  }
  return false;
}

std::vector<LocalHull> hullChains(SlicedVolume volume, const std::vector<Eigen::Vector3d>& points,
  const SolidRows& solid, const Lattice& lattice, const ChainOptions& options, Execution& execution)
{
  requireRange("chain tolerance", options.tolerance, 0.0);
  requireAboveZero("chain overlap", options.overlap, 1.0);
  const SlicePoints slicePoints(volume, points);
  Phase refining(execution, 0.0, 0.4);
  refineParts(volume, slicePoints, points, solid, lattice, options.tolerance, refining);
  const auto chains = linkParts(volume, options.overlap);
  const ChainCutter cutter(volume, slicePoints, points, solid, lattice, options.tolerance);
  std::vector<std::vector<LocalHull>> found(chains.size());
  Phase chaining(execution, 0.4, 1.0);
  forBlocks(chains.size(), 256, chaining, [&](std::size_t c) { found[c] = cutter(chains[c]); });
  std::vector<LocalHull> hulls;
  for (auto& some : found)
  {
    std::move(some.begin(), some.end(), std::back_inserter(hulls));
  }
  return hulls;
}

} // namespace silhouette
