// SPDX-License-Identifier: BSD-3-Clause
#include "BlockGroups.h"

#include "Lattice.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace silhouette;

TEST(BlockGroups, AreTheirPointsInMortonOrder)
{
  const BlockGroups groups(0b10100100); // 2, 5, 7
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups.points(), 24u);
  const std::size_t expected[] = { 2, 5, 7 };
  for (std::size_t n = 0; n < groups.points(); ++n)
  {
    EXPECT_EQ(groups.point(n), 8 * expected[n / 8] + n % 8);
    const LatticePoint lowest = fromMorton(groups.first(n / 8)), p = fromMorton(groups.point(n));
    EXPECT_LE(std::max({ p.i - lowest.i, p.j - lowest.j, p.k - lowest.k }), 1) << n; // 2 x 2 x 2 points
  }
  EXPECT_TRUE(BlockGroups(0).empty());
  EXPECT_EQ(BlockGroups::all().points(), 64u);
  EXPECT_EQ(BlockGroups::all().point(37), 37u);
}

TEST(BlockGroups, AreThoseOfAnyPointThatATestHoldsFor)
{
  const BlockGroups groups = BlockGroups::where([](std::size_t n) { return n == 8 || n == 15 || n == 63; });
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.first(0), 8u);
  EXPECT_EQ(groups.first(1), 56u);
  EXPECT_TRUE(BlockGroups::where([](std::size_t) { return false; }).empty());
}

TEST(BlockGroups, AtSomePlacesAmongThem)
{
  const BlockGroups groups = BlockGroups(0b11010010).at(BlockGroups(0b1010)); // of 1, 4, 6, 7 the second and the fourth
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.first(0), 4u * 8);
  EXPECT_EQ(groups.first(1), 7u * 8);
}
