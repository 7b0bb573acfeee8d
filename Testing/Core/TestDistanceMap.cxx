// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceMap.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <limits>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

BinaryImage blank(int width, int height, std::uint8_t value)
{
  return { width, height, std::vector<std::uint8_t>(std::size_t(width) * height, value) };
}

/** Discs of object and of background, some across the border, and single pixels. */
BinaryImage randomMask(int width, int height, Random& random)
{
  BinaryImage image = blank(width, height, 0);
  for (int disc = 0; disc < 7; ++disc)
  {
    const double u = random.uniform(0, width), v = random.uniform(0, height);
    const double radius = random.uniform(0, 0.35 * std::min(width, height));
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        if (std::hypot(column - u, row - v) <= radius)
        {
          image.at(column, row) = disc % 3 != 2;
        }
      }
    }
  }
  for (int pixel = 0; pixel < 3; ++pixel)
  {
    image.at(random.below(width), random.below(height)) ^= 1;
  }
  return image;
}

/** What the header says of a pixel, over all pixels of the other kind, before it is cut off. */
double distanceByBruteForce(const BinaryImage& image, int column, int row)
{
  int nearest = std::numeric_limits<int>::max();
  const std::uint8_t kind = image.at(column, row);
  for (int r = 0; r < image.height; ++r)
  {
    for (int c = 0; c < image.width; ++c)
    {
      const int square = (c - column) * (c - column) + (r - row) * (r - row);
      nearest = image.at(c, r) != kind && square < nearest ? square : nearest;
    }
  }
  const double distance = nearest == std::numeric_limits<int>::max() ? 1e9 : std::sqrt(nearest) - 0.5;
  return kind ? distance : -distance;
}

DistanceMap mapOf(const BinaryImage& image, double reach)
{
  return distanceMap(image.pixels.data(), image.width, image.height, reach);
}

void expectBruteForce(const BinaryImage& image, std::initializer_list<double> reaches, const std::string& what)
{
  std::vector<double> expected;
  for (int p = 0; p < image.width * image.height; ++p)
  {
    expected.push_back(distanceByBruteForce(image, p % image.width, p / image.width));
  }
  for (const double reach : reaches)
  {
    const DistanceMap map = mapOf(image, reach);
    EXPECT_EQ(map.width, image.width);
    EXPECT_EQ(map.height, image.height);
    int wrong = 0;
    for (int p = 0; p < image.width * image.height; ++p)
    {
      const double found = map.at(p % image.width, p / image.width);
      wrong += !(std::abs(found - std::clamp(expected[p], -reach, reach)) <= 1e-4); // no number is wrong, too
    }
    EXPECT_EQ(wrong, 0) << what << ", reach " << reach;
  }
}

} // namespace

TEST(DistanceMap, IsThatToTheNearestPixelOfTheOtherKind)
{
  Random random(1);
  const int sizes[][2] = { { 1, 1 }, { 2, 1 }, { 1, 5 }, { 7, 3 }, { 16, 16 }, { 17, 33 }, { 64, 48 }, { 45, 70 } };
  for (const auto& size : sizes)
  {
    for (int run = 0; run < 3; ++run)
    {
      const BinaryImage image = randomMask(size[0], size[1], random);
      const std::string what = std::to_string(size[0]) + " x " + std::to_string(size[1]);
      expectBruteForce(image, { 1.0, 2.5, 6.0, 40.0 }, what);
    }
  }
}

/** Squares of distances fit into sixteen bits up to 127 pixels; others are longer. */
TEST(DistanceMap, HoldsOnBothSidesOfWhatFitsIntoSixteenBits)
{
  Random random(4);
  for (const std::uint8_t value : { 0, 1 })
  {
    BinaryImage wide = blank(460, 24, value); // in its middle nothing is near, in no column and in no row
    wide.at(3, 5) ^= 1;
    wide.at(455, 15) ^= 1;
    expectBruteForce(wide, { 100.0, 125.5, 126.0, 127.0, 140.0 }, "two pixels");
  }
  expectBruteForce(randomMask(420, 20, random), { 100.0, 125.5, 126.0, 127.0, 140.0 }, "a wide image");
}

TEST(DistanceMap, HoldsForEveryPlaceOfASinglePixel)
{
  for (const std::uint8_t value : { 0, 1 })
  {
    for (int row = 0; row < 40; row += 4)
    {
      for (int column = 0; column < 35; column += 3)
      {
        BinaryImage image = blank(35, 40, value);
        image.at(column, row) ^= 1;
        expectBruteForce(image, { 4.5 }, "a pixel");
      }
    }
  }
}

