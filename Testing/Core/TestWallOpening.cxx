// SPDX-License-Identifier: BSD-3-Clause
#include "WallOpening.h"

#include "CarvingTestCaptures.h"
#include "Lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

using Codes = std::vector<std::uint64_t>;

/** Points of a box from (1, 1, 1) on, some of them missing, and what speaks for them. */
struct Thicket
{
  Codes points;
  std::vector<float> supports;

  Thicket(const LatticePoint& sides, double share, int levels, int seed)
  {
    Random random(seed);
    for (int n = 0; n < sides.i * sides.j * sides.k; ++n)
    {
      if (random.uniform() < share)
      {
        this->points.push_back(mortonCode({ 1 + n % sides.i, 1 + n / sides.i % sides.j, 1 + n / sides.i / sides.j }));
      }
    }
    std::sort(this->points.begin(), this->points.end());
    for (std::size_t n = 0; n < this->points.size(); ++n)
    {
      this->supports.push_back(float(std::floor(levels * random.uniform())));
    }
  }
};

/** Takes a point, and of those around what is left and a number drawn by its code says, and so on. */
class Nibbler
{
public:
  Nibbler(const Codes& points, unsigned oneOf)
    : Left(points.begin(), points.end())
    , OneOf(oneOf)
  {
  }

  Codes operator()(std::uint64_t point)
  {
    this->Opened.push_back(point);
    EXPECT_EQ(this->Left.erase(point), 1u);
    Codes taken{ point };
    for (std::size_t n = 0; n < taken.size(); ++n)
    {
      for (int a = 0; a < 27; ++a)
      {
        const std::uint64_t other = mortonCode(neighbourOf(fromMorton(taken[n]), a));
        if (other * 2654435761u / 65536 % this->OneOf == 0 && this->Left.erase(other) == 1)
        {
          taken.push_back(other);
        }
      }
    }
    return taken;
  }

  const std::set<std::uint64_t>& left() const { return this->Left; }
  const Codes& opened() const { return this->Opened; } ///< in this order

private:
  std::set<std::uint64_t> Left;
  Codes Opened;
  unsigned OneOf;
};

std::vector<Codes> grouped(std::set<std::uint64_t> left)
{
  std::vector<Codes> walls;
  while (!left.empty())
  {
    Codes wall{ *left.begin() };
    left.erase(left.begin());
    for (std::size_t n = 0; n < wall.size(); ++n)
    {
      for (int a = 0; a < 27; ++a)
      {
        const std::uint64_t other = mortonCode(neighbourOf(fromMorton(wall[n]), a));
        if (left.erase(other) == 1)
        {
          wall.push_back(other);
        }
      }
    }
    std::sort(wall.begin(), wall.end());
    walls.push_back(wall);
  }
  return walls;
}

double outlineOf(const Codes& wall)
{
  std::array<int, 3> low{ 1 << 20, 1 << 20, 1 << 20 }, high{};
  for (const std::uint64_t code : wall)
  {
    const LatticePoint p = fromMorton(code);
    low = { std::min(low[0], p.i), std::min(low[1], p.j), std::min(low[2], p.k) };
    high = { std::max(high[0], p.i), std::max(high[1], p.j), std::max(high[2], p.k) };
  }
  std::array<int, 3> sides{ high[0] - low[0], high[1] - low[1], high[2] - low[2] };
  std::sort(sides.begin(), sides.end());
  return 2.0 * (sides[1] + sides[2]) + 8.0;
}

/** openLongWalls() where everything that is left is grouped anew in each round. */
std::vector<Codes> expectedWalls(const Thicket& thicket, double longest, Nibbler& nibbler)
{
  const auto supportOf = [&](std::uint64_t code)
  { return thicket.supports[std::size_t(std::lower_bound(thicket.points.begin(), thicket.points.end(), code) - thicket.points.begin())]; };
  for (bool settled = false; !settled;)
  {
    settled = true;
    for (const Codes& wall : grouped(nibbler.left()))
    {
      if (outlineOf(wall) > longest)
      {
        settled = false;
        nibbler(*std::min_element(wall.begin(), wall.end(), [&](std::uint64_t a, std::uint64_t b) { return supportOf(a) < supportOf(b); }));
      }
    }
  }
  return grouped(nibbler.left());
}

