// SPDX-License-Identifier: BSD-3-Clause
#include "WallOpening.h"

#include "CodeCursor.h"
#include "Lattice.h"
#include "PointComponents.h"
#include "UnionFind.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace silhouette
{
namespace
{

using Numbers = std::vector<std::uint32_t>; ///< of points, by their places among all

using Coordinates = std::array<int, 3>;

Coordinates coordinatesOf(std::uint64_t code)
{
  const LatticePoint p = fromMorton(code);
  return { p.i, p.j, p.k };
}

struct Box
{
  Coordinates low, high;

  explicit Box(const std::vector<std::uint64_t>& points)
    : low(coordinatesOf(points.front()))
    , high(low)
  {
    for (const std::uint64_t code : points)
    {
      const Coordinates p = coordinatesOf(code);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        this->low[axis] = std::min(this->low[axis], p[axis]);
        this->high[axis] = std::max(this->high[axis], p[axis]);
      }
    }
  }

  /** Octants. */
  double outline() const
  {
    Coordinates sides = { this->high[0] - this->low[0], this->high[1] - this->low[1], this->high[2] - this->low[2] };
    std::sort(sides.begin(), sides.end());
    return 2.0 * (sides[1] + sides[2]) + 8.0;
  }
};

/** The box around points that leave one by one: it knows how many there are in each slice, and need not look at the others again. */
class ShrinkingBox
{
public:
  explicit ShrinkingBox(const std::vector<std::uint64_t>& points)
    : Around(points)
    , Begin(Around.low)
    , Left(points.size())
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Slices[axis].assign(std::size_t(this->Around.high[axis] - this->Begin[axis] + 1), 0);
    }
    for (const std::uint64_t code : points)
    {
      const Coordinates p = coordinatesOf(code);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        ++this->Slices[axis][std::size_t(p[axis] - this->Begin[axis])];
      }
    }
  }

  void remove(std::uint64_t code)
  {
    --this->Left;
    const Coordinates p = coordinatesOf(code);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      --this->Slices[axis][std::size_t(p[axis] - this->Begin[axis])];
      while (this->Left > 0 && this->isEmpty(axis, this->Around.low[axis]))
      {
        ++this->Around.low[axis];
      }
      while (this->Left > 0 && this->isEmpty(axis, this->Around.high[axis]))
      {
        --this->Around.high[axis];
      }
    }
  }

  std::size_t size() const { return this->Left; } ///< points
  double outline() const { return this->Around.outline(); }

private:
  bool isEmpty(std::size_t axis, int coordinate) const { return this->Slices[axis][std::size_t(coordinate - this->Begin[axis])] == 0; }

  Box Around;
  Coordinates Begin;
  std::array<Numbers, 3> Slices; ///< along each axis, how many points lie in each slice from Begin on
  std::size_t Left;
};

/** A wall that is too long. Points that have left it stay in its lists until they are come upon. */
struct LongWall
{
  ShrinkingBox box;
  Numbers byPlace;              ///< in lattice order
  Numbers bySupport;            ///< least first
  std::size_t firstByPlace = 0; ///< what is before has left
  std::size_t firstBySupport = 0;
};

/** What is on one side of an opening. */
struct Side
{
  Numbers searched;
  Numbers found; ///< from `next` on to be searched
  std::size_t next = 0;

  std::size_t size() const { return this->searched.size() + this->found.size() - this->next; }

  bool isEnded() const { return this->next == this->found.size(); }

  /** Linear in the smaller one. */
  void join(Side& other)
  {
    if (this->size() < other.size())
    {
      std::swap(*this, other);
    }
    this->searched.insert(this->searched.end(), other.searched.begin(), other.searched.end());
    this->found.insert(this->found.end(), other.found.begin() + std::ptrdiff_t(other.next), other.found.end());
    other = Side();
  }
};

