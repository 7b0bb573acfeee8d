// SPDX-License-Identifier: BSD-3-Clause
#include "ExtractionOptions.h"

#include "Error.h"
#include "TextParsing.h"

namespace silhouette
{

namespace
{

/** Written so that NaN is outside every range. */
bool within(double value, double least, double greatest)
{
  return value >= least && value <= greatest;
}

void checkRange(const char* option, double value, double least, double greatest)
{
  if (!within(value, least, greatest))
  {
    throw InvalidInput(std::string(option) + ": " + formatNumber(value) + " is not a number from " +
                       formatNumber(least) + " to " + formatNumber(greatest));
  }
}

const char* nameOf(MorphologyKind kind)
{
  constexpr std::array<const char*, 4> names = {"opening", "closing", "dilate", "erode"};
  return names[std::size_t(kind)];
}

void checkMorphology(const std::vector<MorphologyOperation>& operations)
{
  int reach = 0;
  for (const MorphologyOperation& operation : operations)
  {
    if (operation.radius < 0 || operation.radius > LargestMorphologyReach)
    {
      throw InvalidInput(std::string(nameOf(operation.kind)) + ": radius " +
                         std::to_string(operation.radius) + " is not from 0 to " +
                         std::to_string(LargestMorphologyReach));
    }
    const bool twice = operation.kind == MorphologyKind::Opening || operation.kind == MorphologyKind::Closing;
    reach += twice ? 2 * operation.radius : operation.radius;
    if (reach > LargestMorphologyReach)
    {
      throw InvalidInput(std::string(nameOf(operation.kind)) + ": with radius " +
                         std::to_string(operation.radius) + " the morphology reaches " +
                         std::to_string(reach) + " pixels, opening and closing counted twice; at most " +
                         std::to_string(LargestMorphologyReach) + " are allowed");
    }
  }
}

} // namespace

void validate(const ExtractionOptions& options)
{
  if (options.key && !(options.key->excess > 0.0 && options.key->excess <= 1.0))
  {
    throw InvalidInput("key: excess " + formatNumber(options.key->excess) +
                       " is not a number above 0 and at most 1");
  }
  if (options.background)
  {
    for (const double component : *options.background)
    {
      checkRange("background", component, 0.0, 1.0);
    }
  }
  checkRange("tolerance", options.tolerance, 0.0, 3.0);
  if (options.threshold)
  {
    checkRange("threshold", *options.threshold, 0.0, 1.0);
  }
  checkMorphology(options.morphology);
  if (options.fillHoles < 0)
  {
    throw InvalidInput("fill-holes: " + std::to_string(options.fillHoles) + " pixels is below 0");
  }
}

ChromaKey parseKey(const std::string& text)
{
  const std::vector<std::string> parts = splitText(text, ':');
  const std::string channel = lowerCase(parts[0]);
  const double excess = parts.size() == 2 ? parseFinite(parts[1]).value_or(0.0) : 0.0;
  const bool known = channel == "red" || channel == "green" || channel == "blue";
  if (!known || !(excess > 0.0 && excess <= 1.0))
  {
    throw InvalidInput("key: expected red, green or blue, a colon and an excess above 0 and at most 1, as in "
                       "blue:0.08; got " +
                       inQuotes(text));
  }
  const ColourChannel key = channel == "red"     ? ColourChannel::Red
                            : channel == "green" ? ColourChannel::Green
                                                 : ColourChannel::Blue;
  return {key, excess};
}

std::array<double, 3> parseColour(const std::string& text)
{
  const std::vector<std::string> parts = splitText(text, ',');
  std::array<double, 3> colour{};
  bool good = parts.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i)
  {
    const std::optional<double> component = parseFinite(parts[i]);
    good = component && within(*component, 0.0, 1.0);
    colour[i] = component.value_or(0.0);
  }
  if (!good)
  {
    throw InvalidInput("background: expected red, green and blue, each from 0 to 1, as in 0,0,0.75; got " +
                       inQuotes(text));
  }
  return colour;
}

} // namespace silhouette
