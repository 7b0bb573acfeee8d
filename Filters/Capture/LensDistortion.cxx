// SPDX-License-Identifier: BSD-3-Clause
#include "LensDistortion.h"

#include "Error.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
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

} // namespace

bool LensDistortion::isAny() const
{
  return this->model == Model::Fisheye ||
    std::any_of(this->coefficients.begin(), this->coefficients.end(), [](double one) { return one != 0.0; });
}

std::vector<std::uint8_t> undistorted(const std::uint8_t* pixels, int width, int height, int channels, const LensDistortion& lens)
{
  check(lens);
  cv::Mat K(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      K.at<double>(row, column) = lens.intrinsics(row, column);
    }
  }
  const cv::Mat coefficients(lens.coefficients, true);
  cv::Mat u, v;
  if (lens.model == LensDistortion::Model::Fisheye)
  {
    cv::fisheye::initUndistortRectifyMap(K, coefficients, cv::Mat::eye(3, 3, CV_64F), K, { width, height }, CV_32FC1, u, v);
  }
  else
  {
    cv::initUndistortRectifyMap(K, coefficients, cv::Mat(), K, { width, height }, CV_32FC1, u, v);
  }
  std::vector<std::uint8_t> result(std::size_t(width) * std::size_t(height) * std::size_t(channels));
  const cv::Mat from(height, width, CV_8UC(channels), const_cast<std::uint8_t*>(pixels));
  cv::Mat to(height, width, CV_8UC(channels), result.data());
  cv::remap(from, to, u, v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return result;
}

} // namespace silhouette
