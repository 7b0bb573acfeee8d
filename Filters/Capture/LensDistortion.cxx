// SPDX-License-Identifier: BSD-3-Clause
#include "LensDistortion.h"

#include "Error.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
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
constexpr int RowsAtATime = 128; ///< their map is made, and used, while it is at hand
constexpr double Beyond = 40000.0; ///< px, outside any image

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

/** How far from the axis, in the plane Z = 1, a lens without tangential distortion puts what lies at radius r. */
double bentRadius(const LensDistortion& lens, double r)
{
  const auto k = [&](std::size_t i) { return i < lens.coefficients.size() ? lens.coefficients[i] : 0.0; };
  if (lens.model == LensDistortion::Model::Fisheye)
  {
    const double angle = std::atan(r), a = angle * angle;
    return angle * (1.0 + a * (k(0) + a * (k(1) + a * (k(2) + a * k(3)))));
  }
  const double r2 = r * r;
  return r * (1.0 + r2 * (k(0) + r2 * (k(1) + r2 * k(4)))) / (1.0 + r2 * (k(5) + r2 * (k(6) + r2 * k(7))));
}

/** The radius up to which points further out come to lie further out, no more than `farthest`. */
double radiusBeforeFolding(const LensDistortion& lens, double farthest)
{
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i)
  {
    if (!(bentRadius(lens, farthest * (i + 1) / steps) > bentRadius(lens, farthest * i / steps)))
    {
      return farthest * i / steps;
    }
  }
  return farthest;
}

cv::Mat matrixOf(const Eigen::Matrix3d& K)
{
  cv::Mat matrix(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      matrix.at<double>(row, column) = K(row, column);
    }
  }
  return matrix;
}

/** Where each pixel of the undistorted image comes from, for some of its rows. */
class DistortionMap
{
public:
  DistortionMap(const LensDistortion& lens, int width, int height)
      : Lens(lens), Width(width), ToPlane(lens.intrinsics.inverse()), Coefficients(lens.coefficients, true)
  {
    double farthest = 0.0;
    for (const int row : {0, height - 1})
    {
      for (const int column : {0, width - 1})
      {
        farthest = std::max(farthest, this->planeOf(column, row).norm());
      }
    }
    this->Limit = radiusBeforeFolding(lens, farthest);
    this->Folds = this->Limit < farthest;
  }

  void makeRows(int top, int count)
  {
    Eigen::Matrix3d shifted = this->Lens.intrinsics;
    shifted(1, 2) -= top;
    const cv::Mat K = matrixOf(this->Lens.intrinsics), rowsK = matrixOf(shifted);
    const cv::Size size(this->Width, count);
    if (this->Lens.model == LensDistortion::Model::Fisheye)
    {
      cv::fisheye::initUndistortRectifyMap(K, this->Coefficients, cv::Mat::eye(3, 3, CV_64F), rowsK, size, CV_32FC1, this->U, this->V);
    }
    else
    {
      cv::initUndistortRectifyMap(K, this->Coefficients, cv::Mat(), rowsK, size, CV_32FC1, this->U, this->V);
    }
    if (this->Lens.intrinsics(0, 1) != 0.0)
    {
      // OpenCV takes its new camera's skew into account, and leaves out the old one's: u = fx x' + cx, where s y' is missing.
      this->U += (this->V - this->Lens.intrinsics(1, 2)) * (this->Lens.intrinsics(0, 1) / this->Lens.intrinsics(1, 1));
    }
    for (int row = 0; this->Folds && row < count; ++row)
    {
      this->leadFoldsOutside(top, row);
    }
    for (cv::Mat* map : {&this->U, &this->V})
    {
      float* const first = map->ptr<float>(); // without gaps, as it was made
      std::transform(first, first + map->total(), first, // cv::remap would take what is further for the other side
                     [](float value) { return std::max(std::min(value, float(Beyond)), -float(Beyond)); });
    }
  }

  const cv::Mat& u() const { return this->U; }
  const cv::Mat& v() const { return this->V; }

private:
  Eigen::Vector2d planeOf(int column, int row) const
  {
    return (this->ToPlane * Eigen::Vector3d(column, row, 1.0)).hnormalized();
  }

  /** Beyond the radius at which a lens's polynomial turns back it describes no lens: the image would appear there again, mirrored. */
  void leadFoldsOutside(int top, int row)
  {
    const Eigen::Matrix3d& K = this->Lens.intrinsics;
    for (int column = 0; column < this->Width; ++column)
    {
      const Eigen::Vector2d plane = this->planeOf(column, top + row);
      if (plane.norm() > this->Limit)
      {
        const Eigen::Vector2d outwards = Beyond * (K.topLeftCorner<2, 2>() * plane).normalized();
        this->U.at<float>(row, column) = float(K(0, 2) + outwards.x());
        this->V.at<float>(row, column) = float(K(1, 2) + outwards.y());
      }
    }
  }

  const LensDistortion& Lens;
  int Width;
  Eigen::Matrix3d ToPlane;
  cv::Mat Coefficients, U, V;
  double Limit = 0.0; ///< radius in the plane Z = 1
  bool Folds = false;
};

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
    const cv::Mat from(height, width, CV_8UC(channels), const_cast<std::uint8_t*>(pixels));
    cv::Mat to(height, width, CV_8UC(channels), result.data());
    DistortionMap map(lens, width, height);
    for (int top = 0; top < height; top += RowsAtATime)
    {
      cv::Mat rows = to.rowRange(top, std::min(top + RowsAtATime, height));
      map.makeRows(top, rows.rows);
      cv::remap(from, rows, map.u(), map.v(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    }
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
