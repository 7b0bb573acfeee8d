// SPDX-License-Identifier: BSD-3-Clause
#include "Regions.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <vector>

namespace silhouette
{

namespace
{

struct Labels
{
  cv::Mat label; ///< of each pixel; 0 is outside all regions
  cv::Mat statistics;
  int count = 0; ///< of labels, 0 included

  Labels(const BinaryImage& image, std::uint8_t value, int connectivity)
  {
    const cv::Mat original(image.height, image.width, CV_8UC1,
                           const_cast<std::uint8_t*>(image.pixels.data()));
    cv::Mat centroids;
    this->count = cv::connectedComponentsWithStats(original == value, this->label, this->statistics,
                                                   centroids, connectivity);
  }
  int at(int region, cv::ConnectedComponentsTypes what) const
  {
    return this->statistics.at<int>(region, what);
  }
  int of(int column, int row) const { return this->label.at<int>(row, column); }
};

/** Labels of the regions that hold more pixels than, or as many as, every other. */
std::vector<bool> largestLabels(const Labels& labels)
{
  int most = 0;
  for (int i = 1; i < labels.count; ++i)
  {
    most = std::max(most, labels.at(i, cv::CC_STAT_AREA));
  }
  std::vector<bool> largest(std::size_t(labels.count), false);
  for (int i = 1; i < labels.count; ++i)
  {
    largest[std::size_t(i)] = labels.at(i, cv::CC_STAT_AREA) == most;
  }
  return largest;
}

} // namespace

BinaryImage largestRegion(const BinaryImage& image)
{
  const Labels labels(image, 1, 8);
  if (labels.count <= 2)
  {
    return image;
  }
  const std::vector<bool> largest = largestLabels(labels);
  BinaryImage out = image;
  int kept = 0; // how labels are numbered is not promised: the first pixel decides
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const int label = labels.of(column, row);
      kept = kept == 0 && largest[std::size_t(label)] ? label : kept;
      out.at(column, row) = label != 0 && label == kept ? 1 : 0;
    }
  }
  return out;
}

BinaryImage fillHoles(const BinaryImage& image, int pixels)
{
  const Labels labels(image, 0, 4);
  std::vector<bool> filled(std::size_t(labels.count), false);
  for (int i = 1; i < labels.count; ++i)
  {
    const int left = labels.at(i, cv::CC_STAT_LEFT);
    const int top = labels.at(i, cv::CC_STAT_TOP);
    const bool touches = left == 0 || top == 0 || left + labels.at(i, cv::CC_STAT_WIDTH) == image.width ||
                         top + labels.at(i, cv::CC_STAT_HEIGHT) == image.height;
    filled[std::size_t(i)] = !touches && labels.at(i, cv::CC_STAT_AREA) < pixels;
  }
  BinaryImage out = image;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      if (filled[std::size_t(labels.of(column, row))])
      {
        out.at(column, row) = 1;
      }
    }
  }
  return out;
}

} // namespace silhouette
