// SPDX-License-Identifier: BSD-3-Clause
#include "Morphology.h"

#include "CaptureTesting.h"

#include <algorithm>
#include <cmath>

using namespace silhouette;
using Kind = MorphologyKind;

namespace
{

/** A window on the plane: pixel (0, 0) of the image is at (margin, margin). */
BinaryImage window(const BinaryImage& image, int margin)
{
  BinaryImage plane = emptyImage(image.width + 2 * margin, image.height + 2 * margin);
  for (int row = 0; row < plane.height; ++row)
  {
    for (int column = 0; column < plane.width; ++column)
    {
      plane.at(column, row) = image.at(std::clamp(column - margin, 0, image.width - 1),
                                       std::clamp(row - margin, 0, image.height - 1));
    }
  }
  return plane;
}

/** The definition: does a pixel of `value` lie within R + 0.5? Pixels beyond the window count as nothing. */
BinaryImage spread(const BinaryImage& image, std::uint8_t value, int radius)
{
  BinaryImage out = image;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      for (int r = std::max(0, row - radius); r <= std::min(image.height - 1, row + radius); ++r)
      {
        for (int c = std::max(0, column - radius); c <= std::min(image.width - 1, column + radius); ++c)
        {
          if (image.at(c, r) == value && std::hypot(c - column, r - row) <= radius + 0.5)
          {
            out.at(column, row) = value;
          }
        }
      }
    }
  }
  return out;
}

BinaryImage bruteForce(const BinaryImage& image, const std::vector<MorphologyOperation>& operations)
{
  int margin = 1;
  for (const auto& operation : operations)
  {
    margin += 2 * operation.radius;
  }
  BinaryImage plane = window(image, margin);
  for (const auto& [kind, radius] : operations)
  {
    const bool dilateFirst = kind == Kind::Dilate || kind == Kind::Closing;
    plane = spread(plane, dilateFirst ? 1 : 0, radius);
    if (kind == Kind::Opening || kind == Kind::Closing)
    {
      plane = spread(plane, dilateFirst ? 0 : 1, radius);
    }
  }
  BinaryImage out = image;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      out.at(column, row) = plane.at(column + margin, row + margin);
    }
  }
  return out;
}

void expectSame(const BinaryImage& image, const std::vector<MorphologyOperation>& operations)
{
  EXPECT_EQ(rowsOf(applyMorphology(image, operations)), rowsOf(bruteForce(image, operations)));
}

bool contains(const BinaryImage& larger, const BinaryImage& smaller)
{
  return std::equal(larger.pixels.begin(), larger.pixels.end(), smaller.pixels.begin(),
                    [](std::uint8_t l, std::uint8_t s) { return l >= s; });
}

} // namespace

TEST(Morphology, RadiusOneIsThreeByThreeAndTwoARoundedFive)
{
  BinaryImage dot = emptyImage(7, 7);
  dot.at(3, 3) = 1;
  EXPECT_EQ(rowsOf(applyMorphology(dot, {{Kind::Dilate, 1}})),
            (std::vector<std::string>{".......", ".......", "..###..", "..###..", "..###..", ".......",
                                      "......."}));
  EXPECT_EQ(rowsOf(applyMorphology(dot, {{Kind::Dilate, 2}})),
            (std::vector<std::string>{".......", "..###..", ".#####.", ".#####.", ".#####.", "..###..",
                                      "......."}));
  EXPECT_EQ(rowsOf(applyMorphology(dot, {{Kind::Dilate, 0}})), rowsOf(dot));
  EXPECT_EQ(rowsOf(applyMorphology(dot, {})), rowsOf(dot));
}

TEST(Morphology, AgreesWithTheDefinition)
{
  unsigned seed = 1;
  for (const double share : {0.02, 0.3, 0.7, 0.97})
  {
    for (const Kind kind : {Kind::Opening, Kind::Closing, Kind::Dilate, Kind::Erode})
    {
      for (const int radius : {1, 2, 3, 8, 9, 12})
      {
        expectSame(randomImage(23, 17, share, seed++), {{kind, radius}});
      }
    }
  }
}

