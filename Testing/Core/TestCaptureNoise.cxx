// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureNoise.h"

#include "Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

using namespace silhouette;

namespace
{

/** Object up to a column, `size` pixels a side. */
BinaryImage halfPlane(int size)
{
  BinaryImage mask{size, size, std::vector<std::uint8_t>(std::size_t(size) * size, 0)};
  for (int row = 0; row < size; ++row)
  {
    std::fill_n(&mask.at(0, row), size / 2, std::uint8_t(1));
  }
  return mask;
}

long area(const BinaryImage& mask)
{
  return std::accumulate(mask.pixels.begin(), mask.pixels.end(), 0L);
}

int objectInRow(const BinaryImage& mask, int row)
{
  const auto first = mask.pixels.begin() + std::ptrdiff_t(row) * mask.width;
  return std::accumulate(first, first + mask.width, 0);
}

TEST(CaptureNoise, numbersAreKnownForEver)
{
  // The finisher's constants give this first number for key 0 on every machine; another would change all
  // captures.
  EXPECT_EQ(uniformAt(0, 0), std::ldexp(double(0xe220a8397b1dcdafULL >> 11), -53));
  std::set<std::uint64_t> keys;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    for (std::size_t view = 0; view < 20; ++view)
    {
      keys.insert(noiseKey(seed, NoiseKind::Contour, view));
      keys.insert(noiseKey(seed, NoiseKind::Pixels, view));
    }
  }
  EXPECT_EQ(keys.size(), 800u);
}

