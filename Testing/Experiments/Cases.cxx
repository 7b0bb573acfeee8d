// SPDX-License-Identifier: BSD-3-Clause
#include "Cases.h"

#include "Error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace silhouette::experiments
{
namespace
{

template <typename Entry>
const Entry& named(const std::vector<Entry>& table, const std::string& name, const char* kind)
{
  std::string known;
  for (const Entry& entry : table)
  {
    if (name == entry.name)
    {
      return entry;
    }
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw InvalidInput("there is no " + std::string(kind) + " '" + name + "'; there are " + known);
}

double inPixels(double strength, int side)
{
  return strength * side / 1024.0;
}

constexpr double PixelsPerOctant = 7.5; // of depth 7, in the middle of an image of 1024

bool chosen(const std::vector<std::string>& names, const std::string& name)
{
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

const char* const CleanName = "clean";
const char* const NothingLeft = "nothing survives the carving";

const std::vector<Object>& objects()
{
  static const std::vector<Object> table = {
      {"sphere", SyntheticShape::Sphere, true, 0},    {"pebble", SyntheticShape::Pebble, true, 0},
      {"torus", SyntheticShape::Torus, false, 1},     {"jug", SyntheticShape::Jug, false, 1},
      {"pumpkin", SyntheticShape::Pumpkin, false, 0}, {"twig", SyntheticShape::Twig, false, 0, true}};
  return table;
}

const std::vector<Noise>& noises()
{
  using Options = SyntheticCaptureOptions;
  static const std::vector<Noise> table = {
      {"contour",
       "px",
       {2.0, 4.0, 8.0}, // 0.27, 0.53 and 1.07 octants at depth 7
       0.0,
       [](Options& o, double s, int side) { o.noiseContour = inPixels(s, side); }},
      {"camera",
       "px",
       {1.0, 2.0, 4.0},
       0.0,
       [](Options& o, double s, int side) { o.noiseCamera = inPixels(s, side); }},
      {"blobs",
       "masks",
       {1.0, 2.0, 3.0},
       0.0,
       [](Options& o, double s, int) { o.noiseBlobs = int(std::lround(s)); }},
      {"pixels", "%", {0.1, 0.3, 1.0}, 1.0, [](Options& o, double s, int) { o.noisePixels = s / 100.0; }},
      {"rotation", "degrees", {0.05, 0.1, 0.2}, 0.0, [](Options& o, double s, int) { o.noiseRotation = s; }}};
  return table;
}

const std::vector<std::string>& strengthNames()
{
  static const std::vector<std::string> names = {"weak", "middle", "strong"};
  return names;
}

const Object& objectNamed(const std::string& name)
{
  return named(objects(), name, "object");
}

const Noise& noiseNamed(const std::string& name)
{
  return named(noises(), name, "kind of noise");
}

double contourPixels(double octants, int depth)
{
  return std::ldexp(octants * PixelsPerOctant, 7 - depth);
}

std::vector<Case> casesOf(const std::string& object, const StudyOptions& options)
{
  std::vector<Case> cases;
  if (chosen(options.noises, CleanName))
  {
    cases.push_back({object, CleanName, 0.0, 0});
  }
  for (const std::uint64_t seed : options.seeds)
  {
    if (options.contourOctants > 0.0)
    {
      const double strength = contourPixels(options.contourOctants, options.settings.depth);
      cases.push_back({object, "contour", strength, seed});
      continue;
    }
    for (const Noise& noise : noises())
    {
      for (std::size_t s = 0; s < noise.strengths.size() && chosen(options.noises, noise.name); ++s)
      {
        const bool isRun = noise.strengths[s] != noise.once || seed == options.seeds.front();
        if (isRun && chosen(options.strengths, strengthNames()[s]))
        {
          cases.push_back({object, noise.name, noise.strengths[s], seed});
        }
      }
    }
  }
  return cases;
}

SyntheticCaptureOptions captureOptions(const Case& at, const Settings& settings)
{
  SyntheticCaptureOptions options;
  options.views = settings.views;
  options.width = options.height = settings.size;
  options.seed = at.seed;
  options.photographs = false;
  if (at.noise != CleanName)
  {
    noiseNamed(at.noise).set(options, at.strength, settings.size);
  }
  return options;
}

std::string describeNoise(const std::string& noise, double strength)
{
  if (noise == CleanName)
  {
    return noise;
  }
  char text[64];
  std::snprintf(text, sizeof text, "%s %g %s", noise.c_str(), strength, noiseNamed(noise).unit);
  return text;
}

} // namespace silhouette::experiments
