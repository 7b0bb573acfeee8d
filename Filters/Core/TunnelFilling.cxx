// SPDX-License-Identifier: BSD-3-Clause
#include "TunnelFilling.h"

#include "CodeCursor.h"
#include "Error.h"
#include "NarrowOutside.h"
#include "SimplePoint.h"
#include "UnionFind.h"
#include "WideOutside.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace silhouette
{
namespace
{

constexpr int GreatestWidth = 8;

enum Part : std::uint8_t
{
  Solid,
  Narrow, ///< outside, not yet taken by the wide outside
  Wide,   ///< the wide outside
  Taken   ///< was narrow, and was taken by the wide outside
};

bool isWide(Part part)
{
  return part >= Wide;
}

void check(const TunnelFillingOptions& options)
{
  if (options.width < 1 || options.width > GreatestWidth)
  {
    throw InvalidInput("tunnel width " + std::to_string(options.width) + " octants is outside 1 to 8");
  }
  if (!(options.loop >= 0.0))
  {
    throw InvalidInput("tunnel loop " + std::to_string(options.loop) + " of the lattice's side: at least 0 is needed");
  }
}

/** Parts of the lattice points: narrow ones become taken, all others stay. For one thread at a time. */
class Parts
{
public:
  Parts(const Parts&) = delete; // the cursor is this one's
  Parts& operator=(const Parts&) = delete;

  Parts(const LatticeLabels& labels, int width, Execution& execution)
    : Outside(labels, width, execution)
    , Cursor(this->Outside)
    , Values(this->Outside.points().size(), Narrow)
  {
  }

  const NarrowOutside& outside() const { return this->Outside; }
  /** Of the narrow points and those taken, which are numbered in lattice order. */
  std::size_t size() const { return this->Values.size(); }
  std::uint64_t code(std::size_t n) const { return this->Outside.points()[n]; }
  Part operator[](std::size_t n) const { return Part(this->Values[n]); }
  void take(std::size_t n) { this->Values[n] = Taken; }
  std::ptrdiff_t find(const LatticePoint& p) const { return this->Cursor.find(p); }
  /** The part of any lattice point. */
  Part at(const LatticePoint& p) const
  {
    switch (this->Cursor.at(p))
    {
      case NarrowOutside::Label::Solid:
        return Solid;
      case NarrowOutside::Label::Wide:
        return Wide;
      default:
        return (*this)[std::size_t(this->find(p))];
    }
  }

private:
  NarrowOutside Outside;
  NarrowCursor Cursor;
  std::vector<std::uint8_t> Values;
};

class Growth
{
public:
  Growth(const LatticeLabels& labels, Parts& parts, int width, Execution& execution)
    : Labels(labels)
    , Outside(parts)
    , Width(width)
    , Run(execution)
    , Supports(parts.size())
    , IsInFront(parts.size(), 0)
  {
    execution.forRanges(parts.size(), 1024,
      [&](std::size_t first, std::size_t last)
      {
        CodeCursor shell(labels.shell().corners);
        for (std::size_t n = first; n < last; ++n)
        {
          const std::ptrdiff_t corner = shell.find(parts.code(n));
          this->Supports[n] = corner >= 0 ? labels.support()[std::size_t(corner)] : -1e30f;
        }
      });
    for (std::size_t n = 0; n < parts.size(); ++n)
    {
      if (parts[n] == Narrow)
      {
        this->Remaining.push_back(n);
        this->push(n);
      }
    }
  }

  void run()
  {
    while (!this->Front.empty())
    {
      const std::size_t n = std::get<2>(this->Front.top());
      this->Front.pop();
      this->IsInFront[n] = 0;
      if (this->Outside[n] == Narrow && this->mayTake(n))
      {
        this->take(n);
      }
    }
    const auto taken = [&](std::size_t n) { return this->Outside[n] != Narrow; };
    this->Remaining.erase(std::remove_if(this->Remaining.begin(), this->Remaining.end(), taken), this->Remaining.end());
  }

  /** Groups of remaining points, 26-neighbours being together, each ascending. */
  std::vector<std::vector<std::size_t>> walls()
  {
    UnionFind sets(this->Remaining.size());
    for (std::size_t r = 0; r < this->Remaining.size(); ++r)
    {
      const LatticePoint p = fromMorton(this->Outside.code(this->Remaining[r]));
      for (int n = 0; n < 27; ++n)
      {
        const std::ptrdiff_t other = this->Outside.find(neighbourOf(p, n));
        const auto at = std::lower_bound(this->Remaining.begin(), this->Remaining.end(), std::size_t(std::max<std::ptrdiff_t>(other, 0)));
        if (other >= 0 && at != this->Remaining.end() && *at == std::size_t(other))
        {
          sets.unite(std::uint32_t(r), std::uint32_t(at - this->Remaining.begin()));
        }
      }
    }
    std::vector<std::vector<std::size_t>> groups(this->Remaining.size());
    for (std::size_t r = 0; r < this->Remaining.size(); ++r)
    {
      groups[sets.find(std::uint32_t(r))].push_back(this->Remaining[r]);
    }
    groups.erase(std::remove_if(groups.begin(), groups.end(), [](const auto& g) { return g.empty(); }), groups.end());
    return groups;
  }

  /** Open a wall where least speaks for it, and go on. */
  void open(const std::vector<std::size_t>& wall)
  {
    const auto weaker = [&](std::size_t a, std::size_t b) { return this->Supports[a] < this->Supports[b]; };
    this->take(*std::min_element(wall.begin(), wall.end(), weaker));
    this->run();
  }

private:
  /** This is done when first it is asked for, which on most objects is never. */
  void joinWide()
  {
    this->Sets.emplace(this->Labels, this->Outside.outside(), this->Run);
    for (std::size_t n = 0; n < this->Outside.size(); ++n)
    {
      if (this->Outside[n] == Taken)
      {
        this->joinTaken(n);
      }
    }
  }

  void joinTaken(std::size_t n)
  {
    const LatticePoint p = fromMorton(this->Outside.code(n));
    for (const int a : EdgeNeighbours)
    {
      const LatticePoint q = neighbourOf(p, a);
      const Part part = this->Outside.at(q);
      if (part == Wide)
      {
        this->Sets->join(n, q);
      }
      else if (part == Taken)
      {
        this->Sets->join(n, std::size_t(this->Outside.find(q)));
      }
    }
  }

  void push(std::size_t n)
  {
    if (!std::exchange(this->IsInFront[n], std::uint8_t(1)))
    {
      this->Front.emplace(-this->Supports[n], -std::ptrdiff_t(n), n);
    }
  }

  /** Into how many parts the wide outside beside a point falls, if no way but through the points within two octants counts. */
  int partsNearby(const LatticePoint& p) const
  {
    const int reach = std::min(this->Width, 2), side = 2 * reach + 1, count = side * side * side;
    const auto pointAt = [&](int n) { return p + LatticePoint{ n % side - reach, n / side % side - reach, n / side / side - reach }; };
    std::array<bool, 125> wide{};
    UnionFind sets(std::size_t{ 125 });
    for (int n = 0; n < count; ++n)
    {
      const LatticePoint q = pointAt(n);
      const int cells = this->Labels.octree().lattice.cells();
      const bool ofLattice = std::min({ q.i, q.j, q.k }) >= 0 && std::max({ q.i, q.j, q.k }) <= cells;
      wide[std::size_t(n)] = ofLattice && !(q == p) && isWide(this->Outside.at(q));
      const int steps[3] = { 1, side, side * side }, coordinates[3] = { n % side, n / side % side, n / side / side };
      for (int axis = 0; axis < 3; ++axis)
      {
        if (coordinates[axis] > 0 && wide[std::size_t(n)] && wide[std::size_t(n - steps[axis])])
        {
          sets.unite(std::uint32_t(n), std::uint32_t(n - steps[axis]));
        }
      }
    }
    std::vector<std::uint32_t> roots;
    const int centre = count / 2;
    for (const int step : { -1, 1, -side, side, -side * side, side * side })
    {
      if (wide[std::size_t(centre + step)])
      {
        roots.push_back(sets.find(std::uint32_t(centre + step)));
      }
    }
    std::sort(roots.begin(), roots.end());
    return int(std::unique(roots.begin(), roots.end()) - roots.begin());
  }

  /** Does the outside touch the point, and with parts that are not connected otherwise? */
  bool mayTake(std::size_t n)
  {
    const LatticePoint p = fromMorton(this->Outside.code(n));
    Neighbourhood labels;
    for (int a = 0; a < 27; ++a)
    {
      labels[a] = a != 13 && !isWide(this->Outside.at(neighbourOf(p, a)));
    }
    const int touching = topologicalNumbers(labels).outside;
    if (touching <= 1)
    {
      return touching == 1;
    }
    if (this->partsNearby(p) < touching)
    {
      return false;
    }
    if (!this->Sets)
    {
      this->joinWide();
    }
    std::vector<std::uint32_t> roots;
    for (const int a : EdgeNeighbours)
    {
      const LatticePoint q = neighbourOf(p, a);
      const Part part = this->Outside.at(q);
      const std::uint32_t root = part == Wide ? this->Sets->setOf(q)
        : part == Taken                       ? this->Sets->setOf(std::size_t(this->Outside.find(q)))
                                              : WideOutside::Nowhere;
      if (root != WideOutside::Nowhere)
      {
        roots.push_back(root);
      }
    }
    std::sort(roots.begin(), roots.end());
    return std::unique(roots.begin(), roots.end()) - roots.begin() == touching;
  }

  void take(std::size_t n)
  {
    this->Outside.take(n);
    const LatticePoint p = fromMorton(this->Outside.code(n));
    for (int a = 0; a < 27; ++a)
    {
      const std::ptrdiff_t other = this->Outside.find(neighbourOf(p, a));
      if (other >= 0 && this->Outside[other] == Narrow)
      {
        this->push(std::size_t(other));
      }
    }
    if (this->Sets)
    {
      this->joinTaken(n);
    }
  }

  const LatticeLabels& Labels;
  Parts& Outside;
  int Width;
  Execution& Run;
  std::optional<WideOutside> Sets; ///< what of the wide outside is connected; nothing until it is asked for
  std::vector<std::size_t> Remaining;
  std::vector<float> Supports; ///< how much speaks for each point's being inside
  /** Least support first, then the first in lattice order. */
  std::priority_queue<std::tuple<float, std::ptrdiff_t, std::size_t>> Front;
  std::vector<std::uint8_t> IsInFront;
};

/** By how much the solid's Euler number rises where a wall is added to it: by 1 for each tunnel that it closes. */
int eulerRise(const std::vector<std::size_t>& wall, const Parts& parts)
{
  std::vector<std::uint64_t> added;
  int rise = 0;
  for (const std::size_t n : wall)
  {
    Neighbourhood around;
    for (int a = 0; a < 27; ++a)
    {
      const LatticePoint p = neighbourOf(fromMorton(parts.code(n)), a);
      around[a] = parts.at(p) == Solid || std::binary_search(added.begin(), added.end(), mortonCode(p));
    }
    rise += eulerChange(around);
    added.insert(std::lower_bound(added.begin(), added.end(), parts.code(n)), parts.code(n));
  }
  return rise;
}

/**
 * Octants along the outline of a wall: that of a rectangle with the two longest sides of its box, and the solid
 * around it.
 */
double outline(const std::vector<std::size_t>& wall, const Parts& parts)
{
  LatticePoint low = fromMorton(parts.code(wall.front())), high = low;
  for (const std::size_t n : wall)
  {
    const LatticePoint p = fromMorton(parts.code(n));
    low = { std::min(low.i, p.i), std::min(low.j, p.j), std::min(low.k, p.k) };
    high = { std::max(high.i, p.i), std::max(high.j, p.j), std::max(high.k, p.k) };
  }
  std::array<int, 3> sides = { high.i - low.i, high.j - low.j, high.k - low.k };
  std::sort(sides.begin(), sides.end());
  return 2.0 * (sides[1] + sides[2]) + 8.0;
}

} // namespace

std::vector<std::uint64_t> tunnelWalls(const LatticeLabels& labels, const TunnelFillingOptions& options, Execution& execution)
{
  check(options);
  if (!options.fillTunnels || options.loop == 0.0)
  {
    return {};
  }
  Phase looking(execution, 0.0, 0.8);
  Parts parts(labels, options.width, looking);
  Growth growth(labels, parts, options.width, execution);
  growth.run();
  const double longest = options.loop * labels.octree().lattice.cells();
  std::vector<std::uint64_t> points;
  for (bool settled = false; !settled;)
  {
    execution.checkpoint(0.9);
    settled = true;
    points.clear();
    for (const auto& wall : growth.walls())
    {
      if (outline(wall, parts) > longest)
      {
        growth.open(wall);
        settled = false;
      }
      // In a thicket of debris what is left may be no wall.
      if (eulerRise(wall, parts) > 0)
      {
        std::transform(
          wall.begin(), wall.end(), std::back_inserter(points), [&](std::size_t n) { return parts.code(n); });
      }
    }
  }
  std::sort(points.begin(), points.end());
  execution.checkpoint(1.0);
  return points;
}

} // namespace silhouette