class Walls
{
public:
  Walls(const std::vector<std::uint64_t>& points, const std::vector<float>& supports, double longest)
    : Points(points)
    , Supports(supports)
    , Longest(longest)
    , Near(points)
    , WallOf(points.size(), Settled)
    , SideOf(points.size(), 0)
  {
    for (const PointComponent& wall : pointComponents(wordsOf(points), {}, Steps::Corners, 1))
    {
      this->add(codesOf(wall.words));
    }
  }

  /** Long walls, that are to be opened in this round, in the order of their first points. */
  Numbers nextRound()
  {
    Numbers walls;
    walls.swap(this->Next);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> byFirst;
    for (const std::uint32_t wall : walls)
    {
      LongWall& own = this->Long[wall];
      byFirst.emplace_back(this->firstOf(own.byPlace, own.firstByPlace, wall), wall);
    }
    std::sort(byFirst.begin(), byFirst.end());
    std::transform(byFirst.begin(), byFirst.end(), walls.begin(), [](const auto& entry) { return entry.second; });
    return walls;
  }

  std::uint64_t weakestOf(std::uint32_t wall)
  {
    LongWall& own = this->Long[wall];
    return this->Points[this->firstOf(own.bySupport, own.firstBySupport, wall)];
  }

  /** Points of a wall have been taken: what is left of it, settled or kept for the next round. */
  void take(std::uint32_t wall, const std::vector<std::uint64_t>& taken)
  {
    for (const std::uint64_t code : taken)
    {
      this->WallOf[std::size_t(this->Near.find(code))] = Settled;
      this->Long[wall].box.remove(code);
    }
    this->divide(wall, this->sidesAround(wall, taken));
    LongWall& own = this->Long[wall];
    if (own.box.size() > 0 && own.box.outline() > this->Longest)
    {
      this->Next.push_back(wall);
      return;
    }
    std::vector<std::uint64_t> left;
    for (const std::uint32_t n : own.byPlace)
    {
      if (this->WallOf[n] == wall)
      {
        left.push_back(this->Points[n]);
      }
    }
    if (!left.empty())
    {
      this->Remaining.walls.push_back(std::move(left));
    }
    own.byPlace = own.bySupport = Numbers();
  }

  RemainingWalls remaining() { return std::move(this->Remaining); }

private:
  static constexpr std::uint32_t Settled = ~std::uint32_t(0);

  /** A wall by itself: ascending. */
  void add(std::vector<std::uint64_t> wall)
  {
    if (Box(wall).outline() <= this->Longest)
    {
      for (const std::uint64_t code : wall)
      {
        this->WallOf[std::size_t(this->Near.find(code))] = Settled;
      }
      this->Remaining.walls.push_back(std::move(wall));
      return;
    }
    LongWall added{ ShrinkingBox(wall), {}, {} };
    const std::uint32_t number = std::uint32_t(this->Long.size());
    for (const std::uint64_t code : wall)
    {
      added.byPlace.push_back(std::uint32_t(this->Near.find(code)));
      this->WallOf[added.byPlace.back()] = number;
    }
    added.bySupport = added.byPlace;
    std::stable_sort(added.bySupport.begin(), added.bySupport.end(),
      [&](std::uint32_t a, std::uint32_t b) { return this->Supports[a] < this->Supports[b]; });
    this->Long.push_back(std::move(added));
    this->Next.push_back(number);
  }

  /** The first of a wall's points in one of its lists, from which those before are passed over from now on. */
  std::uint32_t firstOf(const Numbers& points, std::size_t& first, std::uint32_t wall) const
  {
    while (this->WallOf[points[first]] != wall)
    {
      ++first;
    }
    return points[first];
  }

  /** Each point of a wall that is left beside those taken, a side of its own so far. */
  std::vector<Side> sidesAround(std::uint32_t wall, const std::vector<std::uint64_t>& taken)
  {
    std::vector<Side> sides;
    this->FirstSide = this->LastSide + 1;
    for (const std::uint64_t code : taken)
    {
      const CodesAround codes(fromMorton(code));
      for (int a = 0; a < 27; ++a)
      {
        const std::ptrdiff_t n = this->Near.find(codes[a]);
        if (n >= 0 && this->WallOf[std::size_t(n)] == wall && this->SideOf[std::size_t(n)] < this->FirstSide)
        {
          this->SideOf[std::size_t(n)] = ++this->LastSide;
          sides.emplace_back().found.push_back(std::uint32_t(n));
        }
      }
    }
    return sides;
  }

