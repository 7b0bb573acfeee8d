// SPDX-License-Identifier: BSD-3-Clause
#include "TunnelFilling.h"

#include "CodeCursor.h"
#include "Error.h"
#include "NarrowOutside.h"
#include "ParameterRange.h"
#include "PointClusters.h"
#include "SimplePoint.h"
#include "UnionFind.h"
#include "WallOpening.h"
#include "WideOutside.h"

#include <algorithm>
#include <array>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace silhouette
{
namespace
{

constexpr int GreatestWidth = 8;
constexpr std::size_t LooksApart = 4096; ///< points after which growing asks whether it is cancelled

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
  requireRange("tunnel width", options.width, 1, GreatestWidth);
  requireRange("loop length", options.loop, 0.0);
}

/** Parts of the lattice points: narrow ones become taken, all others stay. Those of different points may be changed at the same time. */
class Parts
{
public:
  Parts(const LatticeLabels& labels, int width, Execution& execution)
    : Outside(labels, width, execution)
    , Values(this->Outside.points().size(), Narrow)
  {
  }

  const NarrowOutside& outside() const { return this->Outside; }
  /** Of the narrow points and those taken, which are numbered in lattice order. */
  std::size_t size() const { return this->Values.size(); }
  std::uint64_t code(std::size_t n) const { return this->Outside.points()[n]; }
  Part operator[](std::size_t n) const { return Part(this->Values[n]); }
  void take(std::size_t n) { this->Values[n] = Taken; }
  void giveBack(std::size_t n) { this->Values[n] = Narrow; }

private:
  NarrowOutside Outside;
  std::vector<std::uint8_t> Values;
};

/** Asks about points near one another. For one thread at a time. */
class PartCursor
{
public:
  explicit PartCursor(const Parts& parts)
    : All(parts)
    , Cursor(parts.outside())
  {
  }

  /** Index of a narrow point, or -1; by its Morton code too, where no coordinate is negative. */
  template <typename Point> std::ptrdiff_t find(const Point& p) const
  {
    return this->Cursor.find(p);
  }
  /** The part of any lattice point. */
  template <typename Point> Part at(const Point& p) const
  {
    switch (this->Cursor.at(p))
    {
      case NarrowOutside::Label::Solid:
        return Solid;
      case NarrowOutside::Label::Wide:
        return Wide;
      default:
        return this->All[std::size_t(this->find(p))];
    }
  }

private:
  const Parts& All;
  NarrowCursor Cursor;
};

/** What of the wide outside is connected, with what was taken: looked for when first it is asked for, which on most objects is never. */
class WideSets
{
public:
  WideSets(const LatticeLabels& labels, const Parts& parts, Execution& execution)
    : Labels(labels)
    , All(parts)
    , Near(parts)
    , Run(execution)
  {
  }

  /** How many sets of it a point touches. */
  int touching(const LatticePoint& p)
  {
    this->join();
    std::vector<std::uint32_t> roots;
    for (const int a : EdgeNeighbours)
    {
      const LatticePoint q = neighbourOf(p, a);
      const Part part = this->Near.at(q);
      const std::uint32_t root = part == Wide ? this->Sets->setOf(q)
        : part == Taken                       ? this->Sets->setOf(std::size_t(this->Near.find(q)))
                                              : WideOutside::Nowhere;
      if (root != WideOutside::Nowhere)
      {
        roots.push_back(root);
      }
    }
    std::sort(roots.begin(), roots.end());
    return int(std::unique(roots.begin(), roots.end()) - roots.begin());
  }

  /** Only where it is the calling thread that grows. */
  void stopIfCancelled() { Unannounced(this->Run).checkpoint(1.0); }

  /** A point has been taken. */
  void take(std::size_t n)
  {
    if (this->Sets)
    {
      this->joinTaken(n);
    }
  }

private:
  void join()
  {
    if (this->Sets)
    {
      return;
    }
    this->Sets.emplace(this->Labels, this->All.outside(), this->Run);
    for (std::size_t n = 0; n < this->All.size(); ++n)
    {
      if (this->All[n] == Taken)
      {
        this->joinTaken(n);
      }
    }
  }

  void joinTaken(std::size_t n)
  {
    const LatticePoint p = fromMorton(this->All.code(n));
    for (const int a : EdgeNeighbours)
    {
      const LatticePoint q = neighbourOf(p, a);
      const Part part = this->Near.at(q);
      if (part == Wide)
      {
        this->Sets->join(n, q);
      }
      else if (part == Taken)
      {
        this->Sets->join(n, std::size_t(this->Near.find(q)));
      }
    }
  }

  const LatticeLabels& Labels;
  const Parts& All;
  PartCursor Near;
  Execution& Run;
  std::optional<WideOutside> Sets;
};

/** The narrow points that the wide outside grows into: those that it touches, where that joins no parts of it that are not connected otherwise. */
class Front
{
public:
  /** `supports`: how much speaks for each point's being inside; `waiting`: for each point 0 where it waits in no front. */
  Front(const LatticeLabels& labels, Parts& parts, int width, const std::vector<float>& supports, std::vector<std::uint8_t>& waiting)
    : Labels(labels)
    , Outside(parts)
    , Near(parts)
    , Width(width)
    , Supports(supports)
    , Waiting(waiting)
  {
  }

  void push(std::size_t n)
  {
    if (!std::exchange(this->Waiting[n], std::uint8_t(1)))
    {
      this->Points.emplace(-this->Supports[n], -std::ptrdiff_t(n), n);
    }
  }

  /** Grow, least support first, then the first in lattice order. False where it takes the sets to tell, and these are not given. */
  bool run(WideSets* sets)
  {
    while (!this->Points.empty())
    {
      if (sets && ++this->Looked % LooksApart == 0)
      {
        sets->stopIfCancelled();
      }
      const std::size_t n = std::get<2>(this->Points.top());
      this->Points.pop();
      this->Waiting[n] = 0;
      if (this->Outside[n] != Narrow)
      {
        continue;
      }
      const LatticePoint p = fromMorton(this->Outside.code(n));
      const int parts = this->partsAround(p);
      if (parts > 1 && !sets)
      {
        return false;
      }
      if (parts == 1 || (parts > 1 && sets && sets->touching(p) == parts))
      {
        this->take(n, sets);
      }
    }
    return true;
  }

  /** Take a narrow point, whatever it joins, and grow from there; returns the Morton codes of all that are taken. */
  std::vector<std::uint64_t> open(std::size_t n, WideSets& sets)
  {
    this->Opened.clear();
    this->take(n, &sets);
    this->run(&sets);
    return this->Opened;
  }

  /** Forget whoever waits. */
  void clear()
  {
    for (; !this->Points.empty(); this->Points.pop())
    {
      this->Waiting[std::get<2>(this->Points.top())] = 0;
    }
  }

private:
  void take(std::size_t n, WideSets* sets)
  {
    this->Outside.take(n);
    this->Opened.push_back(this->Outside.code(n));
    const CodesAround codes(fromMorton(this->Outside.code(n))); // what is near the border beneath is wide
    for (int a = 0; a < 27; ++a)
    {
      const std::ptrdiff_t other = this->Near.find(codes[a]);
      if (other >= 0 && this->Outside[std::size_t(other)] == Narrow)
      {
        this->push(std::size_t(other));
      }
    }
    if (sets)
    {
      sets->take(n);
    }
  }

  /** Parts of the wide outside that a point touches; 0 where these are connected nearby. */
  int partsAround(const LatticePoint& p) const
  {
    Neighbourhood labels;
    const CodesAround codes(p); // what is near the border beneath is wide
    for (int a = 0; a < 27; ++a)
    {
      labels[std::size_t(a)] = a != 13 && !isWide(this->Near.at(codes[a]));
    }
    const int touching = topologicalNumbers(labels).outside;
    return touching > 1 && this->partsNearby(p) < touching ? 0 : touching;
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
      wide[std::size_t(n)] = ofLattice && !(q == p) && isWide(this->Near.at(q));
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

  const LatticeLabels& Labels;
  Parts& Outside;
  PartCursor Near;
  int Width;
  const std::vector<float>& Supports;
  std::vector<std::uint8_t>& Waiting;
  std::priority_queue<std::tuple<float, std::ptrdiff_t, std::size_t>> Points;
  std::size_t Looked = 0;            ///< points that have been looked at
  std::vector<std::uint64_t> Opened; ///< taken since the last opening began
};

class Growth
{
public:
  Growth(const LatticeLabels& labels, Parts& parts, int width, Execution& execution)
    : Labels(labels)
    , Outside(parts)
    , Near(parts)
    , Width(width)
    , Run(execution)
    , Supports(parts.size())
    , Waiting(parts.size(), 0)
    , All(labels, parts, width, this->Supports, this->Waiting)
    , Sets(labels, parts, execution)
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
  }

  /**
   * Points far from one another are grown into side by side, where it takes none of the sets to tell: then the wide outside grows, but is connected as
   * before, and it does not matter to the others when that comes.
   */
  void run()
  {
    const PointClusters clusters = clustersOf(this->Outside.outside().points(), this->Run);
    std::vector<std::uint8_t> isGrown(clusters.size(), 0);
    this->Run.forRanges(clusters.size(), 64,
      [&](std::size_t first, std::size_t last)
      {
        Front front(this->Labels, this->Outside, this->Width, this->Supports, this->Waiting);
        for (std::size_t cluster = first; cluster < last; ++cluster)
        {
          std::for_each(clusters.begin(cluster), clusters.end(cluster), [&](std::uint32_t n) { front.push(n); });
          isGrown[cluster] = front.run(nullptr);
          front.clear();
        }
      });
    for (std::size_t cluster = 0; cluster < clusters.size(); ++cluster)
    {
      if (isGrown[cluster] == 0)
      {
        std::for_each(clusters.begin(cluster), clusters.end(cluster), [&](std::uint32_t n) { this->Outside.giveBack(n); });
        std::for_each(clusters.begin(cluster), clusters.end(cluster), [&](std::uint32_t n) { this->All.push(n); });
      }
    }
    this->All.run(&this->Sets);
  }

  /** What is left of the narrow points, as walls none of which is too long. */
  std::vector<std::vector<std::uint64_t>> walls(double longest)
  {
    std::vector<std::uint64_t> points;
    std::vector<float> supports;
    for (std::size_t n = 0; n < this->Outside.size(); ++n)
    {
      if (this->Outside[n] == Narrow)
      {
        points.push_back(this->Outside.code(n));
        supports.push_back(this->Supports[n]);
      }
    }
    const auto open = [&](std::uint64_t point) { return this->All.open(std::size_t(this->Near.find(point)), this->Sets); };
    return openLongWalls(points, supports, longest, open, this->Run).walls;
  }

private:
  const LatticeLabels& Labels;
  Parts& Outside;
  PartCursor Near;
  int Width;
  Execution& Run;
  std::vector<float> Supports;        ///< how much speaks for each point's being inside
  std::vector<std::uint8_t> Waiting;  ///< 1 for the points that a front holds
  Front All;
  WideSets Sets;
};

/** By how much the solid's Euler number rises where a wall is added to it: by 1 for each tunnel that it closes. */
int eulerRise(const std::vector<std::uint64_t>& wall, const Parts& parts)
{
  std::vector<std::uint64_t> added;
  const PartCursor near(parts);
  int rise = 0;
  for (const std::uint64_t code : wall)
  {
    Neighbourhood around;
    for (int a = 0; a < 27; ++a)
    {
      const LatticePoint p = neighbourOf(fromMorton(code), a);
      around[a] = near.at(p) == Solid || std::binary_search(added.begin(), added.end(), mortonCode(p));
    }
    rise += eulerChange(around);
    added.push_back(code);
  }
  return rise;
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
  Phase opening(execution, 0.8, 1.0);
  Growth growth(labels, parts, options.width, opening);
  growth.run();
  std::vector<std::uint64_t> points;
  for (const auto& wall : growth.walls(options.loop * labels.octree().lattice.cells()))
  {
    // In a thicket of debris what is left may be no wall.
    if (eulerRise(wall, parts) > 0)
    {
      points.insert(points.end(), wall.begin(), wall.end());
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

} // namespace silhouette
