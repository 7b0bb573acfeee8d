// SPDX-License-Identifier: BSD-3-Clause
#include "TunnelFilling.h"

#include "Error.h"
#include "LatticeRegions.h"
#include "SimplePoint.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <queue>
#include <tuple>

namespace silhouette
{
namespace
{

constexpr int GreatestWidth = 8;
constexpr int Side = BrickField::BrickSize;

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

/** Cells of the shell with corners of both labels. */
std::vector<std::uint64_t> mixedCells(const LatticeLabels& labels)
{
  std::vector<std::uint64_t> cells;
  for (std::size_t cell = 0; cell < labels.shell().cells.size(); ++cell)
  {
    int inside = 0;
    for (const std::uint32_t corner : labels.shell().cellCorners[cell])
    {
      inside += labels.inside()[corner];
    }
    if (inside > 0 && inside < 8)
    {
      cells.push_back(labels.shell().cells[cell]);
    }
  }
  return cells;
}

/** A bit for each point of a brick: i + 8 j of the word k. */
using Planes = std::array<std::uint64_t, Side>;

/** The points of a brick, in Morton order, that are not of one part. */
Planes planesOf(const std::uint8_t* parts, Part part)
{
  Planes planes{};
  for (std::uint64_t n = 0; n < BrickField::BrickPoints; ++n)
  {
    const LatticePoint p = fromMorton(n);
    planes[p.k] |= std::uint64_t(parts[n] != part) << (p.i + Side * p.j);
  }
  return planes;
}

/** The brick that begins `step` points, 0 to 8, ahead of `low` along an axis; `high` is the brick after it. */
Planes shifted(const Planes& low, const Planes& high, int axis, int step)
{
  if (step == 0 || step == Side)
  {
    return step == 0 ? low : high;
  }
  Planes result;
  const std::uint64_t kept = 0x0101010101010101ULL * (0xffu >> step); // of each row, what comes from `low`
  for (int k = 0; k < Side; ++k)
  {
    if (axis == 0)
    {
      result[k] = (low[k] >> step & kept) | (high[k] << (Side - step) & ~kept);
    }
    else if (axis == 1)
    {
      result[k] = low[k] >> Side * step | high[k] << Side * (Side - step);
    }
    else
    {
      result[k] = k + step < Side ? low[k + step] : high[k + step - Side];
    }
  }
  return result;
}

/** Parts of the lattice points in bricks around the surface. */
class Parts
{
public:
  Parts(const LatticeLabels& labels, int width, Execution& execution)
    : Labels(labels)
    , Bricks(labels.octree().lattice, mixedCells(labels), 2 * width)
    , Values(Bricks.size(), Wide)
    , Cursor(Bricks)
  {
    this->label(execution);
    execution.checkpoint(0.4);
    this->openByCubes(width, execution);
    execution.checkpoint(0.8);
  }

  std::size_t size() const { return this->Values.size(); }
  std::uint64_t code(std::size_t n) const { return this->Bricks.code(n); }
  Part operator[](std::size_t n) const { return Part(this->Values[n]); }
  void take(std::size_t n) { this->Values[n] = Taken; }
  std::ptrdiff_t find(const LatticePoint& p)
  {
    return std::min({ p.i, p.j, p.k }) < 0 ? -1 : this->Cursor.find(mortonCode(p));
  }
  /** The part of any lattice point. */
  Part at(const LatticePoint& p)
  {
    const std::ptrdiff_t n = this->find(p);
    return n >= 0 ? (*this)[n] : this->Labels.insideAt(p) ? Solid : Wide;
  }

private:
  void label(Execution& execution)
  {
    execution.forRanges(this->Bricks.bricks().size(), 8,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t brick = first; brick < last; ++brick)
        {
          std::uint8_t* const values = &this->Values[brick * BrickField::BrickPoints];
          this->Labels.insideOf(this->Bricks.code(brick * BrickField::BrickPoints), BrickField::BrickPoints, values);
          std::transform(values, values + BrickField::BrickPoints, values,
            [](std::uint8_t inside) { return std::uint8_t(inside != 0 ? Solid : Wide); });
        }
      });
  }

