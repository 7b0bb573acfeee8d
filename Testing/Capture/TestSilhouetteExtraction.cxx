// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteExtraction.h"

#include "CaptureTesting.h"

#include <algorithm>

using namespace silhouette;

namespace
{

/** An image of one row. */
ColourImage row(int channels, std::vector<std::uint8_t> bytes)
{
  return {int(bytes.size()) / channels, 1, channels, std::move(bytes)};
}

std::vector<std::uint8_t> object(const ColourImage& image, const ExtractionOptions& options = {},
                                 bool isMask = false)
{
  return extractSilhouette(image, options, isMask, "a.png").pixels;
}

std::string refusal(const ColourImage& image, const ExtractionOptions& options = {}, bool isMask = false)
{
  return errorOf([&] { extractSilhouette(image, options, isMask, "a.png"); });
}

using Bytes = std::vector<std::uint8_t>;

} // namespace

TEST(SilhouetteExtraction, KeyAtItsBoundary)
{
  ExtractionOptions options;
  options.key = parseKey("blue:0.08"); // 20.4 of 255
  EXPECT_EQ(object(row(3, {10, 100, 120, 10, 100, 121, 100, 10, 120, 100, 10, 121, 0, 0, 0}), options),
            (Bytes{1, 0, 1, 0, 1}));
  options.key = parseKey("green:0.2"); // exactly 51 of 255
  EXPECT_EQ(object(row(3, {9, 60, 10, 9, 61, 10, 10, 60, 9, 10, 61, 9}), options), (Bytes{1, 0, 1, 0}));
  options.key = parseKey("red:0.6"); // exactly 153 of 255
  EXPECT_EQ(object(row(3, {152, 0, 0, 153, 0, 0, 255, 0, 103, 255, 102, 0}), options), (Bytes{1, 0, 1, 0}));
  options.key = parseKey("red:1e-12"); // an excess of nothing is no excess
  EXPECT_EQ(object(row(3, {7, 7, 7, 8, 7, 7}), options), (Bytes{1, 0}));
  options.key = parseKey("red:1");
  EXPECT_EQ(object(row(3, {254, 0, 0, 255, 0, 0}), options), (Bytes{1, 0}));
}

TEST(SilhouetteExtraction, EveryDecimalLimitOfAnEightBitValueIsExact)
{
  for (int value = 1; value <= 255; ++value)
  {
    ExtractionOptions options;
    options.threshold = value / 255.0;
    const auto v = std::uint8_t(value);
    const Bytes expected = value < 255 ? Bytes{0, 1} : Bytes{0, 0};
    EXPECT_EQ(object(row(1, {v, std::uint8_t(std::min(255, value + 1))}), options), expected) << value;
    options = {};
    options.key = ChromaKey{ColourChannel::Blue, value / 255.0};
    EXPECT_EQ(object(row(3, {0, 0, std::uint8_t(value - 1), 0, 0, v}), options), (Bytes{1, 0})) << value;
    options = {};
    options.background = {value / 255.0, 0.0, 0.0};
    options.tolerance = 0.0;
    EXPECT_EQ(object(row(3, {v, 0, 0, std::uint8_t(value - 1), 0, 0, v, 1, 0}), options), (Bytes{0, 1, 1}));
  }
}

TEST(SilhouetteExtraction, ThresholdLooksAtTheLargestChannel)
{
  ExtractionOptions options;
  options.threshold = 0.12; // 30.6
  EXPECT_EQ(object(row(3, {30, 30, 30, 0, 31, 0, 30, 0, 0, 0, 0, 31}), options), (Bytes{0, 1, 0, 1}));
  EXPECT_EQ(object(row(1, {30, 31}), options), (Bytes{0, 1}));
  EXPECT_EQ(object(row(2, {30, 255, 31, 0}), options), (Bytes{0, 1})) << "alpha was not asked for";
  options.threshold = 0.0;
  EXPECT_EQ(object(row(1, {0, 1}), options), (Bytes{0, 1}));
  options.threshold = 1.0;
  EXPECT_EQ(object(row(1, {0, 255}), options), (Bytes{0, 0}));
}

TEST(SilhouetteExtraction, BackgroundIsASummedDistance)
{
  ExtractionOptions options;
  options.background = parseColour("0,0,0.75");
  options.tolerance = 1.1; // 280.5 of 255, from blue 191.25
  EXPECT_EQ(object(row(3, {100, 100, 111, 100, 100, 110, 89, 0, 0, 90, 0, 0, 0, 0, 191}), options),
            (Bytes{0, 1, 0, 1, 0}));
  options.background = parseColour("1,1,1");
  options.tolerance = 0.0;
  EXPECT_EQ(object(row(1, {255, 254}), options), (Bytes{0, 1})) << "grey is a colour";
  options.tolerance = 3.0;
  EXPECT_EQ(object(row(3, {0, 0, 0}), options), (Bytes{0}));
}

TEST(SilhouetteExtraction, CriteriaAreJoinedByOr)
{
  ExtractionOptions options;
  options.key = parseKey("blue:0.08");
  options.threshold = 0.12;
  options.background = parseColour("1,1,1");
  options.tolerance = 0.0;
  options.alpha = true;
  EXPECT_EQ(
      object(row(4, {0, 0, 99, 255, 9, 9, 9, 255, 255, 255, 255, 255, 90, 90, 90, 127, 90, 90, 90, 128}),
             options),
      (Bytes{0, 0, 0, 0, 1}));
}

