// SPDX-License-Identifier: BSD-3-Clause
#include "LeastDistances.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr std::size_t Points = FieldViews::BlockPoints;
constexpr int Size = 160;

} // namespace

TEST(LeastDistances, AreKeptInTheirOrder)
{
  Random random(5);
  for (const int rank : { 1, 2, 5 })
  {
    std::vector<float> kept(rank * Points, 9.0f);
    std::vector<std::vector<float>> all(Points, std::vector<float>(rank, 9.0f));
    for (int view = 0; view < 12; ++view)
    {
      float distances[Points];
      for (std::size_t n = 0; n < Points; ++n)
      {
        distances[n] = float(random.below(8)); // equal ones among them
        all[n].push_back(distances[n]);
      }
      keepLeast(distances, Points - 8, kept.data(), rank);
    }
    for (std::size_t n = 0; n < Points; ++n)
    {
      std::sort(all[n].begin(), all[n].end());
      for (int k = 0; k < rank; ++k)
      {
        EXPECT_EQ(kept[k * Points + n], n < Points - 8 ? all[n][k] : 9.0f) << rank << " " << n;
      }
    }
  }
}

TEST(LeastDistances, AreThoseOfTheViewsThatAreLeastAndOutsideOnTheBorder)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(4, 0.9), swayingRing(7, Size), Size));
  const Lattice lattice{ { Vector3(-1.0, -1.0, -1.0), 1.6 }, 5 }; // the sphere meets the cube's border
  FieldViews seen(views, lattice, 4.0);
  std::vector<int> all(std::size_t(seen.size()));
  std::iota(all.begin(), all.end(), 0);
  seen.observe(all, execution);
  std::vector<std::uint64_t> cells;
  for (std::uint64_t cell = 0; cell < std::uint64_t(1) << 15; ++cell)
  {
    const double radius = lattice.position(fromMorton(cell)).norm();
    if (radius > 0.8 && radius < 1.0)
    {
      cells.push_back(cell);
    }
  }
  const BrickField field(lattice, cells, 0, execution);
  const int rank = 3;
  std::vector<float> taken(rank * field.size(), -100.0f);
  const auto concerns = [](std::size_t block) { return BlockGroups(std::uint8_t(block / Points * 37)); }; // any groups; none of some blocks
  ThreadedExecution threads(3);
  const auto never = [](std::size_t, const BlockGroups&, std::size_t from, const float*) { return from; };
  const auto take = [&](std::size_t block, const BlockGroups& groups, const float* least)
  {
    for (int k = 0; k < rank; ++k)
    {
      for (std::size_t n = 0; n < groups.points(); ++n)
      {
        taken[k * field.size() + block + groups.point(n)] = least[k * Points + n];
      }
    }
  };
  forLeastDistances(field, seen, rank, [&] { return BlockQuestions{ concerns, never, take }; }, threads);
  int border = 0, near = 0;
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    const LatticePoint p = fromMorton(field.code(n));
    std::vector<float> distances;
    for (const int view : all)
    {
      distances.push_back(seen.inside(seen.observed(view), seen.place(view, p)));
    }
    std::sort(distances.begin(), distances.end());
    const std::size_t block = n / Points * Points;
    const BlockGroups groups = concerns(block);
    bool isAsked = false;
    for (std::size_t m = 0; m < groups.size(); ++m)
    {
      isAsked = isAsked || groups.first(m) == (n - block) / 8 * 8;
    }
    for (int k = 0; k < rank; ++k)
    {
      const float value = taken[k * field.size() + n];
      if (!isAsked)
      {
        EXPECT_EQ(value, -100.0f);
      }
      else if (lattice.onBorder(p))
      {
        EXPECT_EQ(value, -4.0f);
        border += k == 0;
      }
      else if (std::max({ p.i, p.j, p.k }) < lattice.cells())
      {
        EXPECT_NEAR(value, distances[k], 1e-3) << p.i << " " << p.j << " " << p.k << ", " << k;
        near += std::abs(value) < 2.0f;
      }
    }
  }
  EXPECT_GT(border, 100);
  EXPECT_GT(near, 5000);
}

TEST(LeastDistances, NoFurtherViewIsAskedAboutWhatIsSettled)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(4, 0.7), swayingRing(7, Size), Size));
  const Lattice lattice{ unitCube(1.05), 5 };
  FieldViews seen(views, lattice, 4.0);
  std::vector<int> all(std::size_t(seen.size()));
  std::iota(all.begin(), all.end(), 0);
  seen.observe(all, execution);
  std::vector<std::uint64_t> cells;
  for (std::uint64_t cell = 0; cell < std::uint64_t(1) << 15; cell += 97)
  {
    const double radius = lattice.position(fromMorton(cell)).norm();
    if (radius > 0.6 && radius < 0.8)
    {
      cells.push_back(cell);
    }
  }
  const BrickField field(lattice, cells, 0, execution);
  std::vector<float> exact(field.size()), bounds(field.size());
  const auto into = [](std::vector<float>& values)
  { return [&values](std::size_t block, const BlockGroups&, const float* least) { std::copy_n(least, Points, &values[block]); }; };
  const auto isAny = [](std::size_t) { return BlockGroups::all(); };
  int asked = 0;
  const auto never = [&](std::size_t, const BlockGroups&, std::size_t from, const float*)
  {
    ++asked;
    return from;
  };
  forLeastDistances(field, seen, 1, [&] { return BlockQuestions{ isAny, never, into(exact) }; }, execution);
  const int whole = asked;
  asked = 0;
  const auto areNegative = [&](std::size_t, const BlockGroups&, std::size_t from, const float* greatest)
  {
    ++asked;
    return std::size_t(std::find_if(greatest + from, greatest + Points, [](float value) { return value > 0.0f; }) - greatest);
  };
  forLeastDistances(field, seen, 1, [&] { return BlockQuestions{ isAny, areNegative, into(bounds) }; }, execution);
  EXPECT_LT(asked, whole);
  int same = 0, other = 0;
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    EXPECT_GE(bounds[n], exact[n]);
    EXPECT_EQ(bounds[n] > 0.0f, exact[n] > 0.0f);
    same += bounds[n] == exact[n];
    other += bounds[n] != exact[n];
  }
  EXPECT_GT(same, 1000);
  EXPECT_GT(other, 1000);
}
