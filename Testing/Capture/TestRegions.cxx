// SPDX-License-Identifier: BSD-3-Clause
#include "Regions.h"

#include "CaptureTesting.h"

#include <algorithm>
#include <cstdlib>

using namespace silhouette;

namespace
{

using Pixels = std::vector<std::pair<int, int>>;

/** Regions of `value`, flooded one by one, in the order of their first pixels. */
std::vector<Pixels> flooded(const BinaryImage& image, std::uint8_t value, bool diagonal)
{
  std::vector<Pixels> regions;
  BinaryImage seen = emptyImage(image.width, image.height);
  for (int start = 0; start < image.width * image.height; ++start)
  {
    Pixels region = {{start % image.width, start / image.width}};
    if (image.at(region[0].first, region[0].second) != value || seen.at(region[0].first, region[0].second))
    {
      continue;
    }
    seen.at(region[0].first, region[0].second) = 1;
    for (std::size_t next = 0; next < region.size(); ++next)
    {
      const auto [column, row] = region[next];
      for (int i = 0; i < 9; ++i)
      {
        const int dc = i % 3 - 1;
        const int dr = i / 3 - 1;
        const int c = column + dc;
        const int r = row + dr;
        if ((diagonal || std::abs(dc) + std::abs(dr) == 1) && c >= 0 && r >= 0 && c < image.width &&
            r < image.height && image.at(c, r) == value && !seen.at(c, r))
        {
          seen.at(c, r) = 1;
          region.emplace_back(c, r);
        }
      }
    }
    regions.push_back(region);
  }
  return regions;
}

BinaryImage largestByFlood(const BinaryImage& image)
{
  BinaryImage out = emptyImage(image.width, image.height);
  Pixels largest;
  for (const Pixels& region : flooded(image, 1, true))
  {
    largest = region.size() > largest.size() ? region : largest;
  }
  for (const auto& [column, row] : largest)
  {
    out.at(column, row) = 1;
  }
  return out;
}

BinaryImage filledByFlood(const BinaryImage& image, std::size_t pixels)
{
  BinaryImage out = image;
  for (const Pixels& region : flooded(image, 0, false))
  {
    const bool touches = std::any_of(region.begin(), region.end(),
                                     [&](const auto& p) {
                                       return p.first == 0 || p.second == 0 || p.first == image.width - 1 ||
                                              p.second == image.height - 1;
                                     });
    if (!touches && region.size() < pixels)
    {
      for (const auto& [column, row] : region)
      {
        out.at(column, row) = 1;
      }
    }
  }
  return out;
}

} // namespace

TEST(Regions, AgreeWithFlooding)
{
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    const BinaryImage image = randomImage(29, 21, 0.1 + 0.8 * seed / 60.0, seed);
    EXPECT_EQ(rowsOf(largestRegion(image)), rowsOf(largestByFlood(image))) << seed;
    for (const int pixels : {1, 2, 3, 10})
    {
      EXPECT_EQ(rowsOf(fillHoles(image, pixels)), rowsOf(filledByFlood(image, std::size_t(pixels)))) << seed;
    }
  }
}

TEST(Regions, OfEqualsTheFirstPixelDecides)
{
  EXPECT_EQ(rowsOf(largestRegion(drawn({".....##", "##.....", "......."}))),
            (std::vector<std::string>{".....##", ".......", "......."}));
  EXPECT_EQ(rowsOf(largestRegion(drawn({"......#", "##...#.", "......."}))),
            (std::vector<std::string>{"......#", ".....#.", "......."}));
}

TEST(Regions, EmptyAndFullImagesStay)
{
  const BinaryImage empty = emptyImage(4, 3);
  EXPECT_EQ(largestRegion(empty).pixels, empty.pixels);
  EXPECT_EQ(fillHoles(empty, 1000).pixels, empty.pixels);
  const BinaryImage full = drawn({"###", "###"});
  EXPECT_EQ(largestRegion(full).pixels, full.pixels);
  EXPECT_EQ(fillHoles(full, 1000).pixels, full.pixels);
}

TEST(Regions, HolesAreFourConnectedAndBelowTheLimit)
{
  const BinaryImage image = drawn({"#######", "#.##..#", "##.#..#", "#######", "#.#####"});
  EXPECT_EQ(rowsOf(fillHoles(image, 2)),
            (std::vector<std::string>{"#######", "####..#", "####..#", "#######", "#.#####"}));
  EXPECT_EQ(rowsOf(fillHoles(image, 4))[1], "####..#") << "four pixels are not fewer than four";
  EXPECT_EQ(rowsOf(fillHoles(image, 5))[1], "#######");
  EXPECT_EQ(rowsOf(fillHoles(image, 5))[4], "#.#####") << "open to the border";
}
