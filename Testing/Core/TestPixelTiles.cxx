// SPDX-License-Identifier: BSD-3-Clause
#include "PixelTiles.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

struct Image
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
  PixelTiles tiles;

  /** Few or many object pixels, so that ranges of one kind occur; any value but 0 is object. */
  Image(Random& random, int w, int h, int rarity)
    : width(w)
    , height(h)
  {
    const bool rare = random.below(2) == 0;
    for (int i = 0; i < w * h; ++i)
    {
      const bool odd = random.below(rarity) == 0;
      this->pixels.push_back(odd == rare ? std::uint8_t(1 + random.below(255)) : std::uint8_t(0));
    }
    this->tiles = PixelTiles(this->pixels.data(), w, h);
  }
  bool object(int column, int row) const { return this->pixels[std::size_t(row) * this->width + column] != 0; }
  std::int64_t count(int c0, int c1, int r0, int r1) const
  {
    std::int64_t total = 0;
    for (int row = r0; row < r1; ++row)
    {
      for (int column = c0; column < c1; ++column)
      {
        total += this->object(column, row);
      }
    }
    return total;
  }
};

std::vector<Image> images()
{
  Random random(11);
  std::vector<Image> all;
  for (const int rarity : { 2, 40, 4000 })
  {
    for (int n = 0; n < 8; ++n)
    {
      all.emplace_back(random, 1 + random.below(70), 1 + random.below(70), rarity);
    }
  }
  return all;
}

} // namespace

TEST(PixelTiles, EveryPixelAndEveryWindow)
{
  for (const Image& image : images())
  {
    for (int row = 0; row < image.height; ++row)
    {
      for (int column = 0; column < image.width; ++column)
      {
        ASSERT_EQ(image.tiles.object(column, row), image.object(column, row));
        std::uint64_t expected = 0;
        for (int bit = 0; bit < 64; ++bit)
        {
          const int c = column + bit % 8, r = row + bit / 8;
          expected |= std::uint64_t(c < image.width && r < image.height && image.object(c, r)) << bit;
        }
        ASSERT_EQ(image.tiles.window(column, row), expected) << column << ", " << row;
      }
    }
  }
}

TEST(PixelTiles, ContentAndCountOfAnyRange)
{
  Random random(12);
  for (const Image& image : images())
  {
    for (int trial = 0; trial < 400; ++trial)
    {
      const int c0 = random.below(image.width), c1 = c0 + random.below(image.width - c0);
      const int r0 = random.below(image.height), r1 = r0 + random.below(image.height - r0);
      const std::int64_t objects = image.count(c0, c1 + 1, r0, r1 + 1);
      const TileContent content = image.tiles.content(c0, c1, r0, r1);
      ASSERT_EQ(content.object, objects > 0);
      ASSERT_EQ(content.background, objects < std::int64_t(c1 - c0 + 1) * (r1 - r0 + 1));
      ASSERT_EQ(image.tiles.count(c0, c1 + 1, r0, r1 + 1), objects);
      ASSERT_EQ(image.tiles.count(c0, c0, r0, r1), 0);
    }
    ASSERT_EQ(image.tiles.count(0, image.width, 0, image.height), image.count(0, image.width, 0, image.height));
  }
}

TEST(PixelTiles, TheBoxOfTheObject)
{
  for (const Image& image : images())
  {
    std::array<int, 4> expected = { image.width, -1, image.height, -1 };
    for (int row = 0; row < image.height; ++row)
    {
      for (int column = 0; column < image.width; ++column)
      {
        if (image.object(column, row))
        {
          expected = { std::min(expected[0], column), std::max(expected[1], column), std::min(expected[2], row),
            std::max(expected[3], row) };
        }
      }
    }
    EXPECT_EQ(image.tiles.objectBox(), expected);
  }
  const std::vector<std::uint8_t> nothing(20 * 9, 0);
  EXPECT_EQ(PixelTiles(nothing.data(), 20, 9).objectBox(), (std::array<int, 4>{ 20, -1, 9, -1 }));
}
