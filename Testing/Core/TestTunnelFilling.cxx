// SPDX-License-Identifier: BSD-3-Clause
#include "TunnelFilling.h"

#include "CarvingTestCaptures.h"
#include "LabelledSolids.h"
#include "NarrowOutside.h"
#include "SimplePoint.h"
#include "UnionFind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A slab with a hole of the given size, in corners, through it. */
double drilledSlab(const LatticePoint& p, int width, int length)
{
  const double slab = boxField(p, { 4, 4, 12 }, { 28, 28, 18 });
  return std::min(slab, -boxField(p, { 14, 6, 0 }, { 13 + width, 5 + length, 32 }));
}

std::int64_t genusAfter(LabelledSolid& solid, const TunnelFillingOptions& options)
{
  solid.fill(tunnelWalls(*solid.labels, options, solid.execution));
  const MeshSoundness surface = solid.surface();
  EXPECT_TRUE(surface.genus.has_value());
  EXPECT_EQ(surface.components, 1u);
  return surface.genus.value_or(-1);
}

LabelledSolid randomBalls(int depth, int count, int seed)
{
  Random random(seed);
  const double side = 1 << depth;
  std::vector<std::array<double, 4>> balls;
  for (int n = 0; n < count; ++n)
  {
    balls.push_back({ random.uniform(4.0, side - 4.0), random.uniform(4.0, side - 4.0), random.uniform(4.0, side - 4.0), random.uniform(1.5, 3.5) });
  }
  return LabelledSolid(depth,
    [&](const LatticePoint& p)
    {
      double most = -9.0;
      for (const auto& [i, j, k, radius] : balls)
      {
        most = std::max(most, radius - std::hypot(p.i - i, p.j - j, p.k - k));
      }
      return most;
    });
}

/** Depth 4: a share of the corners, any of them. */
LabelledSolid noise(double share, int seed)
{
  Random random(seed);
  std::vector<double> drawn(4096);
  std::generate(drawn.begin(), drawn.end(), [&] { return random.uniform(); });
  return LabelledSolid(4, [&](const LatticePoint& p) { return std::max({ p.i, p.j, p.k }) < 16 ? share - drawn[std::size_t(p.i + 16 * (p.j + 16 * p.k))] : -1.0; });
}

/** tunnelWalls(): one narrow point after another, what is connected flooded anew for each, and all that is left grouped anew for each wall opened. */
class OneByOne
{
public:
  OneByOne(LabelledSolid& solid, int width)
    : Solid(solid)
    , Side(solid.octree.lattice.cells() + 3)
    , IsWide(std::size_t(Side * Side * Side), true)
  {
    const auto narrow = NarrowOutside(*solid.labels, width, solid.execution).points();
    for (int n = 0; n < this->Side * this->Side * this->Side; ++n)
    {
      const LatticePoint p{ n % this->Side - 1, n / this->Side % this->Side - 1, n / this->Side / this->Side - 1 };
      const bool inside = std::min({ p.i, p.j, p.k }) >= 0 && solid.labels->insideAt(p);
      const bool isNarrow = std::min({ p.i, p.j, p.k }) >= 0 && std::binary_search(narrow.begin(), narrow.end(), mortonCode(p));
      this->IsWide[std::size_t(n)] = !inside && !isNarrow;
    }
    for (const std::uint64_t code : narrow)
    {
      this->Narrow.insert(code);
      this->push(code);
    }
  }

  /** `longest`: octants of a wall's outline. */
  std::vector<std::uint64_t> walls(double longest)
  {
    this->grow();
    for (bool settled = false; !settled;)
    {
      settled = true;
      for (const auto& wall : this->groups())
      {
        if (outline(wall) > longest)
        {
          settled = false;
          const auto weaker = [&](std::uint64_t a, std::uint64_t b) { return this->supportOf(a) < this->supportOf(b); };
          this->take(*std::min_element(wall.begin(), wall.end(), weaker));
          this->grow();
          ++this->openings;
        }
      }
    }
    std::vector<std::uint64_t> walls;
    for (const auto& wall : this->groups())
    {
      if (this->eulerRise(wall) > 0)
      {
        walls.insert(walls.end(), wall.begin(), wall.end());
      }
    }
    std::sort(walls.begin(), walls.end());
    return walls;
  }

