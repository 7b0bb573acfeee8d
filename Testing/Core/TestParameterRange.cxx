// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterRange.h"

#include <gtest/gtest.h>

#include <functional>

using namespace silhouette;

namespace
{

const double Infinity = std::numeric_limits<double>::infinity();
const double Nan = std::numeric_limits<double>::quiet_NaN();

std::string messageOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  return {};
}

std::string range(double value, double least, double greatest = Infinity)
{
  return messageOf([=] { requireRange("reach", value, least, greatest); });
}

std::string aboveZero(double value, double greatest = Infinity)
{
  return messageOf([=] { requireAboveZero("reach", value, greatest); });
}

} // namespace

TEST(ParameterRange, NumbersAreAsAUserWouldWriteThem)
{
  EXPECT_EQ(numberText(-1), "-1");
  EXPECT_EQ(numberText(0.35), "0.35");
  EXPECT_EQ(numberText(4294967296.0), "4294967296");
  EXPECT_EQ(numberText(1e-6), "1e-06");
}

TEST(ParameterRange, BothEndsAreWithinIt)
{
  for (const double value : { 0.0, 0.5, 1.0 })
  {
    EXPECT_EQ(range(value, 0.0, 1.0), "");
  }
  EXPECT_EQ(range(-0.5, 0.0, 1.0), "reach -0.5 is outside 0 to 1");
  EXPECT_EQ(range(101, 1, 100), "reach 101 is outside 1 to 100");
  EXPECT_EQ(range(Nan, 0.0, 1.0), "reach nan is outside 0 to 1");
  EXPECT_EQ(range(Infinity, 0.0, 1.0), "reach inf is outside 0 to 1");
}

TEST(ParameterRange, MayHaveNoUpperEnd)
{
  EXPECT_EQ(range(Infinity, 0.0), "");
  EXPECT_EQ(range(-1, 0.0), "reach -1: at least 0 is needed");
  EXPECT_EQ(range(Nan, 0.0), "reach nan: at least 0 is needed");
}

TEST(ParameterRange, MayBeginAboveZero)
{
  EXPECT_EQ(aboveZero(1e-300), "");
  EXPECT_EQ(aboveZero(Infinity), "");
  EXPECT_EQ(aboveZero(1.0, 1.0), "");
  EXPECT_EQ(aboveZero(0.0), "reach 0: above 0 is needed");
  EXPECT_EQ(aboveZero(Nan), "reach nan: above 0 is needed");
  EXPECT_EQ(aboveZero(1.5, 1.0), "reach 1.5: above 0 and at most 1 is needed");
}
