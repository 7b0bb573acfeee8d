// SPDX-License-Identifier: BSD-3-Clause
#include "ThinHulls.h"

#include "ParameterRange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace silhouette
{
namespace
{

/** A place in an octant that is deep in the silhouettes, lattice coordinates. */
struct Witness
{
  Vector3 place = Vector3::Zero();
  double depth = -1e300; ///< octants
};

/** The deepest of side^3 samples, and from there uphill. */
Witness findWitness(const SilhouetteDepth& depth, const LatticePoint& cell, int side)
{
  const Vector3 low = toVector(cell);
  Witness best;
  int strictest = 0;
  const auto take = [&](const Vector3& p)
  {
    const double d = depth(p, best.depth, strictest);
    best = d > best.depth ? Witness{ p, d } : best;
  };
  for (int n = 0; n < side * side * side; ++n)
  {
    take(low + Vector3(n % side + 0.5, n / side % side + 0.5, n / (side * side) + 0.5) / double(side));
  }
  for (double step = 0.125; step > 0.02; step *= 0.5)
  {
    for (int n = 0; n < 6; ++n)
    {
      Vector3 p = best.place;
      p[n / 2] += n % 2 == 0 ? step : -step;
      if (((p - low).array() > 0.02).all() && ((p - low).array() < 0.98).all())
      {
        take(p);
      }
    }
  }
  return best;
}

/** Are two of an octant's 26 neighbours neighbours of each other? */
bool touch(int n, int m)
{
  return std::abs(n % 3 - m % 3) <= 1 && std::abs(n / 3 % 3 - m / 3 % 3) <= 1 && std::abs(n / 9 - m / 9) <= 1;
}

/** The balls of the covered octants and of the ordinary survivors next to them, and which pairs of them make hulls. */
class Balls
{
public:
  Balls(const LatticeLabels& labels, const std::vector<std::uint32_t>& cells, const SilhouetteDepth& depth,
    const ThinHullOptions& options, Execution& execution)
    : Labels(labels)
    , Covered(cells)
    , Options(options)
  {
    this->collect();
    this->Found.resize(this->All.size());
    execution.checkpoint(0.1);
    execution.forRanges(this->All.size(), 16,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          this->Found[n] =
            findWitness(depth, fromMorton(labels.shell().cells[this->All[n]]), this->isCovered(this->All[n]) ? 4 : 2);
        }
      });
    execution.checkpoint(0.9);
  }

  void appendHulls(std::uint32_t cell, std::vector<ThinHull>& hulls) const
  {
    const auto around = this->neighbours(cell);
    const bool onSolid = this->onSolid(around);
    bool alone = true;
    for (int n = 0; n < 27; ++n)
    {
      if (around[n] < 0)
      {
        continue;
      }
      const auto other = std::uint32_t(around[n]);
      const bool covered = this->isCovered(other);
      const bool otherOnSolid = covered && this->onSolid(this->neighbours(other));
      alone = alone && !covered && !onSolid;
      // What leans on the solid on both sides is shaped by the silhouettes; a hull would only make it fatter.
      if (covered ? other > cell && !(onSolid && otherOnSolid) : this->isDeepest(around, n))
      {
        hulls.push_back(this->hullOf(cell, onSolid, other, otherOnSolid));
      }
    }
    if (alone)
    {
      hulls.push_back(this->hullOf(cell, false, cell, false));
    }
  }

private:
  using Neighbours = std::array<std::ptrdiff_t, 27>; ///< shell cells that survived, or -1

  bool isCovered(std::uint32_t cell) const
  {
    return std::binary_search(this->Covered.begin(), this->Covered.end(), cell);
  }

  Neighbours neighbours(std::uint32_t cell) const
  {
    Neighbours result;
    const LatticePoint p = fromMorton(this->Labels.shell().cells[cell]);
    for (int n = 0; n < 27; ++n)
    {
      const auto other = n == 13 ? std::ptrdiff_t(-1) : this->Labels.shell().findCell(neighbourOf(p, n));
      result[n] = other >= 0 && this->Labels.isSurvivor(std::size_t(other)) ? other : std::ptrdiff_t(-1);
    }
    return result;
  }

  bool onSolid(const Neighbours& around) const
  {
    return std::any_of(around.begin(), around.end(),
      [&](std::ptrdiff_t other) { return other >= 0 && !this->isCovered(std::uint32_t(other)); });
  }

  void collect()
  {
    this->All = this->Covered;
    for (const std::uint32_t cell : this->Covered)
    {
      for (const std::ptrdiff_t other : this->neighbours(cell))
      {
        if (other >= 0)
        {
          this->All.push_back(std::uint32_t(other));
        }
      }
    }
    std::sort(this->All.begin(), this->All.end());
    this->All.erase(std::unique(this->All.begin(), this->All.end()), this->All.end());
  }

  const Witness& witness(std::uint32_t cell) const
  {
    return this->Found[std::lower_bound(this->All.begin(), this->All.end(), cell) - this->All.begin()];
  }

  /** Is the ordinary neighbour n deeper than the ordinary neighbours that touch it? One for each part of the solid. */
  bool isDeepest(const Neighbours& around, int n) const
  {
    const double depth = this->witness(std::uint32_t(around[n])).depth;
    for (int m = 0; m < 27; ++m)
    {
      if (m != n && around[m] >= 0 && touch(n, m) && !this->isCovered(std::uint32_t(around[m])))
      {
        const double other = this->witness(std::uint32_t(around[m])).depth;
        if (other > depth || (other == depth && m < n))
        {
          return false;
        }
      }
    }
    return true;
  }

  ThinHull hullOf(std::uint32_t a, bool aOnSolid, std::uint32_t b, bool bOnSolid) const
  {
    const Lattice& lattice = this->Labels.octree().lattice;
    ThinHull hull;
    for (int end = 0; end < 2; ++end)
    {
      const Witness& w = this->witness(end == 0 ? a : b);
      // On the solid's skin the least bump that the promise allows.
      const double least = (end == 0 ? aOnSolid : bOnSolid) ? SkinShare * this->Options.smallestRadius : this->Options.smallestRadius;
      hull.centre[end] = lattice.root.origin + w.place * lattice.leafEdge();
      hull.radius[end] = std::clamp(w.depth, least, this->Options.largestRadius) * lattice.leafEdge();
    }
    return hull;
  }

  static constexpr double SkinShare = 0.25;

  const LatticeLabels& Labels;
  const std::vector<std::uint32_t>& Covered;
  const ThinHullOptions& Options;
  std::vector<std::uint32_t> All; ///< ascending
  std::vector<Witness> Found;     ///< for each of them
};

} // namespace