  std::size_t openings = 0;
  std::size_t floods = 0;

private:
  std::size_t place(const LatticePoint& p) const { return std::size_t((p.i + 1) + this->Side * ((p.j + 1) + this->Side * (p.k + 1))); }

  float supportOf(std::uint64_t code) const
  {
    const std::ptrdiff_t corner = this->Solid.labels->shell().find(code);
    return corner >= 0 ? this->Solid.labels->support()[std::size_t(corner)] : -1e30f;
  }

  void push(std::uint64_t code)
  {
    if (this->Narrow.count(code) != 0)
    {
      this->Front.insert({ this->supportOf(code), code });
    }
  }

  void take(std::uint64_t code)
  {
    this->Narrow.erase(code);
    this->IsWide[this->place(fromMorton(code))] = true;
    for (int n = 0; n < 27; ++n)
    {
      this->push(mortonCode(neighbourOf(fromMorton(code), n)));
    }
  }

  void grow()
  {
    while (!this->Front.empty())
    {
      const std::uint64_t code = this->Front.begin()->second;
      this->Front.erase(this->Front.begin());
      if (this->Narrow.count(code) != 0 && this->mayTake(fromMorton(code)))
      {
        this->take(code);
      }
    }
  }

  /** What is left, neighbours at corners being together; each ascending, in the order of their first points. */
  std::vector<std::vector<std::uint64_t>> groups() const
  {
    const std::vector<std::uint64_t> left(this->Narrow.begin(), this->Narrow.end());
    UnionFind together(left.size());
    for (std::uint32_t a = 0; a < left.size(); ++a)
    {
      for (std::uint32_t b = 0; b < a; ++b)
      {
        const LatticePoint p = fromMorton(left[a]), q = fromMorton(left[b]);
        if (std::max({ std::abs(p.i - q.i), std::abs(p.j - q.j), std::abs(p.k - q.k) }) <= 1)
        {
          together.unite(a, b);
        }
      }
    }
    std::map<std::uint32_t, std::vector<std::uint64_t>> groups;
    for (std::uint32_t n = 0; n < left.size(); ++n)
    {
      groups[together.find(n)].push_back(left[n]);
    }
    std::vector<std::vector<std::uint64_t>> walls;
    std::transform(groups.begin(), groups.end(), std::back_inserter(walls), [](const auto& group) { return group.second; });
    return walls;
  }

  /** Twice the two longest sides of the box around a wall, and the eight points around an edge of one point. */
  static double outline(const std::vector<std::uint64_t>& wall)
  {
    std::array<std::vector<int>, 3> coordinates;
    for (const std::uint64_t code : wall)
    {
      const LatticePoint p = fromMorton(code);
      coordinates[0].push_back(p.i);
      coordinates[1].push_back(p.j);
      coordinates[2].push_back(p.k);
    }
    std::vector<int> sides;
    for (const auto& along : coordinates)
    {
      sides.push_back(*std::max_element(along.begin(), along.end()) - *std::min_element(along.begin(), along.end()));
    }
    return 2.0 * (sides[0] + sides[1] + sides[2] - *std::min_element(sides.begin(), sides.end())) + 8.0;
  }

  bool mayTake(const LatticePoint& p)
  {
    Neighbourhood labels;
    for (int n = 0; n < 27; ++n)
    {
      labels[std::size_t(n)] = n != 13 && !this->IsWide[this->place(neighbourOf(p, n))];
    }
    const int touching = topologicalNumbers(labels).outside;
    if (touching <= 1)
    {
      return touching == 1;
    }
    ++this->floods;
    UnionFind sets(this->IsWide.size());
    const int steps[3] = { 1, this->Side, this->Side * this->Side };
    for (std::size_t n = 0; n < this->IsWide.size(); ++n)
    {
      for (const int step : steps)
      {
        const bool hasNext = n / std::size_t(step) % std::size_t(this->Side) + 1 < std::size_t(this->Side);
        if (hasNext && this->IsWide[n] && this->IsWide[n + std::size_t(step)])
        {
          sets.unite(std::uint32_t(n), std::uint32_t(n + std::size_t(step)));
        }
      }
    }
    std::set<std::uint32_t> roots;
    for (const int n : EdgeNeighbours)
    {
      const std::size_t other = this->place(neighbourOf(p, n));
      if (this->IsWide[other])
      {
        roots.insert(sets.find(std::uint32_t(other)));
      }
    }
    return int(roots.size()) == touching;
  }

