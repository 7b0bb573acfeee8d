// SPDX-License-Identifier: BSD-3-Clause
#include "ConcurrentUnionFind.h"

#include "CarvingTestCaptures.h"
#include "UnionFind.h"

#include <gtest/gtest.h>

#include <thread>

using namespace silhouette;
using namespace silhouette::test;

TEST(ConcurrentUnionFind, HasTheSetsOfUnionFindWhoeverUnites)
{
  Execution execution;
  for (const std::size_t count : { std::size_t(1000), std::size_t(60000) })
  {
    Random random(7);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t n = 0; n < count * 9 / 10; ++n)
    {
      pairs.emplace_back(std::uint32_t(random.below(int(count))), std::uint32_t(random.below(int(count))));
    }
    UnionFind expected(count);
    for (const auto& [a, b] : pairs)
    {
      expected.unite(a, b);
    }
    for (const std::size_t threads : { 1, 2, 8 })
    {
      ConcurrentUnionFind sets(count, execution);
      ASSERT_EQ(sets.size(), count);
      std::vector<std::thread> uniting;
      for (std::size_t t = 0; t < threads; ++t)
      {
        uniting.emplace_back(
          [&, t]
          {
            for (std::size_t n = t; n < pairs.size(); n += threads)
            {
              sets.unite(pairs[n].first, pairs[n].second);
            }
          });
      }
      for (auto& one : uniting)
      {
        one.join();
      }
      std::size_t roots = 0;
      for (std::uint32_t n = 0; n < count; ++n)
      {
        ASSERT_EQ(sets.find(n), expected.find(n)) << threads;
        roots += sets.find(n) == n;
      }
      EXPECT_GT(roots, count / 20);
      EXPECT_LT(roots, count / 2);
    }
  }
}

TEST(ConcurrentUnionFind, OfNoNumbers)
{
  Execution execution;
  EXPECT_EQ(ConcurrentUnionFind(0, execution).size(), 0u);
  EXPECT_EQ(ConcurrentUnionFind().size(), 0u);
}
