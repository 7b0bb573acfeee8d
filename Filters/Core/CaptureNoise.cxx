// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureNoise.h"

#include "ParameterRange.h"

#include <algorithm>
#include <cmath>

namespace silhouette
{
namespace
{

/** Lengths in px that are stated for an image of this many pixels on its shorter side. */
constexpr double StatedSide = 1024.0;

double statedScale(const BinaryImage& mask)
{
  return std::min(mask.width, mask.height) / StatedSide;
}

/** A bijection of the 64-bit numbers that spreads each bit over all (splitmix64's finisher). */
std::uint64_t scramble(std::uint64_t x)
{
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ x >> 27) * 0x94d049bb133111ebULL;
  return x ^ x >> 31;
}

/** The number at a place of the sequence that a key names: random access, so that no order of drawing
 * matters. */
std::uint64_t bitsAt(std::uint64_t key, std::uint64_t place)
{
  return scramble(key + (place + 1) * 0x9e3779b97f4a7c15ULL);
}

/** Sum of the four 16-bit parts of 64 random bits, brought to mean 0 and deviation 1: near enough to be
 * smoothed. */
double roughGaussianAt(std::uint64_t key, std::uint64_t place)
{
  const std::uint64_t b = bitsAt(key, place);
  const std::uint64_t sum = (b & 0xffff) + (b >> 16 & 0xffff) + (b >> 32 & 0xffff) + (b >> 48);
  return (double(sum) - 131070.0) / (65536.0 / std::sqrt(3.0));
}

/** For each pixel the distance, at most `reach`, to the nearest pixel of its column that has the other value.
 */
std::vector<int> columnDistances(const BinaryImage& mask, int reach)
{
  std::vector<int> result(mask.pixels.size(), reach);
  const auto sweep = [&](int first, int last, int step)
  {
    for (int row = first + step; row != last; row += step)
    {
      for (int column = 0; column < mask.width; ++column)
      {
        const bool changes = mask.at(column, row) != mask.at(column, row - step);
        int& here = result[std::size_t(row) * mask.width + column];
        const int before = result[std::size_t(row - step) * mask.width + column];
        here = changes ? 1 : std::min(here, before + 1);
      }
    }
  };
  sweep(0, mask.height, 1);
  sweep(mask.height - 1, -1, -1);
  return result;
}

/**
 * Distance from the contour, which runs half-way between a pixel and the nearest one of the other value;
 * positive inside; exact up to `reach`, and at least that beyond.
 */
std::vector<double> signedDistances(const BinaryImage& mask, int reach)
{
  const std::vector<int> inColumn = columnDistances(mask, reach);
  std::vector<double> result(mask.pixels.size());
  for (int row = 0; row < mask.height; ++row)
  {
    const std::uint8_t* value = &mask.pixels[std::size_t(row) * mask.width];
    const int* vertical = &inColumn[std::size_t(row) * mask.width];
    for (int column = 0; column < mask.width; ++column)
    {
      long best = long(vertical[column]) * vertical[column];
      const auto visit = [&](int other, long squared)
      {
        const long v = value[other] != value[column] ? 0 : vertical[other];
        best = std::min(best, squared + v * v);
      };
      for (int d = 1; d <= reach && long(d) * d < best; ++d)
      {
        visit(std::max(column - d, 0), long(d) * d);
        visit(std::min(column + d, mask.width - 1), long(d) * d);
      }
      const double distance = std::sqrt(double(best)) - 0.5;
      result[std::size_t(row) * mask.width + column] = value[column] != 0 ? distance : -distance;
    }
  }
  return result;
}

/** A bell with standard deviation `width` px and compact support, its squares adding up to 1. */
std::vector<double> smoothingKernel(double width)
{
  const double support = width * std::sqrt(11.0); // the variance of (1 - x^2)^4 is 1 / 11
  std::vector<double> kernel;
  double squares = 0.0;
  for (int i = -int(support); i <= int(support); ++i)
  {
    const double x = i / support;
    const double once = (1.0 - x * x) * (1.0 - x * x);
    kernel.push_back(once * once);
    squares += kernel.back() * kernel.back();
  }
  for (double& k : kernel)
  {
    k /= std::sqrt(squares);
  }
  return kernel;
}

/** White noise smoothed along the rows, with as many rows above and below as the kernel needs. */
std::vector<double> rowNoise(int width, int rows, const std::vector<double>& kernel, std::uint64_t key)
{
  std::vector<double> white(width + kernel.size() - 1);
  std::vector<double> result(std::size_t(width) * rows);
  for (int row = 0; row < rows; ++row)
  {
    for (std::size_t i = 0; i < white.size(); ++i)
    {
      white[i] = roughGaussianAt(key, std::uint64_t(row) * white.size() + i);
    }
    double* out = &result[std::size_t(row) * width];
    for (std::size_t k = 0; k < kernel.size(); ++k)
    {
      for (int i = 0; i < width; ++i)
      {
        out[i] += kernel[k] * white[i + k];
      }
    }
  }
  return result;
}

} // namespace