  /** Search the sides in turns; those that end are walls of their own, and the last one is what the wall is from now on. */
  void divide(std::uint32_t wall, std::vector<Side> sides)
  {
    UnionFind sets(sides.size());
    Numbers going(sides.size());
    std::iota(going.begin(), going.end(), std::uint32_t(0));
    std::size_t left = sides.size();
    while (left > 1)
    {
      for (std::uint32_t& side : going)
      {
        if (left == 1 || sets.find(side) != side)
        {
          continue;
        }
        if (sides[side].isEnded())
        {
          this->split(wall, std::move(sides[side]));
          side = Settled;
          --left;
        }
        else
        {
          left -= this->search(side, sides, sets);
        }
      }
      const auto isOver = [&](std::uint32_t side) { return side == Settled || sets.find(side) != side; };
      going.erase(std::remove_if(going.begin(), going.end(), isOver), going.end());
    }
  }

  /** The neighbours of the next point of a side; returns how many other sides it has met, which are one with it from now on. */
  std::size_t search(std::uint32_t side, std::vector<Side>& sides, UnionFind& sets)
  {
    ++this->Remaining.searched;
    Side& start = sides[side];
    const std::uint32_t n = start.found[start.next++];
    start.searched.push_back(n);
    std::size_t met = 0;
    const CodesAround codes(fromMorton(this->Points[n]));
    for (int a = 0; a < 27; ++a)
    {
      const std::ptrdiff_t other = this->Near.find(codes[a]);
      if (other < 0 || this->WallOf[std::size_t(other)] != this->WallOf[n])
      {
        continue;
      }
      const std::uint32_t own = sets.find(side);
      std::uint64_t& mark = this->SideOf[std::size_t(other)];
      if (mark < this->FirstSide)
      {
        mark = this->FirstSide + own;
        sides[own].found.push_back(std::uint32_t(other));
      }
      else if (const std::uint32_t its = sets.find(std::uint32_t(mark - this->FirstSide)); its != own)
      {
        sets.unite(own, its);
        sides[std::min(own, its)].join(sides[std::max(own, its)]);
        ++met;
      }
    }
    return met;
  }

  void split(std::uint32_t wall, Side side)
  {
    std::vector<std::uint64_t> piece;
    for (const std::uint32_t n : side.searched)
    {
      piece.push_back(this->Points[n]);
      this->Long[wall].box.remove(piece.back());
    }
    std::sort(piece.begin(), piece.end());
    this->add(std::move(piece));
  }

  const std::vector<std::uint64_t>& Points;
  const std::vector<float>& Supports;
  double Longest;
  CodeCursor Near;
  Numbers WallOf;                   ///< of each point its long wall, or Settled where it is in none any more
  std::vector<std::uint64_t> SideOf; ///< of each point the side that found it last, numbered through all openings
  std::uint64_t FirstSide = 0;      ///< of the present opening
  std::uint64_t LastSide = 0;       ///< of all so far
  std::vector<LongWall> Long;
  Numbers Next; ///< those to be opened in the next round
  RemainingWalls Remaining;
};

} // namespace

RemainingWalls openLongWalls(const std::vector<std::uint64_t>& points, const std::vector<float>& supports, double longest, const WallOpener& open,
  Execution& execution)
{
  Walls walls(points, supports, longest);
  std::size_t taken = 0;
  for (Numbers round = walls.nextRound(); !round.empty(); round = walls.nextRound())
  {
    execution.checkpoint(double(taken) / double(points.size()));
    for (const std::uint32_t wall : round)
    {
      const std::vector<std::uint64_t> gone = open(walls.weakestOf(wall));
      taken += gone.size();
      walls.take(wall, gone);
    }
  }
  execution.checkpoint(1.0);
  return walls.remaining();
}

} // namespace silhouette