TEST(CaptureNoise, gaussianMoments)
{
  constexpr int count = 100000;
  double sums[4] = {};
  for (int i = 0; i < count; ++i)
  {
    const double x = gaussianAt(7, std::uint64_t(i));
    double power = 1.0;
    for (double& sum : sums)
    {
      power *= x;
      sum += power / count;
    }
  }
  EXPECT_NEAR(sums[0], 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(sums[1], 1.0, 6.0 / std::sqrt(count));
  EXPECT_NEAR(sums[2], 0.0, 0.05);
  EXPECT_NEAR(sums[3], 2.9, 0.1); // 3 - 1.2 / 12 for a sum of twelve
}

TEST(CaptureNoise, contourMovesByTheStatedDeviation)
{
  const BinaryImage mask = halfPlane(1024);
  for (const double sigma : {1.0, 2.0, 4.0})
  {
    double sum = 0.0;
    double squares = 0.0;
    double absolute = 0.0;
    int count = 0;
    for (std::uint64_t key = 0; key < 3; ++key)
    {
      const BinaryImage noisy = addContourNoise(mask, sigma, key);
      for (int row = 0; row < noisy.height; ++row)
      {
        const int object = objectInRow(noisy, row);
        sum += object - 512;
        squares += double(object - 512) * (object - 512);
        absolute += std::abs(object - 512);
        ++count;
      }
    }
    // A row in ten or so is independent. Rounding to whole pixels adds 1 / 12 to the variance; a wide swing
    // crosses the smooth field where it has gone back already, which takes some away.
    EXPECT_NEAR(sum / count, 0.0, 0.2 * sigma);
    const double deviation = std::sqrt(squares / count - 1.0 / 12.0);
    EXPECT_NEAR(deviation, sigma, 0.12 * sigma);
    EXPECT_NEAR(absolute / count, sigma * std::sqrt(2.0 / 3.14159265), 0.15 * sigma);
  }
}

TEST(CaptureNoise, contourIsSmoothOverSixPixels)
{
  const BinaryImage mask = halfPlane(1024);
  double products[3] = {};
  const int lags[3] = {2, 6, 24};
  double squares = 0.0;
  for (std::uint64_t key = 10; key < 13; ++key)
  {
    const BinaryImage noisy = addContourNoise(mask, 3.0, key);
    std::vector<double> moved;
    for (int row = 0; row < noisy.height; ++row)
    {
      moved.push_back(objectInRow(noisy, row) - 512);
    }
    for (int row = 0; row + 24 < noisy.height; ++row)
    {
      squares += moved[row] * moved[row];
      for (int i = 0; i < 3; ++i)
      {
        products[i] += moved[row] * moved[row + lags[i]];
      }
    }
  }
  // The field's correlation at distance d is about exp(-d^2 / (4 * 6^2)).
  EXPECT_NEAR(products[0] / squares, 0.97, 0.05);
  EXPECT_NEAR(products[1] / squares, 0.78, 0.10);
  EXPECT_NEAR(products[2] / squares, 0.02, 0.12);
}

TEST(CaptureNoise, distancesAreEuclidean)
{
  // One object pixel and much noise against a brute-force rule: no pixel further away than eight deviations
  // changes.
  BinaryImage mask{101, 81, std::vector<std::uint8_t>(101 * 81, 0)};
  mask.at(50, 40) = 1;
  const double sigma = 2.0;
  const BinaryImage noisy = addContourNoise(mask, sigma, 3);
  for (int row = 0; row < 81; ++row)
  {
    for (int column = 0; column < 101; ++column)
    {
      if (std::hypot(column - 50, row - 40) > 8.0 * sigma + 1.5)
      {
        EXPECT_EQ(noisy.at(column, row), 0);
      }
    }
  }
  // A disc grows and shrinks alike in all directions, which block or chessboard distances would not give.
  BinaryImage disc{512, 512, std::vector<std::uint8_t>(512 * 512, 0)};
  for (int row = 0; row < 512; ++row)
  {
    for (int column = 0; column < 512; ++column)
    {
      disc.at(column, row) = std::hypot(column - 256, row - 256) < 150 ? 1 : 0;
    }
  }
  double straight = 0.0;
  double diagonal = 0.0;
  int straights = 0;
  int diagonals = 0;
  for (std::uint64_t key = 0; key < 10; ++key)
  {
    const BinaryImage rough = addContourNoise(disc, 3.0, key);
    for (int row = 0; row < 512; ++row)
    {
      for (int column = 0; column < 512; ++column)
      {
        if (rough.at(column, row) != disc.at(column, row))
        {
          const double radius = std::abs(std::hypot(column - 256, row - 256) - 150);
          const bool isDiagonal = std::abs(std::abs(column - 256) - std::abs(row - 256)) < 80;
          (isDiagonal ? diagonal : straight) += radius;
          ++(isDiagonal ? diagonals : straights);
        }
      }
    }
  }
  EXPECT_NEAR(straight / straights, diagonal / diagonals, 0.2);
}

TEST(CaptureNoise, noContourNoMovement)
{
  BinaryImage full{40, 30, std::vector<std::uint8_t>(1200, 1)};
  EXPECT_EQ(addContourNoise(full, 1.0, 5).pixels, full.pixels);
  const BinaryImage half = halfPlane(64);
  EXPECT_EQ(addContourNoise(half, 0.0, 5).pixels, half.pixels);
  const BinaryImage single{1, 1, {1}};
  EXPECT_EQ(addContourNoise(single, 4.0, 5).pixels, single.pixels);
}

TEST(CaptureNoise, blobsCutThreeDiscs)
{
  const BinaryImage full{1024, 1024, std::vector<std::uint8_t>(1024 * 1024, 1)};
  double mean = 0.0;
  for (std::uint64_t key = 0; key < 40; ++key)
  {
    const long cut = 1024L * 1024L - area(cutBlobs(full, key));
    EXPECT_GT(cut, 0);
    EXPECT_LE(cut, long(3.0 * 3.15 * 26.0 * 26.0));
    mean += cut / 40.0;
  }
  // Three times pi times the mean square of a radius uniform in [8, 25], less what overlaps and leaves the
  // image.
  EXPECT_NEAR(mean, 3.0 * 3.14159 * 296.3, 450.0);

  const BinaryImage empty{8, 8, std::vector<std::uint8_t>(64, 0)};
  EXPECT_EQ(cutBlobs(empty, 1).pixels, empty.pixels);
  const BinaryImage half = halfPlane(256);
  const BinaryImage holed = cutBlobs(half, 1);
  for (std::size_t i = 0; i < half.pixels.size(); ++i)
  {
    EXPECT_LE(holed.pixels[i], half.pixels[i]);
  }
}

TEST(CaptureNoise, pixelsFlipWithTheStatedShare)
{
  const BinaryImage mask = halfPlane(1000);
  for (const double share : {0.0, 0.01, 0.3, 1.0})
  {
    const BinaryImage noisy = flipPixels(mask, share, 9);
    long flipped = 0;
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    {
      EXPECT_LE(noisy.pixels[i], 1);
      flipped += noisy.pixels[i] != mask.pixels[i] ? 1 : 0;
    }
    EXPECT_NEAR(double(flipped) / 1e6, share, 5.0 * std::sqrt(share * (1.0 - share) / 1e6));
  }
}

TEST(CaptureNoise, anotherKeyIsOtherNoise)
{
  const BinaryImage mask = halfPlane(256);
  EXPECT_EQ(addContourNoise(mask, 2.0, 1).pixels, addContourNoise(mask, 2.0, 1).pixels);
  EXPECT_NE(addContourNoise(mask, 2.0, 1).pixels, addContourNoise(mask, 2.0, 2).pixels);
  EXPECT_NE(cutBlobs(mask, 1).pixels, cutBlobs(mask, 2).pixels);
  EXPECT_NE(flipPixels(mask, 0.1, 1).pixels, flipPixels(mask, 0.1, 2).pixels);
}

TEST(CaptureNoise, refusesStrengthsOutOfRange)
{
  const BinaryImage mask = halfPlane(16);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-0.1, 1001.0, nan})
  {
    EXPECT_THROW(addContourNoise(mask, bad, 0), InvalidInput);
    EXPECT_THROW(flipPixels(mask, bad, 0), InvalidInput);
  }
}

} // namespace