std::uint64_t noiseKey(std::uint64_t seed, NoiseKind kind, std::size_t view)
{
  return bitsAt(bitsAt(scramble(seed), std::uint64_t(kind)), view);
}

double uniformAt(std::uint64_t key, std::uint64_t place)
{
  return std::ldexp(double(bitsAt(key, place) >> 11), -53);
}

std::size_t indexAt(std::uint64_t key, std::uint64_t place, std::size_t count)
{
  return std::min(std::size_t(uniformAt(key, place) * double(count)), count - 1);
}

double gaussianAt(std::uint64_t key, std::uint64_t place)
{
  // A sum of twelve uniform numbers, since logarithms and cosines differ from library to library.
  double sum = -6.0;
  for (std::uint64_t i = 0; i < 12; ++i)
  {
    sum += uniformAt(key, 12 * place + i);
  }
  return sum;
}

BinaryImage addContourNoise(const BinaryImage& mask, double sigma, std::uint64_t key)
{
  requireRange("contour noise", sigma, 0.0, GreatestContourNoise);
  if (sigma == 0.0 || mask.pixels.empty())
  {
    return mask;
  }
  const std::vector<double> kernel = smoothingKernel(6.0 * statedScale(mask));
  // Draws beyond eight deviations do not happen: pixels further away keep their value.
  const int reach = int(std::min(std::ceil(8.0 * sigma), double(std::max(mask.width, mask.height)))) + 1;
  const std::vector<double> distance = signedDistances(mask, reach);
  const std::vector<double> noise = rowNoise(mask.width, mask.height + int(kernel.size()) - 1, kernel, key);
  BinaryImage result = mask;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
  {
    if (std::abs(distance[i]) < reach - 1)
    {
      double field = 0.0;
      for (std::size_t k = 0; k < kernel.size(); ++k)
      {
        field += kernel[k] * noise[i + k * mask.width];
      }
      result.pixels[i] = distance[i] + sigma * field > 0.0 ? 1 : 0;
    }
  }
  return result;
}

BinaryImage cutBlobs(const BinaryImage& mask, std::uint64_t key)
{
  std::vector<std::size_t> object;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
  {
    if (mask.pixels[i] != 0)
    {
      object.push_back(i);
    }
  }
  BinaryImage result = mask;
  for (std::uint64_t blob = 0; blob < 3 && !object.empty(); ++blob)
  {
    const std::size_t centre = object[indexAt(key, 2 * blob, object.size())];
    const double radius = (8.0 + 17.0 * uniformAt(key, 2 * blob + 1)) * statedScale(mask);
    const int u = int(centre % mask.width);
    const int v = int(centre / mask.width);
    const int r = int(radius);
    for (int row = std::max(v - r, 0); row <= std::min(v + r, mask.height - 1); ++row)
    {
      for (int column = std::max(u - r, 0); column <= std::min(u + r, mask.width - 1); ++column)
      {
        const double squared = double(row - v) * (row - v) + double(column - u) * (column - u);
        if (squared <= radius * radius)
        {
          result.at(column, row) = 0;
        }
      }
    }
  }
  return result;
}

BinaryImage flipPixels(const BinaryImage& mask, double share, std::uint64_t key)
{
  requireRange("share of flipped pixels", share, 0.0, 1.0);
  BinaryImage result = mask;
  for (std::size_t i = 0; share > 0.0 && i < result.pixels.size(); ++i)
  {
    result.pixels[i] ^= std::uint8_t(uniformAt(key, i) < share);
  }
  return result;
}

} // namespace silhouette