void checkThinHullOptions(const ThinHullOptions& options)
{
  if (!(options.smallestRadius > 0.0 && options.smallestRadius <= options.largestRadius && options.largestRadius <= 1.0))
  {
    throw InvalidInput("thin hulls of radius " + numberText(options.smallestRadius) + " to " +
      numberText(options.largestRadius) + " octants: both have to be above 0 and at most 1, and in this order");
  }
  requireRange("thin hulls' reach", options.reach, 0.0, 1.0);
}

NearestBall nearestBall(const ThinHull& hull, const Vector3& point)
{
  const Vector3 axis = hull.centre[1] - hull.centre[0];
  const double length = axis.norm(), narrowing = hull.radius[0] - hull.radius[1];
  double t = narrowing >= 0.0 ? 0.0 : 1.0;
  if (length > std::abs(narrowing))
  {
    // The cone's normal leans forward by as much as it narrows.
    const Vector3 unit = axis / length, offset = point - hull.centre[0];
    const double along = offset.dot(unit), across = (offset - along * unit).norm();
    const double lean = narrowing / std::sqrt((length - narrowing) * (length + narrowing));
    t = std::clamp((along - across * lean) / length, 0.0, 1.0);
  }
  NearestBall ball;
  ball.centre = hull.centre[0] + t * axis;
  ball.distance = (point - ball.centre).norm() - (hull.radius[0] - t * narrowing);
  return ball;
}

std::vector<ThinHull> thinHulls(const LatticeLabels& labels, const std::vector<std::uint32_t>& cells,
  const SilhouetteDepth& depth, const ThinHullOptions& options, Execution& execution)
{
  checkThinHullOptions(options);
  const Balls balls(labels, cells, depth, options, execution);
  std::vector<ThinHull> hulls;
  for (const std::uint32_t cell : cells)
  {
    balls.appendHulls(cell, hulls);
  }
  execution.checkpoint(1.0);
  return hulls;
}

} // namespace silhouette
