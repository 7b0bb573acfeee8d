// SPDX-License-Identifier: BSD-3-Clause
#include "UncoveredRegions.h"

#include <gtest/gtest.h>

#include <string>

using namespace silhouette;

namespace
{

/** '#' is the object where it is covered, 'o' where it is not, '+' covered background, '.' other background. */
std::uint64_t lostOf(const std::vector<std::string>& rows, const LostPartLimits& limits)
{
  BinaryImage covered{ int(rows[0].size()), int(rows.size()), {} };
  std::vector<RowColumn> uncovered;
  for (int row = 0; row < covered.height; ++row)
  {
    for (int column = 0; column < covered.width; ++column)
    {
      const char pixel = rows[row][column];
      covered.pixels.push_back(pixel == '#' || pixel == '+');
      if (pixel == 'o')
      {
        uncovered.emplace_back(row, column);
      }
    }
  }
  return pixelsOfLostParts(uncovered, covered, limits);
}

LostPartLimits limitsOf(double area, double contact, double distance)
{
  LostPartLimits limits;
  limits.area = area;
  limits.contact = contact;
  limits.distance = distance;
  return limits;
}

std::vector<std::string> turned(const std::vector<std::string>& rows)
{
  std::vector<std::string> columns(rows[0].size());
  for (const std::string& row : rows)
  {
    for (std::size_t c = 0; c < row.size(); ++c)
    {
      columns[c] += row[c];
    }
  }
  return columns;
}

} // namespace

TEST(UncoveredRegions, ASkinIsNotLostHoweverLongItIs)
{
  const std::vector<std::string> skin = {
    "....................",
    "..oooooooooooooo....",
    "..oo###########oo...",
    "..oo###########oo...",
    "..oooooooooooooo....",
    "....................",
  };
  EXPECT_EQ(lostOf(skin, limitsOf(1, 1, 3)), 0u) << "all round";
  const std::vector<std::string> side = {
    "....................",
    "..oooooooooooooo....",
    "..###############...",
    "....................",
  };
  EXPECT_EQ(lostOf(side, limitsOf(1, 1, 3)), 0u) << "on one side";
  EXPECT_EQ(lostOf(turned(side), limitsOf(1, 1, 3)), 0u);
}

TEST(UncoveredRegions, AGapIsLostHoweverShortItIs)
{
  const std::vector<std::string> gap = {
    "..............",
    "..####oo####..",
    "..####oo####..",
    "..####oo####..",
    "..............",
  };
  const LostPartLimits wide = limitsOf(1, 2, 100);
  EXPECT_EQ(lostOf(gap, wide), 6u);
  EXPECT_EQ(lostOf(turned(gap), wide), 6u);
  EXPECT_EQ(lostOf(gap, limitsOf(7, 2, 100)), 0u) << "a speck";
  EXPECT_EQ(lostOf(gap, limitsOf(1, 5, 100)), 0u) << "its sides are four pixels long";
  const std::vector<std::string> askew = {
    "..............",
    "..###oo#####..",
    "..####oo####..",
    "..#####oo###..",
    "..............",
  };
  EXPECT_EQ(lostOf(askew, wide), 6u);
}

TEST(UncoveredRegions, AHoleThatNoiseMakesBesideTheContourIsNoSide)
{
  const std::vector<std::string> skin = {
    "...............",
    "..ooooooooooo..",
    "..ooooooooooo..",
    "..###oo...###..",
    "..####....###..",
    "..#####..####..",
    "..###########..",
    "...............",
  };
  EXPECT_EQ(lostOf(skin, limitsOf(1, 2, 4)), 0u) << "ten pixels are less than sixteen";
  EXPECT_EQ(lostOf(skin, limitsOf(1, 2, 3)), 24u) << "and more than nine: a handle, whose upper side is lost";
  EXPECT_EQ(lostOf(turned(skin), limitsOf(1, 2, 4)), 0u);
}

TEST(UncoveredRegions, CoverBeyondTheContourLeavesTheSidesOfAGap)
{
  EXPECT_EQ(lostOf(
              {
                "..............",
                ".++++....++++.",
                ".+###oooo###+.",
                ".+###oooo###+.",
                ".++++....++++.",
                "..............",
              },
              limitsOf(1, 2, 100)),
    8u);
}

TEST(UncoveredRegions, AnEndIsLostBeyondTheDistance)
{
  const std::vector<std::string> end = {
    "..............",
    "..####ooooo...",
    "..####ooooo...",
    "..####ooooo...",
    "..............",
  };
  // A pixel's distance from what is covered is that to the nearest pixel, less half a pixel.
  EXPECT_EQ(lostOf(end, limitsOf(1, 2, 4.4)), 3u);
  EXPECT_EQ(lostOf(end, limitsOf(1, 2, 3.4)), 6u);
  EXPECT_EQ(lostOf(end, limitsOf(1, 2, 4.6)), 0u);
  EXPECT_EQ(lostOf(turned(end), limitsOf(1, 2, 3.4)), 6u);
}

TEST(UncoveredRegions, EachForItself)
{
  EXPECT_EQ(lostOf(
              {
                "...............",
                "..##oo####oooo.",
                "..##oo####oooo.",
                "...............",
                ".o.............",
                "..o............",
              },
              limitsOf(3, 2, 2)),
    4u + 4u)
    << "a gap, half of an end, and not a speck of two pixels that touch at a corner";
  EXPECT_EQ(lostOf({ "oo", "oo" }, limitsOf(1, 1, 50)), 4u) << "nothing is covered anywhere";
  EXPECT_EQ(lostOf({ "..", ".." }, limitsOf(0, 1, 1)), 0u);
}

TEST(UncoveredRegions, AnImagesBorderIsNoSide)
{
  EXPECT_EQ(lostOf({ "##oo##", "##oo##" }, limitsOf(1, 1, 100)), 0u);
  EXPECT_EQ(lostOf({ "##oo##", "##oo##", "......" }, limitsOf(1, 1, 100)), 0u) << "one side";
}
