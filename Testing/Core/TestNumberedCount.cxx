// SPDX-License-Identifier: BSD-3-Clause
#include "NumberedCount.h"

#include <gtest/gtest.h>

using namespace silhouette;

TEST(NumberedCount, EndsWhereNumbersDo)
{
  for (const std::size_t count : { std::size_t(0), std::size_t(1), std::size_t(2147483647) })
  {
    EXPECT_EQ(numberedCount(count, "corners"), count);
  }
  for (const std::size_t count : { std::size_t(2147483648), std::size_t(4294967296), ~std::size_t(0) })
  {
    try
    {
      numberedCount(count, "corners");
      ADD_FAILURE() << count;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_EQ(std::string(error.what()).find(std::to_string(count) + " corners"), 0u) << error.what();
    }
  }
}
