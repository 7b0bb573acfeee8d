// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the study runs over: objects, kinds and strengths of noise, seeds.
 */
#pragma once

#include "SyntheticCapture.h"
#include "SyntheticShapes.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace silhouette::experiments
{

/** A solid of the study. */
struct Object
{
  const char* name;
  SyntheticShape shape;
  bool convex;
  int genus;
  /** Thinner than an octant: marching cubes breaks it, at any depth of the study; so the reference is the solid itself. */
  bool thin = false;
};

/** A kind of noise, with the strengths that the study takes: weak, middle, strong. */
struct Noise
{
  const char* name;
  const char* unit;
  std::array<double, 3> strengths;
  double
      once; ///< a strength that is run with the first seed alone, since it takes minutes to carve; 0 for none
  /** Set it in a capture of images of `side` pixels; lengths in px are stated for 1024. */
  void (*set)(SyntheticCaptureOptions& options, double strength, int side);
};

const std::vector<Object>& objects();
const std::vector<Noise>& noises();
const std::vector<std::string>& strengthNames();
/** The named one. Throws InvalidInput where there is none. */
const Object& objectNamed(const std::string& name);
const Noise& noiseNamed(const std::string& name);

/** What is the same in all cases of a study. */
struct Settings
{
  int depth = 7;   ///< of the octrees; the reference is two generations deeper
  int size = 1024; ///< pixels, both sides
  int views = 36;
};

struct StudyOptions
{
  Settings settings;
  std::vector<std::string> objects;   ///< names; empty is all
  std::vector<std::string> noises;    ///< names, `clean` for none; empty is all and the clean case
  std::vector<std::string> strengths; ///< names; empty is all
  std::vector<std::uint64_t> seeds{11, 12, 13, 14, 15};
  std::vector<std::string> methods;             ///< names; empty is all
  double contourOctants = 0.0; ///< above 0: instead of the noises, the clean case and contour noise of so many octants
  int threads = 0;                              ///< 0: all processors
  std::filesystem::path output = "experiments"; ///< the folder of the results
  std::filesystem::path results = "results.csv"; ///< their file in it
  bool resume = false;                          ///< go on with the results that are there
  bool fresh = false;                           ///< replace them
};

/** One capture. */
struct Case
{
  std::string object;
  std::string noise = "clean";
  double strength = 0.0;
  std::uint64_t seed = 0; ///< 0 for the clean case, which has none
};

/** Contour noise of so many octants of the depth, in pixels of an image of 1024. */
double contourPixels(double octants, int depth);

/** The name of the case without noise among the kinds of noise. */
extern const char* const CleanName;

/** The failure of a method whose octree is empty: the capture's, not the method's. */
extern const char* const NothingLeft;

/** All cases of one object, the clean one first; those of a seed stand after those of the seeds before. */
std::vector<Case> casesOf(const std::string& object, const StudyOptions& options);

/** What to synthesize for a case. */
SyntheticCaptureOptions captureOptions(const Case& at, const Settings& settings);

/** "contour 2 px", "clean". */
std::string describeNoise(const std::string& noise, double strength);

} // namespace silhouette::experiments
