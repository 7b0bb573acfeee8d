// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteExtraction.h"

#include "Error.h"
#include "Morphology.h"
#include "Regions.h"
#include "TextParsing.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace silhouette
{

namespace
{

constexpr int Half = 127; // object is above it
/** Limits are decimals: 0.2 * 255 is 51, whatever the rounding of either. */
constexpr double DecimalSlack = 1e-9;

std::string inView(const std::string& name)
{
  return name.empty() ? std::string() : "view " + inQuotes(name) + ": ";
}

struct Pixel
{
  int red = 0;
  int green = 0;
  int blue = 0;
  int alpha = 255;

  int largest() const { return std::max({this->red, this->green, this->blue}); }
  int colour() const { return (this->red << 16) | (this->green << 8) | this->blue; }
};

bool hasAlpha(const ColourImage& image)
{
  return image.channels == 2 || image.channels == 4;
}

/** Call `visit(index, pixel)` for every pixel. */
template <typename Visit> void forPixels(const ColourImage& image, Visit&& visit)
{
  const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
  const bool colour = image.channels >= 3;
  const bool alpha = hasAlpha(image);
  const std::uint8_t* p = image.pixels.data();
  for (std::size_t i = 0; i < count; ++i, p += image.channels)
  {
    visit(i, Pixel{p[0], p[colour ? 1 : 0], p[colour ? 2 : 0], alpha ? p[image.channels - 1] : 255});
  }
}

void checkImage(const ColourImage& image, const std::string& name)
{
  if (image.width < 1 || image.height < 1)
  {
    throw InvalidInput(inView(name) + "the image has no pixels (" + std::to_string(image.width) + " x " +
                       std::to_string(image.height) + ")");
  }
  if (image.channels < 1 || image.channels > 4)
  {
    throw InvalidInput(
        inView(name) + "the image has " + std::to_string(image.channels) +
        " channels; 1 (grey), 2 (grey, alpha), 3 (colour) and 4 (colour, alpha) are understood");
  }
  const std::size_t expected =
      std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels);
  if (image.pixels.size() != expected)
  {
    throw InvalidInput(inView(name) + "the image holds " + std::to_string(image.pixels.size()) +
                       " bytes; its size asks for " + std::to_string(expected));
  }
}

/** The criteria, in units of an 8-bit channel. */
class Criteria
{
public:
  explicit Criteria(const ExtractionOptions& options)
      : UseKey(options.key), UseBackground(options.background), UseAlpha(options.alpha),
        Tolerance(255.0 * options.tolerance + DecimalSlack)
  {
    if (this->UseKey)
    {
      this->KeyChannel = options.key->channel;
      this->KeyExcess = std::max(1, int(std::ceil(255.0 * options.key->excess - DecimalSlack)));
    }
    if (this->UseBackground)
    {
      this->fillDistances(*options.background);
    }
    if (options.threshold)
    {
      this->Threshold = int(std::floor(255.0 * *options.threshold + DecimalSlack));
    }
  }

  bool isBackground(const Pixel& pixel) const
  {
    return (this->UseAlpha && pixel.alpha <= Half) || pixel.largest() <= this->Threshold ||
           (this->UseKey && this->excessOf(pixel) >= this->KeyExcess) ||
           (this->UseBackground &&
            this->Distance[0][pixel.red] + this->Distance[1][pixel.green] + this->Distance[2][pixel.blue] <=
                this->Tolerance);
  }

private:
  int excessOf(const Pixel& pixel) const
  {
    switch (this->KeyChannel)
    {
    case ColourChannel::Red:
      return pixel.red - std::max(pixel.green, pixel.blue);
    case ColourChannel::Green:
      return pixel.green - std::max(pixel.red, pixel.blue);
    default:
      return pixel.blue - std::max(pixel.red, pixel.green);
    }
  }

  void fillDistances(const std::array<double, 3>& colour)
  {
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      for (int value = 0; value < 256; ++value)
      {
        this->Distance[channel][std::size_t(value)] = std::abs(value - 255.0 * colour[channel]);
      }
    }
  }

  bool UseKey;
  bool UseBackground;
  bool UseAlpha;
  ColourChannel KeyChannel = ColourChannel::Blue;
  int KeyExcess = 256;
  int Threshold = -1;
  double Tolerance;
  std::array<std::array<double, 256>, 3> Distance{};
};

