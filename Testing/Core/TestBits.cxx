// SPDX-License-Identifier: BSD-3-Clause
#include "Bits.h"

#include "FirstTouch.h"
#include "IndicesWhere.h"
#include "LeastNumbers.h"
#include "RadixSort.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace silhouette;
using namespace silhouette::test;

TEST(Bits, CountsLowestAndHighestAreThoseOfALoop)
{
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const std::uint64_t bits = trial < 64 ? std::uint64_t(1) << trial : random.next() >> random.below(64);
    int count = 0, lowest = -1, highest = -1;
    for (int n = 0; n < 64; ++n)
    {
      if (bits >> n & 1u)
      {
        ++count;
        lowest = lowest < 0 ? n : lowest;
        highest = n;
      }
    }
    ASSERT_EQ(countBits(bits), count);
    if (bits != 0)
    {
      ASSERT_EQ(lowestBit(bits), lowest);
      ASSERT_EQ(highestBit(bits), highest);
    }
  }
  EXPECT_EQ(countBits(0), 0);
  EXPECT_EQ(countBits(~std::uint64_t(0)), 64);
}

TEST(RadixSort, IsAStableSortByAsManyBitsAsAreNamed)
{
  Random random(2);
  for (const int bits : { 0, 1, 11, 12, 13, 25, 40, 64 })
  {
    const std::uint64_t mask = bits == 0 ? 0 : ~std::uint64_t(0) >> (64 - bits);
    for (const int count : { 0, 1, 3000, 100000 })
    {
      std::vector<std::pair<std::uint64_t, int>> items;
      for (int i = 0; i < count; ++i)
      {
        items.emplace_back(random.next() >> random.below(64), i); // some with further bits, which do not count
      }
      auto expected = items;
      std::stable_sort(
        expected.begin(), expected.end(), [&](const auto& a, const auto& b) { return (a.first & mask) < (b.first & mask); });
      for (const int threads : { 1, 2, 8 })
      {
        ThreadedExecution execution(threads);
        auto sorted = items;
        radixSort(sorted, bits, [](const auto& item) { return item.first; }, execution);
        EXPECT_EQ(sorted, expected) << bits << " bits, " << count << " items, " << threads << " threads";
      }
    }
  }
}

TEST(IndicesWhere, ConcatenatedAreListsOneAfterAnother)
{
  for (const int threads : { 1, 3 })
  {
    ThreadedExecution execution(threads);
    EXPECT_EQ(concatenated<int>({ {}, { 3, 1 }, {}, { 4 }, { 1, 5, 9 }, {} }, execution), (std::vector<int>{ 3, 1, 4, 1, 5, 9 }));
    EXPECT_TRUE(concatenated<int>({}, execution).empty());
    EXPECT_TRUE(concatenated<int>({ {}, {} }, execution).empty());
  }
}

TEST(IndicesWhere, SelectedAreThoseThatAreWantedInTheirOrder)
{
  for (const std::size_t count : { std::size_t(0), std::size_t(1), std::size_t(32768), std::size_t(200001) })
  {
    const auto isWanted = [](std::size_t i) { return i % 7 == 3 || i / 40000 == 2; };
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (isWanted(i))
      {
        expected.push_back(std::uint32_t(5 * i));
      }
    }
    for (const int threads : { 1, 2, 8 })
    {
      ThreadedExecution execution(threads);
      EXPECT_EQ(selected(count, isWanted, [](std::size_t i) { return std::uint32_t(5 * i); }, execution), expected) << count << ", " << threads;
      EXPECT_TRUE(selected(count, [](std::size_t) { return false; }, [](std::size_t i) { return i; }, execution).empty());
    }
  }
}

TEST(LeastNumbers, KeepsTheLeastWhateverTheOrder)
{
  for (const int threads : { 1, 2, 8 })
  {
    ThreadedExecution execution(threads);
    LeastNumbers least(1000, execution);
    execution.forRanges(100000, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          least.lower(i * 7919 % 999, std::uint32_t(100000 - i)); // the last of each thing is the least
        }
      });
    std::vector<std::uint32_t> expected(1000, LeastNumbers::None);
    for (std::size_t i = 0; i < 100000; ++i)
    {
      std::uint32_t& own = expected[i * 7919 % 999];
      own = std::min(own, std::uint32_t(100000 - i));
    }
    for (std::size_t i = 0; i < 1000; ++i)
    {
      ASSERT_EQ(least[i], expected[i]);
    }
  }
}

TEST(FirstTouch, IsResize)
{
  for (const int threads : { 1, 2, 8 })
  {
    ThreadedExecution execution(threads);
    for (const std::size_t n : { std::size_t(0), std::size_t(1), std::size_t(5000), std::size_t(300000) })
    {
      std::vector<std::uint32_t> values;
      resizeSideBySide(values, n, execution);
      EXPECT_EQ(values, std::vector<std::uint32_t>(n, 0u));
    }
  }
}
