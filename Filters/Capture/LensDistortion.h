// SPDX-License-Identifier: BSD-3-Clause
/**
 * Lenses that bend straight lines, and images as a lens without that would have made them.
 */
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * How a lens distorts: a point at (x, y) = (X / Z, Y / Z) before the camera falls onto the pixel K (x', y', 1), with (x', y') of OpenCV's models.
 */
struct LensDistortion
{
  enum class Model
  {
    Brown,  ///< k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [tx ty]]]]: 4, 5, 8, 12 or 14 coefficients in OpenCV's order
    Fisheye ///< equidistant, k1 k2 k3 k4
  };
  Model model = Model::Brown;
  Eigen::Matrix3d intrinsics = Eigen::Matrix3d::Identity(); ///< K, of the integer family
  std::vector<double> coefficients;

  /** Is there any distortion at all? */
  bool isAny() const;
};

/**
 * The image of a lens without distortion and with the same K: rows from the top, `channels` interleaved bytes a pixel, 1 to 4, linear between pixels; beyond the image
 * its border's pixels go on, and so they do from the radius on at which the lens's polynomial turns back; what would come to lie beyond the new image is cut off. An image of two colours keeps them: each pixel takes the nearer. Throws
 * InvalidInput: a number of coefficients that the model does not have; a side that is not of 1 to 32766 pixels. Cost: a pass or two.
 */
std::vector<std::uint8_t> undistorted(const std::uint8_t* pixels, int width, int height, int channels, const LensDistortion& lens);

} // namespace silhouette
