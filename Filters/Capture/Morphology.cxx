// SPDX-License-Identifier: BSD-3-Clause
#include "Morphology.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace silhouette
{

namespace
{

/** Up to here the taps of the element are cheaper than a distance transform. */
constexpr int LargestElementRadius = 8;

/** Squared distances are whole: at most (R + 0.5)^2 is at most R^2 + R. */
int largestSquare(int radius)
{
  return radius * radius + radius;
}

cv::Mat element(int radius)
{
  cv::Mat disc = cv::Mat::zeros(2 * radius + 1, 2 * radius + 1, CV_8UC1);
  for (int y = -radius; y <= radius; ++y)
  {
    for (int x = -radius; x <= radius; ++x)
    {
      disc.at<std::uint8_t>(y + radius, x + radius) = x * x + y * y <= largestSquare(radius) ? 1 : 0;
    }
  }
  return disc;
}

/** 1 where a pixel of `value` lies within the radius, else 0. */
cv::Mat withinRadius(const cv::Mat& image, int value, int radius)
{
  const cv::Mat others = image != value; // 0 at the pixels of that value
  if (cv::countNonZero(others) == int(others.total()))
  {
    return cv::Mat::zeros(image.size(), CV_8UC1);
  }
  cv::Mat distance;
  cv::distanceTransform(others, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  // Whole squares are half a unit from this limit, which a float holds for every allowed radius.
  const cv::Mat within = distance <= std::sqrt(largestSquare(radius) + 0.5);
  return within / 255;
}

cv::Mat dilated(const cv::Mat& image, int radius)
{
  if (radius > LargestElementRadius)
  {
    return withinRadius(image, 1, radius);
  }
  cv::Mat out;
  cv::dilate(image, out, element(radius));
  return out;
}

cv::Mat eroded(const cv::Mat& image, int radius)
{
  if (radius > LargestElementRadius)
  {
    return 1 - withinRadius(image, 0, radius);
  }
  cv::Mat out;
  cv::erode(image, out, element(radius));
  return out;
}

cv::Mat applied(const cv::Mat& image, const MorphologyOperation& operation)
{
  switch (operation.kind)
  {
  case MorphologyKind::Opening:
    return dilated(eroded(image, operation.radius), operation.radius);
  case MorphologyKind::Closing:
    return eroded(dilated(image, operation.radius), operation.radius);
  case MorphologyKind::Dilate:
    return dilated(image, operation.radius);
  case MorphologyKind::Erode:
    return eroded(image, operation.radius);
  }
  return image;
}

int reachOf(const std::vector<MorphologyOperation>& operations)
{
  int reach = 0;
  for (const MorphologyOperation& operation : operations)
  {
    const bool twice = operation.kind == MorphologyKind::Opening || operation.kind == MorphologyKind::Closing;
    reach += twice ? 2 * operation.radius : operation.radius;
  }
  return reach;
}

} // namespace

BinaryImage applyMorphology(const BinaryImage& image, const std::vector<MorphologyOperation>& operations)
{
  const int reach = reachOf(operations);
  if (reach == 0)
  {
    return image;
  }
  BinaryImage out = image;
  const cv::Mat original(image.height, image.width, CV_8UC1, out.pixels.data());
  // What happens at the rim of this margin does not reach the image.
  cv::Mat plane;
  cv::copyMakeBorder(original, plane, reach, reach, reach, reach, cv::BORDER_REPLICATE);
  for (const MorphologyOperation& operation : operations)
  {
    plane = applied(plane, operation);
  }
  plane(cv::Rect(reach, reach, image.width, image.height)).copyTo(original);
  return out;
}

} // namespace silhouette
