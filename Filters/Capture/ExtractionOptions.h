// SPDX-License-Identifier: BSD-3-Clause
/**
 * How a photograph becomes a silhouette: the settings, read from text and checked. Colours are on a scale of
 * 0 to 1, that is value / 255 of an 8-bit channel; limits are meant as decimals: 0.2 is exactly 51 / 255.
 */
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace silhouette
{

enum class ColourChannel
{
  Red = 0,
  Green = 1,
  Blue = 2
};

/** Chroma key: background where the key channel exceeds the larger of the other two by `excess` or more. */
struct ChromaKey
{
  ColourChannel channel = ColourChannel::Blue;
  double excess = 0.08; ///< in (0, 1]; larger calls less of the image background
};

enum class MorphologyKind
{
  Opening, ///< erode, then dilate: removes specks
  Closing, ///< dilate, then erode: closes gaps
  Dilate,
  Erode
};

struct MorphologyOperation
{
  MorphologyKind kind = MorphologyKind::Opening;
  int radius =
      1; ///< R, pixels, at least 0; the element is the pixels within R + 0.5 of the centre (1 is 3 x 3)
};

/** Farthest that all operations of a list together may reach, in pixels; opening and closing reach twice R.
 */
constexpr int LargestMorphologyReach = 1000;

/**
 * The steps, in their order. A pixel is background if ANY criterion says so; then polarity; then morphology
 * in the list's order; then the largest region; then holes.
 */
struct ExtractionOptions
{
  std::optional<ChromaKey> key;
  /** A background colour: red, green, blue, each 0 to 1. */
  std::optional<std::array<double, 3>> background;
  /** Background where the summed absolute difference to that colour is at most this; 0 to 3; larger calls
   * more of the image background. */
  double tolerance = 0.3;
  /** Background where the largest of red, green and blue is at most this; 0 to 1; larger calls more
   * background. */
  std::optional<double> threshold;
  /** Background where alpha is at most 127 of 255. */
  bool alpha = false;
  /** Swap object and background, before morphology. */
  bool invert = false;
  std::vector<MorphologyOperation> morphology;
  /** Keep the largest 8-connected region of object alone. */
  bool largestRegion = false;
  /** Holes of fewer pixels than this become object; 0 fills none; larger fills larger holes. */
  int fillHoles = 0;

  /** Whether any criterion tells background from object: key, background, threshold or alpha. */
  bool hasCriteria() const { return this->key || this->background || this->threshold || this->alpha; }
};

/** Throws InvalidInput that names the option and its value: not a number, out of its range. */
void validate(const ExtractionOptions& options);

/** "blue:0.08". Throws InvalidInput that says what was expected. */
ChromaKey parseKey(const std::string& text);

/** "0,0,0.75": red, green, blue, each 0 to 1. Throws InvalidInput that says what was expected. */
std::array<double, 3> parseColour(const std::string& text);

} // namespace silhouette