  /**
   * Where no cube of outside points fits, the outside is narrow. Beyond the bricks everything is taken for
   * outside.
   */
  void openByCubes(int width, Execution& execution)
  {
    const std::size_t count = this->Bricks.bricks().size();
    std::vector<Planes> fits(count);
    execution.forRanges(count, 64,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t brick = first; brick < last; ++brick)
        {
          fits[brick] = planesOf(&this->Values[brick * BrickField::BrickPoints], Solid);
        }
      });
    for (int axis = 0; axis < 3; ++axis)
    {
      this->combineAlong(axis, width, true, fits, execution); // from here on, a cube fits
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->combineAlong(axis, width, false, fits, execution); // a cube that fits holds this point
    }
    execution.forRanges(count, 64,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first * BrickField::BrickPoints; n < last * BrickField::BrickPoints; ++n)
        {
          const LatticePoint p = fromMorton(n % BrickField::BrickPoints);
          const bool wide = fits[n / BrickField::BrickPoints][p.k] >> (p.i + Side * p.j) & 1;
          this->Values[n] = this->Values[n] == Solid ? Solid : wide ? Wide : Narrow;
        }
      });
  }

  /** All of the `width` + 1 points ahead, or any of those behind. */
  void combineAlong(int axis, int width, bool all, std::vector<Planes>& values, Execution& execution) const
  {
    std::vector<Planes> result(values.size());
    execution.forRanges(values.size(), 64,
      [&](std::size_t first, std::size_t last)
      {
        Planes outside;
        outside.fill(~std::uint64_t(0));
        for (std::size_t brick = first; brick < last; ++brick)
        {
          LatticePoint q = fromMorton(this->Bricks.bricks()[brick]);
          (axis == 0 ? q.i : axis == 1 ? q.j : q.k) += all ? 1 : -1;
          const std::ptrdiff_t beside = std::min({ q.i, q.j, q.k }) < 0 ? -1 : this->Bricks.findBrick(mortonCode(q));
          const Planes& other = beside < 0 ? outside : values[std::size_t(beside)];
          result[brick] = values[brick];
          for (int step = 1; step <= width; ++step)
          {
            const Planes moved = all ? shifted(values[brick], other, axis, step)
                                     : shifted(other, values[brick], axis, Side - step);
            for (int k = 0; k < Side; ++k)
            {
              result[brick][k] = all ? result[brick][k] & moved[k] : result[brick][k] | moved[k];
            }
          }
        }
      });
    values.swap(result);
  }

  const LatticeLabels& Labels;
  BrickField Bricks;
  std::vector<std::uint8_t> Values;
  BrickCursor Cursor;
};

class Growth
{
public:
  Growth(const LatticeLabels& labels, Parts& parts, int width)
    : Labels(labels)
    , Outside(parts)
    , Width(width)
  {
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
    const auto weaker = [&](std::size_t a, std::size_t b) { return this->support(a) < this->support(b); };
    this->take(*std::min_element(wall.begin(), wall.end(), weaker));
    this->run();
  }

private:
  /**
   * Points of the wide outside are joined along lattice edges and through the background octants around them.
   * This is done when first it is asked for, which on most objects is never.
   */
  void joinWide()
  {
    const Octree& octree = this->Labels.octree();
    LatticeRegions regions = connectWideOutside(this->Labels, this->Width);
    this->Sets = UnionFind(this->Outside.size() + regions.sets.size());
    const std::uint32_t octants = std::uint32_t(this->Outside.size());
    OctantCursor cursor(octree);
    for (std::uint32_t n = 0; n < octants; ++n)
    {
      if (!isWide(this->Outside[n]))
      {
        continue;
      }
      const LatticePoint p = fromMorton(this->Outside.code(n));
      for (const int a : { 14, 16, 22 })
      {
        const std::ptrdiff_t other = this->Outside.find(neighbourOf(p, a));
        if (other >= 0 && isWide(this->Outside[other]))
        {
          this->Sets.unite(n, std::uint32_t(other));
        }
      }
      if (this->Outside[n] == Taken)
      {
        continue;
      }
      if (!octree.lattice.hasCell(p) || octree.lattice.onBorder(p))
      {
        this->Sets.unite(n, octants + regions.beyond);
        continue;
      }
      const auto location = cursor.locate(p);
      if (location.generation >= 0 && location.state == OctantState::Background &&
        octree.lattice.cells() >> location.generation >= this->Width)
      {
        this->Sets.unite(n, octants + regions.octant(location.generation, location.index));
      }
    }
    for (std::uint32_t r = 0; r < regions.sets.size(); ++r)
    {
      this->Sets.unite(octants + r, octants + regions.sets.find(r));
    }
  }

  float support(std::size_t n) const
  {
    const std::ptrdiff_t corner = this->Labels.shell().find(this->Outside.code(n));
    return corner >= 0 ? this->Labels.support()[corner] : -1e30f;
  }

  void push(std::size_t n) { this->Front.emplace(-this->support(n), -std::ptrdiff_t(n), n); }

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
    if (this->Sets.size() == 0)
    {
      this->joinWide();
    }
    std::vector<std::uint32_t> roots;
    for (const int a : EdgeNeighbours)
    {
      const std::ptrdiff_t other = this->Outside.find(neighbourOf(p, a));
      if (other >= 0 && isWide(this->Outside[other]))
      {
        roots.push_back(this->Sets.find(std::uint32_t(other)));
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
      else if (this->Sets.size() > 0 && other >= 0 && isWide(this->Outside[other]) &&
        std::find(EdgeNeighbours, EdgeNeighbours + 6, a) != EdgeNeighbours + 6)
      {
        this->Sets.unite(std::uint32_t(n), std::uint32_t(other));
      }
    }
  }

  const LatticeLabels& Labels;
  Parts& Outside;
  int Width;
  UnionFind Sets; ///< of the wide outside's points, then the octants; empty until it is asked for
  std::vector<std::size_t> Remaining;
  /** Least support first, then the first in lattice order. */
  std::priority_queue<std::tuple<float, std::ptrdiff_t, std::size_t>> Front;
};

/** By how much the solid's Euler number rises where a wall is added to it: by 1 for each tunnel that it closes. */
int eulerRise(const std::vector<std::size_t>& wall, Parts& parts)
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
double outline(const std::vector<std::size_t>& wall, Parts& parts)
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
  Parts parts(labels, options.width, execution);
  Growth growth(labels, parts, options.width);
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