  int eulerRise(const std::vector<std::uint64_t>& wall) const
  {
    std::set<std::uint64_t> added;
    int rise = 0;
    for (const std::uint64_t code : wall)
    {
      Neighbourhood around;
      for (int n = 0; n < 27; ++n)
      {
        const LatticePoint q = neighbourOf(fromMorton(code), n);
        around[std::size_t(n)] = this->Solid.labels->insideAt(q) || added.count(mortonCode(q)) != 0;
      }
      rise += eulerChange(around);
      added.insert(code);
    }
    return rise;
  }

  LabelledSolid& Solid;
  int Side; ///< points, with one beyond the lattice at either end
  std::vector<bool> IsWide;
  std::set<std::uint64_t> Narrow;
  std::set<std::pair<float, std::uint64_t>> Front; ///< least support first, then the first in lattice order
};

} // namespace

TEST(TunnelFilling, IsThatOfOnePointAfterAnother)
{
  std::size_t filled = 0, floods = 0;
  for (int trial = 0; trial < 16; ++trial)
  {
    LabelledSolid solid = randomBalls(5, 24 + 4 * trial, trial);
    const int width = 1 + trial % 4;
    ThreadedExecution execution(1 + trial % 3);
    const auto walls = tunnelWalls(*solid.labels, { true, width, 1000.0 }, execution);
    OneByOne other(solid, width);
    EXPECT_EQ(walls, other.walls(32000.0)) << trial;
    filled += walls.size();
    floods += other.floods;
  }
  EXPECT_GT(filled, 50u);
  EXPECT_GT(floods, 50u);
}

TEST(TunnelFilling, OpensLongWallsAsIfAllWereGroupedAnewForEach)
{
  std::size_t filled = 0, openings = 0;
  for (int trial = 0; trial < 6; ++trial)
  {
    LabelledSolid solid = noise(0.17 + 0.02 * trial, trial);
    const double loop = 0.8 + 0.2 * (trial % 4);
    const auto walls = tunnelWalls(*solid.labels, { true, 2 + trial % 3, loop }, solid.execution);
    OneByOne other(solid, 2 + trial % 3);
    EXPECT_EQ(walls, other.walls(loop * 16.0)) << trial;
    filled += walls.size();
    openings += other.openings;
  }
  EXPECT_GT(filled, 20u);
  EXPECT_GT(openings, 50u);
}

