// SPDX-License-Identifier: BSD-3-Clause
/**
 * Noise for silhouettes and cameras: the random numbers and what is done to a mask with them.
 *
 * A number is drawn from a key and a place, not from a generator with a state, so that it depends neither on
 * threads nor on what else is drawn. Only sums, products, quotients and square roots are used, which
 * every machine computes alike.
 */
#pragma once

#include "View.h"

#include <cstddef>

namespace silhouette
{

/** What is drawn at random; each kind and view has a stream of its own. */
enum class NoiseKind : std::uint64_t
{
  Contour = 1,
  Blobs = 2,
  Pixels = 3,
  Camera = 4,
  Rotation = 5,
  BlobViews = 6
};

/** The largest standard deviation of contour noise, px. */
constexpr double GreatestContourNoise = 1000.0;

/** The key of what is drawn of one kind for one view. */
std::uint64_t noiseKey(std::uint64_t seed, NoiseKind kind, std::size_t view);

/** In [0, 1). */
double uniformAt(std::uint64_t key, std::uint64_t place);

/** In 0 to count - 1; count > 0. */
std::size_t indexAt(std::uint64_t key, std::uint64_t place, std::size_t count);

/** Gaussian to the eye: mean 0, standard deviation 1, never beyond 6. */
double gaussianAt(std::uint64_t key, std::uint64_t place);

/**
 * The contour moved along its normal by a Gaussian random field of standard deviation `sigma` px that is
 * smooth over 6 px (for 1024 px of the shorter side, in proportion for others): object where the distance
 * from the contour, exact, positive inside, plus the field is positive. Cost: proportional to pixels and,
 * near the contour, to sigma. Throws InvalidInput for a sigma outside 0 to GreatestContourNoise.
 */
BinaryImage addContourNoise(const BinaryImage& mask, double sigma, std::uint64_t key);

/**
 * Three discs cut out of the object, their centres drawn from its pixels, their radii from 8 to 25 px (for
 * 1024 px of the shorter side, in proportion for others). A mask without object stays as it is.
 */
BinaryImage cutBlobs(const BinaryImage& mask, std::uint64_t key);

/** Each pixel flipped with the probability `share`. Throws InvalidInput for a share outside 0 to 1. */
BinaryImage flipPixels(const BinaryImage& mask, double share, std::uint64_t key);

} // namespace silhouette
