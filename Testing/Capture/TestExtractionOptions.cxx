// SPDX-License-Identifier: BSD-3-Clause
#include "ExtractionOptions.h"

#include "CaptureTesting.h"

#include <limits>

using namespace silhouette;

namespace
{

template <typename Change> std::string refusal(Change&& change)
{
  ExtractionOptions options;
  change(options);
  return errorOf([&] { validate(options); });
}

const double NotANumber = std::numeric_limits<double>::quiet_NaN();

} // namespace

TEST(ExtractionOptions, DefaultsAreValidAndWithoutCriteria)
{
  ExtractionOptions options;
  validate(options);
  EXPECT_FALSE(options.hasCriteria());
  options.invert = options.largestRegion = true;
  options.fillHoles = 9;
  options.morphology = {{MorphologyKind::Opening, 1}};
  options.tolerance = 1.0;
  EXPECT_FALSE(options.hasCriteria());
  options.alpha = true;
  EXPECT_TRUE(options.hasCriteria());
  EXPECT_TRUE((options = {}, options.key = ChromaKey{}, options).hasCriteria());
  EXPECT_TRUE((options = {}, options.threshold = 0.0, options).hasCriteria());
  EXPECT_TRUE((options = {}, options.background = {0.0, 0.0, 0.0}, options).hasCriteria());
}

TEST(ExtractionOptions, Key)
{
  const ChromaKey blue = parseKey("blue:0.08");
  EXPECT_EQ(blue.channel, ColourChannel::Blue);
  EXPECT_EQ(blue.excess, 0.08);
  EXPECT_EQ(parseKey(" Red : 1 ").channel, ColourChannel::Red);
  EXPECT_EQ(parseKey("green:1e-3").channel, ColourChannel::Green);
  EXPECT_EQ(errorOf([] { parseKey("cyan:0.1"); }), "key: expected red, green or blue, a colon and an excess "
                                                   "above 0 and at most 1, as in blue:0.08; got 'cyan:0.1'");
  for (const char* bad : {"", "blue", "blue:", ":0.1", "blue:0", "blue:-0.1", "blue:1.01", "blue:nan",
                          "blue:0,1", "blue:0.1:2", "blue 0.1"})
  {
    EXPECT_TRUE(holds(errorOf([&] { parseKey(bad); }), "as in blue:0.08; got '" + std::string(bad) + "'"));
  }
}

TEST(ExtractionOptions, Colour)
{
  EXPECT_EQ(parseColour("0, 1,0.75"), (std::array<double, 3>{0.0, 1.0, 0.75}));
  EXPECT_EQ(errorOf([] { parseColour("0,0,2"); }),
            "background: expected red, green and blue, each from 0 to 1, as in 0,0,0.75; got '0,0,2'");
  for (const char* bad : {"", "0,0", "0,0,0,0", "0,0,x", "0,,0", "nan,0,0", "-0.1,0,0", "blue"})
  {
    EXPECT_TRUE(holds(errorOf([&] { parseColour(bad); }), "as in 0,0,0.75; got '" + std::string(bad) + "'"));
  }
}

TEST(ExtractionOptions, ValidateNamesOptionAndValue)
{
  EXPECT_EQ(refusal(
                [](auto& o) {
                  o.key = ChromaKey{ColourChannel::Red, 0.0};
                }),
            "key: excess 0 is not a number above 0 and at most 1");
  EXPECT_EQ(refusal(
                [](auto& o) {
                  o.key = ChromaKey{ColourChannel::Red, NotANumber};
                }),
            "key: excess nan is not a number above 0 and at most 1");
  EXPECT_EQ(refusal(
                [](auto& o) {
                  o.background = {0.0, 1.5, 0.0};
                }),
            "background: 1.5 is not a number from 0 to 1");
  EXPECT_EQ(refusal(
                [](auto& o) {
                  o.background = {0.0, 0.0, NotANumber};
                }),
            "background: nan is not a number from 0 to 1");
  EXPECT_EQ(refusal([](auto& o) { o.tolerance = 3.5; }), "tolerance: 3.5 is not a number from 0 to 3");
  EXPECT_EQ(refusal([](auto& o) { o.tolerance = NotANumber; }), "tolerance: nan is not a number from 0 to 3");
  EXPECT_EQ(refusal([](auto& o) { o.threshold = -0.5; }), "threshold: -0.5 is not a number from 0 to 1");
  EXPECT_EQ(refusal([](auto& o) { o.threshold = NotANumber; }), "threshold: nan is not a number from 0 to 1");
  EXPECT_EQ(refusal([](auto& o) { o.fillHoles = -1; }), "fill-holes: -1 pixels is below 0");
}

TEST(ExtractionOptions, ValidateMorphology)
{
  using Kind = MorphologyKind;
  EXPECT_EQ(refusal(
                [](auto& o) {
                  o.morphology = {{Kind::Erode, -1}};
                }),
            "erode: radius -1 is not from 0 to 1000");
  EXPECT_EQ(refusal(
                [](auto& o) {
                  o.morphology = {{Kind::Dilate, 2000000000}};
                }),
            "dilate: radius 2000000000 is not from 0 to 1000");
  EXPECT_EQ(refusal(
                [](auto& o) {
                  o.morphology = {{Kind::Closing, 300}, {Kind::Opening, 201}};
                }),
            "opening: with radius 201 the morphology reaches 1002 pixels, opening and closing counted twice; at most 1000 are allowed");
  ExtractionOptions options;
  options.morphology = {{Kind::Closing, 300}, {Kind::Opening, 200}, {Kind::Erode, 0}};
  validate(options);
}