TEST(TunnelFilling, CanBeCancelledAtAnyTimeAndTellsItsProgress)
{
  LabelledSolid solid = noise(0.25, 4);
  StoppedAt never(1 << 30);
  tunnelWalls(*solid.labels, { true, 3, 0.7 }, never);
  EXPECT_GE(never.asked(), 10);
  for (int last = 0; last < never.asked(); ++last)
  {
    StoppedAt stopped(last);
    EXPECT_THROW(tunnelWalls(*solid.labels, { true, 3, 0.7 }, stopped), Cancelled) << last;
  }
  ProgressExecution progress;
  tunnelWalls(*solid.labels, { true, 3, 0.7 }, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}

TEST(TunnelFilling, FillsNarrowTunnelsAndNoOthers)
{
  for (const int width : { 1, 2, 3, 4, 6 })
  {
    LabelledSolid solid(5, [&](const LatticePoint& p) { return drilledSlab(p, width, width); });
    ASSERT_EQ(solid.surface().genus, 1);
    EXPECT_EQ(genusAfter(solid, { true, 3, 1.0 }), width > 3 ? 1 : 0) << width << " corners wide";
  }
  LabelledSolid solid(5, [](const LatticePoint& p) { return drilledSlab(p, 2, 2); });
  EXPECT_TRUE(tunnelWalls(*solid.labels, { false, 3, 1.0 }, solid.execution).empty()) << "off";
  EXPECT_TRUE(tunnelWalls(*solid.labels, { true, 3, 0.0 }, solid.execution).empty()) << "no loop is short";
}

TEST(TunnelFilling, LeavesANarrowHoleWithALongOutline)
{
  for (const int length : { 3, 18 })
  {
    LabelledSolid solid(5, [&](const LatticePoint& p) { return drilledSlab(p, 2, length); });
    EXPECT_EQ(genusAfter(solid, { true, 3, 0.5 }), length > 10 ? 1 : 0) << length << " corners long";
  }
}

/** A ring keeps its own hole and loses those that are drilled through its tube. */
TEST(TunnelFilling, GivesARingItsGenusBack)
{
  for (const int drills : { 1, 2, 3 })
  {
    LabelledSolid solid(5,
      [&](const LatticePoint& p)
      {
        const double x = p.i - 16, y = p.j - 16, z = p.k - 16;
        double value = 4.2 - std::hypot(std::hypot(x, y) - 9.0, z);
        value = std::min(value, std::max(std::abs(y) - 0.5, std::abs(x - 9.0) - 0.6));
        value = drills > 1 ? std::min(value, std::max(std::abs(x) - 0.5, std::abs(y - 9.0) - 1.1)) : value;
        return drills > 2 ? std::min(value, std::max(std::abs(y) - 0.5, std::abs(z) - (x < 0 ? 0.6 : -1.0))) : value;
      });
    ASSERT_EQ(solid.surface().genus, drills + 1);
    EXPECT_EQ(genusAfter(solid, { true, 3, 1.0 }), 1);
  }
}

/** Two bumps that face each other across a gap: narrow there, but no passage. */
TEST(TunnelFilling, LeavesAGapThatIsNarrowInItsMiddle)
{
  LabelledSolid solid(5,
    [](const LatticePoint& p)
    {
      const double plates = std::max({ boxField(p, { 6, 6, 4 }, { 26, 26, 9 }), boxField(p, { 6, 6, 20 }, { 26, 26, 26 }),
        boxField(p, { 6, 6, 4 }, { 9, 26, 26 }) });
      return std::max(plates, boxField(p, { 17, 15, 9 }, { 20, 18, 17 }));
    });
  EXPECT_TRUE(tunnelWalls(*solid.labels, { true, 3, 10.0 }, solid.execution).empty());
  EXPECT_EQ(solid.surface().genus, 0);
}

/** Whatever the labels: only outside corners, never more tunnels, and no survivor is touched since labels only grow. */
TEST(TunnelFilling, NeverMakesATunnel)
{
  Random random(5);
  int filled = 0;
  for (int trial = 0; trial < 12; ++trial)
  {
    const double share = 0.15 + 0.7 * random.uniform();
    std::vector<double> noise(4096);
    for (double& value : noise)
    {
      value = random.uniform();
    }
    LabelledSolid solid(4,
      [&](const LatticePoint& p)
      { return p.i < 16 && p.j < 16 && p.k < 16 ? share - noise[p.i + 16 * (p.j + 16 * p.k)] : -1.0; });
    const MeshSoundness before = solid.surface();
    const auto walls = tunnelWalls(*solid.labels, { true, 2, 2.0 }, solid.execution);
    for (const std::uint64_t point : walls)
    {
      EXPECT_FALSE(solid.labels->insideAt(fromMorton(point)));
      EXPECT_FALSE(solid.octree.lattice.onBorder(fromMorton(point)));
    }
    solid.fill(walls);
    const MeshSoundness after = solid.surface();
    EXPECT_LE(std::int64_t(*after.genus), *before.genus) << "trial " << trial;
    filled += !walls.empty();
  }
  EXPECT_GT(filled, 0);
}

TEST(TunnelFilling, RejectsOptionsOutOfRange)
{
  LabelledSolid solid(3, [](const LatticePoint& p) { return boxField(p, { 2, 2, 2 }, { 5, 5, 5 }); });
  EXPECT_THROW(tunnelWalls(*solid.labels, { true, 0, 1.0 }, solid.execution), InvalidInput);
  EXPECT_THROW(tunnelWalls(*solid.labels, { true, 9, 1.0 }, solid.execution), InvalidInput);
  EXPECT_THROW(tunnelWalls(*solid.labels, { true, 3, -1.0 }, solid.execution), InvalidInput);
}