TEST(SilhouetteExtraction, PolarityMorphologyRegionAndHolesInThatOrder)
{
  // Object dark on light: a ring of 7 x 7 with a hole of one pixel, and a dot that the opening removes.
  ColourImage image{14, 11, 1, Bytes(14 * 11, 255)};
  const auto put = [&](int column, int r, std::uint8_t value)
  { image.pixels[std::size_t(r * 14 + column)] = value; };
  for (int r = 2; r < 9; ++r)
  {
    for (int column = 2; column < 9; ++column)
    {
      put(column, r, 0);
    }
  }
  put(5, 5, 255);
  put(11, 5, 0);
  ExtractionOptions options;
  options.invert = true;
  BinaryImage out = extractSilhouette(image, options, false);
  EXPECT_EQ(std::count(out.pixels.begin(), out.pixels.end(), 1), 49);
  options.morphology = {{MorphologyKind::Opening, 1}};
  EXPECT_EQ(rowsOf(extractSilhouette(image, options, false))[5], "..###.###.....");
  options.morphology.clear();
  options.largestRegion = true;
  EXPECT_EQ(rowsOf(extractSilhouette(image, options, false))[5], "..###.###.....");
  options.fillHoles = 2;
  EXPECT_EQ(rowsOf(extractSilhouette(image, options, false))[5], "..#######.....");
  options.fillHoles = 1;
  EXPECT_EQ(rowsOf(extractSilhouette(image, options, false))[5], "..###.###.....");
  // Regions after morphology: closing joins the dot to the ring first.
  options.morphology = {{MorphologyKind::Closing, 2}};
  EXPECT_EQ(extractSilhouette(image, options, false).at(11, 5), 1);
}

TEST(SilhouetteExtraction, MasksOfAnyKind)
{
  EXPECT_EQ(object(row(1, {0, 255, 0})), (Bytes{0, 1, 0}));
  EXPECT_EQ(object(row(1, {0, 1, 0})), (Bytes{0, 1, 0})) << "0 and 1";
  EXPECT_EQ(object(row(1, {0, 128, 0})), (Bytes{0, 1, 0}));
  EXPECT_EQ(object(row(3, {0, 0, 0, 255, 255, 255})), (Bytes{0, 1}));
  EXPECT_EQ(object(row(3, {0, 0, 0, 128, 0, 0})), (Bytes{0, 1})) << "palette colours";
  EXPECT_EQ(object(row(1, {0, 0})), (Bytes{0, 0})) << "an empty silhouette";
  EXPECT_EQ(object(row(1, {255, 255})), (Bytes{1, 1}));
  EXPECT_EQ(object(row(1, {0, 127, 128, 200, 255}), {}, true), (Bytes{0, 0, 1, 1, 1})) << "smooth edges";
  EXPECT_EQ(object(row(1, {0, 1, 1}), {}, true), (Bytes{0, 1, 1}));
  EXPECT_EQ(object(row(1, {0, 1, 2}), {}, true), (Bytes{0, 0, 0})) << "noise about black";
}

TEST(SilhouetteExtraction, AlphaThatSaysSomethingIsTheSilhouette)
{
  EXPECT_EQ(object(row(4, {9, 8, 7, 0, 5, 4, 3, 127, 5, 4, 3, 128, 1, 2, 3, 255})), (Bytes{0, 0, 1, 1}));
  EXPECT_EQ(object(row(2, {9, 0, 5, 255})), (Bytes{0, 1}));
  EXPECT_EQ(object(row(4, {9, 8, 7, 0, 5, 4, 3, 0})), (Bytes{0, 0}));
  EXPECT_EQ(object(row(4, {0, 0, 0, 255, 255, 255, 255, 255})), (Bytes{0, 1}))
      << "opaque: the colours are it";
}

TEST(SilhouetteExtraction, PhotographsAreRefusedWithAdvice)
{
  EXPECT_EQ(refusal(row(3, {1, 2, 3, 40, 50, 60, 200, 100, 0})),
            "view 'a.png': a photograph without a mask or alpha is no silhouette; say what its background is: "
            "by a key channel, a colour, a threshold or its alpha");
  EXPECT_TRUE(holds(refusal(row(1, {0, 127, 255})), "a photograph without a mask"));
  EXPECT_TRUE(holds(refusal(row(1, {0, 100, 0})),
                    "view 'a.png': an image of two colours, but both are on the same side"));
  for (const unsigned char value : {2, 15, 100, 127})
  {
    const std::string of = errorOf([&] { extractSilhouette(row(1, {0, value, 0}), {}, true, "a.png"); });
    EXPECT_TRUE(holds(of, "both are on the same side of 127")) << int(value) << ": a mask, too";
  }
  EXPECT_TRUE(holds(refusal(row(3, {0, 0, 255, 255, 0, 0})), "both are on the same side of 127"));
}

TEST(SilhouetteExtraction, BadImages)
{
  EXPECT_EQ(refusal({0, 3, 1, {}}), "view 'a.png': the image has no pixels (0 x 3)");
  EXPECT_TRUE(holds(refusal({1, 1, 5, Bytes(5, 0)}), "view 'a.png': the image has 5 channels"));
  EXPECT_EQ(refusal({2, 2, 3, Bytes(11, 0)}), "view 'a.png': the image holds 11 bytes; its size asks for 12");
  EXPECT_EQ(refusal({2000000000, 2000000000, 4, {}}),
            "view 'a.png': the image holds 0 bytes; its size asks for 16000000000000000000");
  ExtractionOptions options;
  options.key = ChromaKey{};
  EXPECT_EQ(refusal(row(1, {1, 2}), options), "view 'a.png': a key needs a colour image; this one is grey");
  options = {};
  options.alpha = true;
  EXPECT_EQ(refusal(row(3, {1, 2, 3}), options),
            "view 'a.png': alpha was asked for, but the image has no alpha channel");
  options = {};
  options.tolerance = 4.0;
  EXPECT_EQ(refusal(row(1, {0}), options), "tolerance: 4 is not a number from 0 to 3");
}