TEST(DistanceMap, FarFromAContourEverythingIsAtTheReach)
{
  BinaryImage image = blank(200, 150, 0);
  for (int row = 30; row < 120; ++row)
  {
    std::fill_n(&image.at(40, row), 120, std::uint8_t(1));
  }
  const DistanceMap map = mapOf(image, 7.0);
  for (int row = 0; row < 150; ++row)
  {
    for (int column = 0; column < 200; ++column)
    {
      // The rectangle's distance, in closed form: inside to the nearest side, outside to side or corner.
      const double dx = std::max(40 - column, column - 159), dy = std::max(30 - row, row - 119);
      const double out = std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) - 0.5;
      const double in = -std::max(dx, dy) + 0.5;
      const double expected = dx <= 0 && dy <= 0 ? std::min(in, 7.0) : -std::min(out, 7.0);
      ASSERT_NEAR(map.at(column, row), expected, 1e-5) << column << " " << row;
    }
  }
  EXPECT_LT(map.values.size(), 200u * 150u / 2u); // kept near the contour alone
}

TEST(DistanceMap, NothingAndEverything)
{
  const DistanceMap nothing = mapOf(blank(30, 20, 0), 5.0), everything = mapOf(blank(30, 20, 1), 5.0);
  for (double v = -12.0; v < 32.0; v += 1.7)
  {
    for (double u = -12.0; u < 42.0; u += 1.3)
    {
      EXPECT_EQ(nothing.at(u, v), -5.0f);
      const double du = u - std::clamp(u, 0.0, 29.0), dv = v - std::clamp(v, 0.0, 19.0);
      EXPECT_NEAR(everything.at(u, v), std::max(-5.0, 5.0 - std::hypot(du, dv)), 1e-5);
    }
  }
  EXPECT_EQ(nothing.width, 30);
  EXPECT_EQ(nothing.height, 20);
}

TEST(DistanceMap, BetweenPixelsItIsBilinearAndBeyondTheImageItFalls)
{
  Random random(2);
  const int n = 40;
  for (int run = 0; run < 5; ++run)
  {
    const BinaryImage image = randomMask(n, n, random);
    const double reach = 6.0;
    const DistanceMap map = mapOf(image, reach);
    std::vector<double> exact;
    for (int p = 0; p < n * n; ++p)
    {
      exact.push_back(std::clamp(distanceByBruteForce(image, p % n, p / n), -reach, reach));
    }
    for (int probe = 0; probe < 2000; ++probe)
    {
      const double u = random.uniform(-10, n + 9), v = random.uniform(-10, n + 9);
      const double x = std::clamp(u, 0.0, n - 1.0), y = std::clamp(v, 0.0, n - 1.0);
      const int c = std::min(int(x), n - 2), r = std::min(int(y), n - 2);
      const auto row = [&](int at) { return exact[at * n + c] * (1 - (x - c)) + exact[at * n + c + 1] * (x - c); };
      const double inner = row(r) * (1 - (y - r)) + row(r + 1) * (y - r);
      EXPECT_NEAR(map.at(u, v), std::max(-reach, inner - std::hypot(u - x, v - y)), 1e-4) << u << " " << v;
    }
  }
}

/** Samples beyond the image are those of its border's pixels, as far on: the places between them still have the right value. */
TEST(DistanceMap, SamplesAreAsExactAndBetweenThemItIsBilinear)
{
  Random random(6);
  const int sizes[][2] = { { 1, 1 }, { 1, 40 }, { 64, 48 }, { 131, 90 } };
  for (const auto& size : sizes)
  {
    const BinaryImage image = randomMask(size[0], size[1], random);
    for (const double reach : { 8.0, 25.0, 300.0 })
    {
      const DistanceMap every = mapOf(image, reach);
      for (const int spacing : { 2, 3, 7, 50 })
      {
        const DistanceMap some = distanceMap(image.pixels.data(), image.width, image.height, reach, spacing);
        ASSERT_EQ(some.spacing, std::min(spacing, int(reach)));
        int wrong = 0, sampled = 0;
        for (int row = 0; row <= some.lastRow; row += some.spacing)
        {
          for (int column = 0; column <= some.lastColumn; column += some.spacing, ++sampled)
          {
            const double u = some.left + column, v = some.top + row;
            wrong += std::abs(some.at(u, v) - every.at(u, v)) > 1e-4f;
            const double halfway = std::min(u + 0.5 * some.spacing, double(some.left + some.lastColumn));
            const double next = u + some.spacing;
            if (next <= some.left + some.lastColumn)
            {
              wrong += std::abs(some.at(halfway, v) - 0.5f * (every.at(u, v) + every.at(next, v))) > 1e-4f;
            }
          }
        }
        EXPECT_EQ(wrong, 0) << size[0] << " x " << size[1] << ", reach " << reach << ", spacing " << spacing;
        EXPECT_GE(sampled, (some.columns - 1) * (some.rows - 1));
      }
    }
  }
}

