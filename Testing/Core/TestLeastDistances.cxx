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
      keepLeast(distances, kept.data(), rank);
    }
    for (std::size_t n = 0; n < Points; ++n)
    {
      std::sort(all[n].begin(), all[n].end());
      for (int k = 0; k < rank; ++k)
      {
        EXPECT_EQ(kept[k * Points + n], all[n][k]) << rank << " " << n;
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
  const auto concerns = [](std::size_t block) { return block / Points % 3 != 1; };
  ThreadedExecution threads(3);
  forLeastDistances(field, seen, rank, concerns,
    [&](std::size_t block, const float* least)
    {
      for (int k = 0; k < rank; ++k)
      {
        std::copy_n(least + k * Points, Points, &taken[k * field.size() + block]);
      }
    },
    threads);
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
    for (int k = 0; k < rank; ++k)
    {
      const float value = taken[k * field.size() + n];
      if (!concerns(n / Points * Points))
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