TEST(Morphology, ListsRunInOrder)
{
  for (unsigned seed = 100; seed < 104; ++seed)
  {
    const BinaryImage image = randomImage(31, 19, 0.4, seed);
    expectSame(image, {{Kind::Dilate, 4}, {Kind::Erode, 3}});
    expectSame(image, {{Kind::Erode, 1}, {Kind::Dilate, 10}, {Kind::Erode, 9}});
    expectSame(image, {{Kind::Opening, 1}, {Kind::Closing, 2}, {Kind::Erode, 1}});
  }
}

TEST(Morphology, LargeRadii)
{
  BinaryImage dots = emptyImage(90, 30);
  dots.at(3, 5) = dots.at(80, 22) = 1;
  expectSame(dots, {{Kind::Dilate, 31}});
  BinaryImage empty = emptyImage(5, 4);
  EXPECT_EQ(applyMorphology(empty, {{Kind::Dilate, 1000}}).pixels, empty.pixels);
  BinaryImage full = empty;
  std::fill(full.pixels.begin(), full.pixels.end(), std::uint8_t(1));
  EXPECT_EQ(applyMorphology(full, {{Kind::Erode, 1000}}).pixels, full.pixels);
  EXPECT_EQ(applyMorphology(full, {{Kind::Opening, 500}}).pixels, full.pixels);
}

TEST(Morphology, LargeDiscsAreExact)
{
  // Whole squares beside the limit R^2 + R, where a float is coarsest.
  const int radius = 1000;
  BinaryImage dot = emptyImage(1500, 3);
  dot.at(0, 1) = 1;
  // The plane continues the left border's column to the left; the nearest object of any pixel is still (0,
  // 1).
  const BinaryImage out = applyMorphology(dot, {{Kind::Dilate, radius}});
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < dot.width; ++column)
    {
      const long square = long(column) * column + (row - 1) * (row - 1);
      ASSERT_EQ(out.at(column, row), square <= long(radius) * radius + radius ? 1 : 0)
          << column << ' ' << row;
    }
  }
}

TEST(Morphology, TheBorderNeitherEatsNorFeeds)
{
  // An object that the border cuts off is not eaten from there, and not thinned either.
  const BinaryImage cut = drawn({"..####", "..####", "..####", "......", "......"});
  EXPECT_EQ(rowsOf(applyMorphology(cut, {{Kind::Erode, 1}})),
            (std::vector<std::string>{"...###", "...###", "......", "......", "......"}));
  EXPECT_EQ(rowsOf(applyMorphology(cut, {{Kind::Opening, 1}})), rowsOf(cut));
  // One that stands off is not drawn to the border: grown by 4 - 3, wherever it lies.
  const BinaryImage off = drawn({"........", "........", "........", "...##...", "...##...", "........"});
  EXPECT_EQ(rowsOf(applyMorphology(off, {{Kind::Closing, 4}})), rowsOf(off));
  const BinaryImage grown = applyMorphology(off, {{Kind::Dilate, 4}, {Kind::Erode, 3}});
  EXPECT_EQ(rowsOf(grown)[1], "........");
  EXPECT_EQ(rowsOf(grown)[2], "..####..");
}

TEST(Morphology, OpeningTakesAwayClosingAdds)
{
  for (unsigned seed = 200; seed < 210; ++seed)
  {
    const BinaryImage image = randomImage(40, 30, 0.6, seed);
    for (const int radius : {1, 2, 9})
    {
      EXPECT_TRUE(contains(image, applyMorphology(image, {{Kind::Opening, radius}})));
      EXPECT_TRUE(contains(applyMorphology(image, {{Kind::Closing, radius}}), image));
    }
  }
}