/** Counts the checkpoints, and is cancelled at one of them. */
class Counting : public Execution
{
public:
  explicit Counting(int last = std::numeric_limits<int>::max())
    : Last(last)
  {
  }
  bool cancelled() const override { return this->Count >= this->Last; }
  void progress(double fraction) override
  {
    EXPECT_GE(fraction, this->Fraction);
    EXPECT_LE(fraction, 1.0);
    this->Fraction = fraction;
    ++this->Count;
  }
  int count() const { return this->Count; }
  double fraction() const { return this->Fraction; }

private:
  int Last, Count = 0;
  double Fraction = 0.0;
};

} // namespace

TEST(WallOpening, IsThatOfGroupingAllAnew)
{
  std::size_t opened = 0, walls = 0;
  for (int trial = 0; trial < 36; ++trial)
  {
    const LatticePoint sides = trial % 3 == 0 ? LatticePoint{ 18, 16, 1 } : trial % 3 == 1 ? LatticePoint{ 11, 3, 9 } : LatticePoint{ 7, 7, 7 };
    const Thicket thicket(sides, 0.1 + 0.025 * trial, trial % 2 ? 4 : 1000, trial);
    Nibbler nibbler(thicket.points, trial % 4 < 2 ? 1000003 : 5), other = nibbler;
    const double longest = 12.0 + trial % 5 * 5;
    Execution execution;
    RemainingWalls found = openLongWalls(thicket.points, thicket.supports, longest, std::ref(nibbler), execution);
    std::sort(found.walls.begin(), found.walls.end());
    EXPECT_EQ(found.walls, expectedWalls(thicket, longest, other)) << trial;
    EXPECT_EQ(nibbler.opened(), other.opened()) << trial;
    opened += other.opened().size();
    walls += found.walls.size();
  }
  EXPECT_GT(opened, 500u);
  EXPECT_GT(walls, 200u);
}

/** However many rounds it takes to open one wall of all points: these are not looked at again in each. */
TEST(WallOpening, DoesNotLookAtAWholeWallForEachOpening)
{
  for (const double share : { 0.12, 0.3, 0.9 })
  {
    const Thicket thicket({ 24, 24, 24 }, share, 1 << 20, 3);
    Nibbler nibbler(thicket.points, 1000003);
    Counting execution;
    const RemainingWalls found = openLongWalls(thicket.points, thicket.supports, 30.0, std::ref(nibbler), execution);
    EXPECT_GT(nibbler.opened().size(), 300u);
    EXPECT_LT(found.searched, 16 * thicket.points.size()) << share;
  }
}

TEST(WallOpening, AsksInEachRoundWhetherItIsCancelled)
{
  const Thicket thicket({ 60, 2, 1 }, 1.0, 1 << 20, 5);
  Nibbler all(thicket.points, 1000003);
  Counting counting;
  openLongWalls(thicket.points, thicket.supports, 30.0, std::ref(all), counting);
  EXPECT_EQ(counting.fraction(), 1.0);
  EXPECT_GT(counting.count(), 3);
  for (int last = 1; last <= counting.count(); ++last)
  {
    Nibbler nibbler(thicket.points, 1000003);
    Counting cancelled(last);
    EXPECT_THROW(openLongWalls(thicket.points, thicket.supports, 30.0, std::ref(nibbler), cancelled), Cancelled) << last;
    EXPECT_EQ(cancelled.count(), last);
  }
}

TEST(WallOpening, LeavesShortWallsAndNoneAlone)
{
  const Codes points = { mortonCode({ 1, 1, 1 }), mortonCode({ 2, 2, 2 }), mortonCode({ 5, 1, 1 }) };
  Execution execution;
  const auto never = [](std::uint64_t) -> Codes { throw Error("no wall is long"); };
  Codes none;
  EXPECT_TRUE(openLongWalls(none, {}, 8.0, never, execution).walls.empty());
  const RemainingWalls found = openLongWalls(points, { 1.0f, 2.0f, 3.0f }, 12.0, never, execution);
  EXPECT_EQ(found.walls, (std::vector<Codes>{ { points[0], points[1] }, { points[2] } }));
  EXPECT_EQ(found.searched, 0u);
}
