// SPDX-License-Identifier: BSD-3-Clause
#include "LensDistortion.h"

#include "Error.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace silhouette
{
namespace
{

void check(const LensDistortion& lens)
{
  const std::size_t count = lens.coefficients.size();
  const bool isBrown = lens.model == LensDistortion::Model::Brown;
  const bool fits = isBrown ? count == 4 || count == 5 || count == 8 || count == 12 || count == 14 : count == 4;
  if (!fits)
  {
    throw InvalidInput(std::string(isBrown ? "Brown's" : "the fisheye") + " lens model has no " + std::to_string(count) + " coefficients");
  }
}

/** cv::remap counts pixels in 16 bits. */
constexpr int LargestSide = 32766;

void checkImage(int width, int height, int channels)
{
  if (width < 1 || height < 1 || width > LargestSide || height > LargestSide || channels < 1 || channels > 4)
  {
    throw InvalidInput("an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels and " + std::to_string(channels) +
                       " channels; a lens's distortion is taken out of images of 1 to " + std::to_string(LargestSide) +
                       " pixels a side and 1 to 4 channels");
  }
}

/** The colours of an image of one or two, one after another, `channels` bytes each; empty where there are more. */
std::vector<std::uint8_t> fewColours(const std::uint8_t* pixels, std::size_t count, std::size_t channels)
{
  std::vector<std::uint8_t> colours(pixels, pixels + channels);
  for (std::size_t i = 1; i < count; ++i)
  {
    const std::uint8_t* pixel = pixels + i * channels;
    bool isKnown = false;
    for (std::size_t known = 0; known < colours.size(); known += channels)
    {
      isKnown = isKnown || std::equal(pixel, pixel + channels, colours.begin() + std::ptrdiff_t(known));
    }
    if (!isKnown && colours.size() == 2 * channels)
    {
      return {};
    }
    colours.insert(colours.end(), pixel, isKnown ? pixel : pixel + channels);
  }
  return colours;
}

/** Each pixel takes the nearer of two colours. */
void takeNearer(const std::vector<std::uint8_t>& colours, std::vector<std::uint8_t>& pixels)
{
  const std::size_t channels = colours.size() / 2;
  for (std::size_t i = 0; i < pixels.size(); i += channels)
  {
    int nearer = 0; // distance to the first less that to the second
    for (std::size_t channel = 0; channel < channels; ++channel)
    {
      const int value = pixels[i + channel];
      nearer += std::abs(value - colours[channel]) - std::abs(value - colours[channels + channel]);
    }
    std::copy_n(colours.begin() + std::ptrdiff_t(nearer < 0 ? 0 : channels), channels, pixels.begin() + std::ptrdiff_t(i));
  }
}

/** Where each pixel of the undistorted image comes from, in u and v. */
void makeMaps(const LensDistortion& lens, int width, int height, cv::Mat& u, cv::Mat& v)
{
  cv::Mat K(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      K.at<double>(row, column) = lens.intrinsics(row, column);
    }
  }
  const cv::Mat coefficients(lens.coefficients, true);
  if (lens.model == LensDistortion::Model::Fisheye)
  {
    cv::fisheye::initUndistortRectifyMap(K, coefficients, cv::Mat::eye(3, 3, CV_64F), K, { width, height }, CV_32FC1, u, v);
  }
  else
  {
    cv::initUndistortRectifyMap(K, coefficients, cv::Mat(), K, { width, height }, CV_32FC1, u, v);
  }
}

} // namespace

bool LensDistortion::isAny() const
{
  return this->model == Model::Fisheye ||
    std::any_of(this->coefficients.begin(), this->coefficients.end(), [](double one) { return one != 0.0; });
}

std::vector<std::uint8_t> undistorted(const std::uint8_t* pixels, int width, int height, int channels, const LensDistortion& lens)
{
  check(lens);
  checkImage(width, height, channels);
  const std::size_t count = std::size_t(width) * std::size_t(height);
  std::vector<std::uint8_t> result(count * std::size_t(channels));
  try
  {
    cv::Mat u, v;
    makeMaps(lens, width, height, u, v);
    const cv::Mat from(height, width, CV_8UC(channels), const_cast<std::uint8_t*>(pixels));
    cv::Mat to(height, width, CV_8UC(channels), result.data());
    cv::remap(from, to, u, v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  catch (const cv::Exception& error)
  {
    throw InvalidInput("its lens's distortion cannot be taken out of an image (" + error.err + ")");
  }
  const std::vector<std::uint8_t> colours = fewColours(pixels, count, std::size_t(channels));
  if (colours.size() == 2 * std::size_t(channels))
  {
    takeNearer(colours, result);
  }
  return result;
}

} // namespace silhouette
