// SPDX-License-Identifier: BSD-3-Clause
#include "PointClusters.h"

#include "CarvingTestCaptures.h"
#include "UnionFind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

std::vector<std::uint64_t> scattered(int count, int side, Random& random)
{
  std::vector<std::uint64_t> points;
  for (int n = 0; n < count; ++n)
  {
    points.push_back(mortonCode({ random.below(side), random.below(side), random.below(side) }));
  }
  sortUnique(points);
  return points;
}

/** The sets of points that differ by `most` at most on every axis, one after another. */
UnionFind joinedWithin(const std::vector<std::uint64_t>& points, int most)
{
  UnionFind sets(points.size());
  for (std::uint32_t a = 0; a < points.size(); ++a)
  {
    for (std::uint32_t b = 0; b < a; ++b)
    {
      const LatticePoint p = fromMorton(points[a]), q = fromMorton(points[b]);
      if (std::max({ std::abs(p.i - q.i), std::abs(p.j - q.j), std::abs(p.k - q.k) }) <= most)
      {
        sets.unite(a, b);
      }
    }
  }
  return sets;
}

} // namespace

TEST(PointClusters, HoldWhatIsTwoStepsApartAndNothingThatIsFar)
{
  for (int scene = 0; scene < 12; ++scene)
  {
    ThreadedExecution execution(1 + scene % 3);
    Random random(scene);
    const auto points = scattered(20 + 60 * scene, 40, random);
    const PointClusters clusters = clustersOf(points, execution);
    std::vector<std::uint32_t> all = clusters.members, numbers(points.size()), clusterOf(points.size());
    std::sort(all.begin(), all.end());
    std::iota(numbers.begin(), numbers.end(), 0u);
    ASSERT_EQ(all, numbers) << "each point in one cluster";
    for (std::size_t cluster = 0; cluster < clusters.size(); ++cluster)
    {
      ASSERT_LT(clusters.begin(cluster), clusters.end(cluster));
      EXPECT_TRUE(std::is_sorted(clusters.begin(cluster), clusters.end(cluster)));
      EXPECT_TRUE(cluster == 0 || *clusters.begin(cluster - 1) < *clusters.begin(cluster));
      std::for_each(clusters.begin(cluster), clusters.end(cluster), [&](std::uint32_t n) { clusterOf[n] = std::uint32_t(cluster); });
    }
    UnionFind near = joinedWithin(points, 2), notFar = joinedWithin(points, 3);
    for (std::uint32_t n = 0; n < points.size(); ++n)
    {
      EXPECT_EQ(clusterOf[n], clusterOf[near.find(n)]);
      EXPECT_EQ(notFar.find(n), notFar.find(*clusters.begin(clusterOf[n])));
    }
    EXPECT_GT(clusters.size(), 1u);
  }
}

TEST(PointClusters, OfNoPointsThereAreNone)
{
  Execution execution;
  EXPECT_EQ(clustersOf({}, execution).size(), 0u);
}