/** An object that the image cuts: its border's distance goes on beyond the last pixel. */
TEST(DistanceMap, TheLastSamplesGoOnBeyondTheImage)
{
  BinaryImage image = blank(30, 20, 0);
  for (int row = 5; row < 20; ++row)
  {
    std::fill_n(&image.at(9, row), 21, std::uint8_t(1));
  }
  const DistanceMap every = mapOf(image, 40.0), some = distanceMap(image.pixels.data(), 30, 20, 40.0, 4);
  EXPECT_EQ(some.columns, 9); // up to column 32
  EXPECT_EQ(some.rows, 6);    // up to row 20
  for (int row = 10; row < 20; ++row)
  {
    for (int column = 9; column < 30; ++column)
    {
      EXPECT_NEAR(some.at(column, row), every.at(column, row), 2.1) << column << " " << row;
    }
    // Right of the diagonal the rectangle's upper side is the nearest; there it is straight.
    EXPECT_NEAR(some.at(29, row), row - 5 + 0.5, 1e-4) << row;
  }
}

TEST(DistanceMap, OnDemandAndByProbeItIsTheSame)
{
  Random random(5);
  std::vector<BinaryImage> images{ blank(30, 20, 0), blank(33, 20, 1) };
  const int sizes[][2] = { { 1, 1 }, { 1, 40 }, { 17, 33 }, { 64, 48 }, { 130, 90 } };
  for (const auto& size : sizes)
  {
    images.push_back(randomMask(size[0], size[1], random));
  }
  for (const BinaryImage& image : images)
  {
    for (const double reach : { 2.0, 9.0, 2500.0 })
    {
      const DistanceMap map = mapOf(image, reach);
      DistancesOnDemand some(image.pixels.data(), image.width, image.height, reach);
      const DistanceProbe probe(image.pixels.data(), image.width, image.height, reach);
      for (int place = 0; place < 400; ++place)
      {
        const double u = random.uniform(-4, image.width + 4), v = random.uniform(-4, image.height + 4);
        ASSERT_EQ(probe.at(u, v), map.at(u, v)) << image.width << " x " << image.height << " at " << u << " " << v;
        ASSERT_EQ(some.at(u, v), map.at(u, v)) << image.width << " x " << image.height << " at " << u << " " << v;
      }
    }
  }
}

TEST(DistanceMap, WhatIsCalledFarInsideIsAtTheReach)
{
  Random random(3);
  int far = 0;
  for (int round = 0; round < 20; ++round)
  {
    const BinaryImage image = randomMask(90, 70, random);
    const DistanceMap map = mapOf(image, 3.0);
    for (int box = 0; box < 200; ++box)
    {
      const double u = random.uniform(-5, 90), v = random.uniform(-5, 70);
      const double width = random.uniform(0, 12), height = random.uniform(0, 12);
      if (!map.farInside(u, u + width, v, v + height))
      {
        continue;
      }
      ++far;
      for (int n = 0; n < 36; ++n)
      {
        EXPECT_NEAR(map.at(u + width * (n % 6) / 5.0, v + height * (n / 6) / 5.0), map.reach, 1e-5);
      }
    }
  }
  EXPECT_GT(far, 20);
}

TEST(DistanceMap, NeighboursInARowLieSideBySide)
{
  Random random(8);
  for (const int width : { 1, 15, 16, 17, 32, 50, 131 })
  {
    const BinaryImage image = randomMask(width, 40, random);
    for (const int spacing : { 1, 3 })
    {
      const DistanceMap map = distanceMap(image.pixels.data(), width, 40, 5.0, spacing);
      ASSERT_EQ(map.pieces.size(), std::size_t(map.across * map.rows));
      for (int row = 0; row < map.rows; ++row)
      {
        for (int column = 0; column + 1 < map.columns; ++column)
        {
          ASSERT_EQ(map.sample(row, column)[1], *map.sample(row, column + 1)) << width << ": " << column << " " << row;
        }
      }
    }
  }
}

TEST(DistanceMap, AMapperDoesNotRememberTheLastImage)
{
  Random random(9);
  DistanceMapper mapper;
  for (int run = 0; run < 60; ++run)
  {
    const BinaryImage image =
      run % 10 == 9 ? blank(20, 30, std::uint8_t(run / 10 % 2)) : randomMask(1 + random.below(150), 1 + random.below(90), random);
    const double reach = random.below(4) == 0 ? 140.0 : random.uniform(1.0, 30.0); // on both sides of what fits into sixteen bits
    const int spacing = 1 + random.below(4);
    const DistanceMap map = mapper.map(image.pixels.data(), image.width, image.height, reach, spacing);
    const DistanceMap fresh = distanceMap(image.pixels.data(), image.width, image.height, reach, spacing);
    ASSERT_EQ(map.pieces, fresh.pieces) << run;
    ASSERT_EQ(map.values, fresh.values) << run;
    ASSERT_EQ(map.blocksNear, fresh.blocksNear) << run;
  }
}