void byCriteria(const ColourImage& image, const ExtractionOptions& options, const std::string& name,
                BinaryImage& out)
{
  if (options.key && image.channels < 3)
  {
    throw InvalidInput(inView(name) + "a key needs a colour image; this one is grey");
  }
  if (options.alpha && !hasAlpha(image))
  {
    throw InvalidInput(inView(name) + "alpha was asked for, but the image has no alpha channel");
  }
  const Criteria criteria(options);
  forPixels(image,
            [&](std::size_t i, const Pixel& pixel) { out.pixels[i] = criteria.isBackground(pixel) ? 0 : 1; });
}

/** What an image holds that may be a silhouette already. */
struct Survey
{
  bool opaque = true;
  int largest = 0;
  std::set<int> colours; ///< three at most are kept
  bool above = false;    ///< some pixel is object by the rule
  bool below = false;    ///< some pixel is background by the rule

  int limit() const { return this->largest == 1 ? 0 : Half; }
};

Survey surveyOf(const ColourImage& image)
{
  Survey survey;
  int last = -1;
  forPixels(image,
            [&](std::size_t, const Pixel& pixel)
            {
              survey.opaque = survey.opaque && pixel.alpha > Half;
              survey.largest = std::max(survey.largest, pixel.largest());
              if (pixel.colour() != last && survey.colours.size() < 3)
              {
                last = pixel.colour();
                survey.colours.insert(last);
              }
            });
  for (const int colour : survey.colours)
  {
    const int value = std::max({colour >> 16, (colour >> 8) & 255, colour & 255});
    survey.above = survey.above || value > survey.limit();
    survey.below = survey.below || value <= survey.limit();
  }
  return survey;
}

[[noreturn]] void refuse(const Survey& survey, const std::string& name)
{
  const bool two = survey.colours.size() == 2;
  throw InvalidInput(
      inView(name) +
      (two ? "an image of two colours, but both are on the same side of 127, so that it is no silhouette"
           : "a photograph without a mask or alpha is no silhouette") +
      "; say what its background is: by a key channel, a colour, a threshold or its alpha");
}

void asItIs(const ColourImage& image, bool isMask, const std::string& name, BinaryImage& out)
{
  const Survey survey = surveyOf(image);
  if (!survey.opaque)
  {
    forPixels(image, [&](std::size_t i, const Pixel& pixel) { out.pixels[i] = pixel.alpha > Half ? 1 : 0; });
    return;
  }
  const bool twoValued =
      survey.colours.size() == 1 || (survey.colours.size() == 2 && survey.above && survey.below);
  const bool oneSided = survey.colours.size() == 2 && !twoValued; // such a mask would be all object or all background
  if (isMask ? oneSided : !twoValued)
  {
    refuse(survey, name);
  }
  const int limit = survey.limit();
  forPixels(image,
            [&](std::size_t i, const Pixel& pixel) { out.pixels[i] = pixel.largest() > limit ? 1 : 0; });
}

} // namespace

BinaryImage extractSilhouette(const ColourImage& image, const ExtractionOptions& options, bool isMask,
                              const std::string& name)
{
  validate(options);
  checkImage(image, name);
  BinaryImage out;
  out.width = image.width;
  out.height = image.height;
  out.pixels.resize(std::size_t(image.width) * std::size_t(image.height));
  if (options.hasCriteria())
  {
    byCriteria(image, options, name, out);
  }
  else
  {
    asItIs(image, isMask, name, out);
  }
  if (options.invert)
  {
    std::for_each(out.pixels.begin(), out.pixels.end(), [](std::uint8_t& value) { value = value == 0; });
  }
  out = options.morphology.empty() ? std::move(out) : applyMorphology(out, options.morphology);
  out = options.largestRegion ? largestRegion(out) : std::move(out);
  return options.fillHoles > 0 ? fillHoles(out, options.fillHoles) : std::move(out);
}

} // namespace silhouette
