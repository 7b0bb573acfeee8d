// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRuns.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Pixels that are object with a probability of their own in each row: empty rows, full ones, and what lies between. */
BinaryImage randomImage(Random& random, int width, int height)
{
  BinaryImage image{ width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height), 0) };
  for (int row = 0; row < height; ++row)
  {
    const double share = random.uniform() * 1.6 - 0.3;
    for (int column = 0; column < width; ++column)
    {
      image.at(column, row) = random.uniform() < share;
    }
  }
  return image;
}

/** Every pixel beside its right neighbour and the one below. */
std::vector<ContourPlace> placesOf(const BinaryImage& image)
{
  std::vector<ContourPlace> places;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      if (column + 1 < image.width && image.at(column, row) != image.at(column + 1, row))
      {
        places.push_back({ column, row, false });
      }
      if (row + 1 < image.height && image.at(column, row) != image.at(column, row + 1))
      {
        places.push_back({ column, row, true });
      }
    }
  }
  return places;
}

} // namespace

TEST(SilhouetteRuns, AreTheImage)
{
  Random random(5);
  std::size_t contours = 0;
  for (const auto& [width, height] : { std::pair{ 1, 1 }, { 1, 9 }, { 9, 1 }, { 2, 2 }, { 17, 30 }, { 64, 12 } })
  {
    for (int trial = 0; trial < 20; ++trial)
    {
      const BinaryImage image = randomImage(random, width, height);
      const SilhouetteRuns runs = runsOf(image);
      EXPECT_EQ(imageOf(runs).pixels, image.pixels);
      for (int row = 0; row < height; ++row)
      {
        for (int column = 0; column < width; ++column)
        {
          EXPECT_EQ(runs.at(column, row), image.at(column, row) != 0) << column << " " << row;
        }
        for (const PixelRun* run = runs.begin(row); run != runs.end(row); ++run)
        {
          EXPECT_LT(run->begin, run->end);
          EXPECT_TRUE(run == runs.begin(row) || run[-1].end < run->begin) << "they would touch";
        }
      }
      const auto places = contourPlaces(runs), expected = placesOf(image);
      ASSERT_EQ(places.size(), expected.size());
      for (std::size_t n = 0; n < places.size(); ++n)
      {
        EXPECT_TRUE(places[n].column == expected[n].column && places[n].row == expected[n].row && places[n].isBelow == expected[n].isBelow) << n;
      }
      contours += places.size();
    }
  }
  EXPECT_GT(contours, 1000u);
}

TEST(SilhouetteRuns, OfAnEmptyImageThereAreNone)
{
  const SilhouetteRuns runs = runsOf({ 3, 2, std::vector<std::uint8_t>(6, 0) });
  EXPECT_TRUE(runs.runs.empty());
  EXPECT_EQ(runs.firstOfRow.size(), 3u);
  EXPECT_FALSE(runs.at(2, 1));
  EXPECT_TRUE(contourPlaces(runs).empty());
}
