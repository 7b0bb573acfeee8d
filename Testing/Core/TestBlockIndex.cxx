// SPDX-License-Identifier: BSD-3-Clause
#include "BlockIndex.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

TEST(BlockIndex, FindsWhatBinarySearchFinds)
{
  Random random(5);
  for (const int spread : { 1, 3, 40, 5000 })
  {
    std::vector<std::uint64_t> codes{ std::uint64_t(random.below(3)) };
    for (int n = 0; n < 700; ++n)
    {
      codes.push_back(codes.back() + 1 + std::uint64_t(n % 50 == 0 ? random.below(spread * 1000) : random.below(spread)));
    }
    const BlockIndex index(codes);
    EXPECT_EQ(index.codes(), codes);
    EXPECT_EQ(index.size(), codes.size());
    const auto place = [&](std::uint64_t code) { return std::lower_bound(codes.begin(), codes.end(), code) - codes.begin(); };
    for (std::uint64_t code = 0; code < codes.back() + 3; code += 1 + std::uint64_t(random.below(std::max(1, spread / 4))))
    {
      const auto at = place(code);
      const bool isThere = std::size_t(at) < codes.size() && codes[std::size_t(at)] == code;
      EXPECT_EQ(index.find(code), isThere ? at : -1) << code;
      const std::uint64_t to = code + std::uint64_t(random.below(2000));
      EXPECT_EQ(index.count(code, to), std::size_t(place(to) - at));
    }
    for (std::size_t near = 0; near < codes.size(); ++near)
    {
      const std::uint64_t code = codes[near] + std::uint64_t(random.below(12)) - std::min<std::uint64_t>(codes[near], 4);
      EXPECT_EQ(index.findNear(near, code), index.find(code)) << codes[near] << " " << code;
    }
    EXPECT_EQ(index.find(codes.back()), std::ptrdiff_t(codes.size()) - 1);
    EXPECT_EQ(index.find(~std::uint64_t(0)), -1);
  }
  EXPECT_EQ(BlockIndex().find(0), -1);
  EXPECT_EQ(BlockIndex({ 7 }).find(7), 0);
  EXPECT_EQ(BlockIndex({ 7 }).count(0, 100), 1u);
}
