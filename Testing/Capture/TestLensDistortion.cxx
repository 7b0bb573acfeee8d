// SPDX-License-Identifier: BSD-3-Clause
#include "LensDistortion.h"

#include "CameraTesting.h"
#include "CaptureTesting.h"

using namespace silhouette;

namespace
{

constexpr int Width = 400, Height = 300;

LensDistortion lensOf(LensDistortion::Model model, const std::vector<double>& coefficients)
{
  LensDistortion lens;
  lens.model = model;
  lens.intrinsics << 330.0, 0.0, 205.5, 0.0, 320.0, 141.25, 0.0, 0.0, 1.0;
  lens.coefficients = coefficients;
  return lens;
}

/** Where the lens puts a pixel of the image without distortion. */
Vector2 bent(const LensDistortion& lens, const Vector2& pixel)
{
  const Vector2 plane = (lens.intrinsics.inverse() * pixel.homogeneous()).hnormalized();
  const bool isFisheye = lens.model == LensDistortion::Model::Fisheye;
  const Vector2 to = isFisheye ? fisheyeLens(plane, lens.coefficients) : brownLens(plane, lens.coefficients);
  return (lens.intrinsics * to.homogeneous()).hnormalized();
}

/** The inverse for each pixel, by steps back. */
std::vector<Vector2> straightened(const LensDistortion& lens)
{
  std::vector<Vector2> all;
  for (int i = 0; i < Width * Height; ++i)
  {
    const Vector2 pixel(i % Width, i / Width);
    Vector2 found = pixel, error = bent(lens, found) - pixel;
    for (int step = 0; step < 100 && error.norm() > 1e-6; ++step)
    {
      found -= error;
      error = bent(lens, found) - pixel;
    }
    EXPECT_LE(error.norm(), 1e-6);
    all.push_back(found);
  }
  return all;
}

std::vector<LensDistortion> lenses()
{
  using Model = LensDistortion::Model;
  return {lensOf(Model::Brown, {-0.2, 0.05, 0.003, -0.004}), lensOf(Model::Brown, {0.1, 0.0, 0.0, 0.0, 0.02}),
          lensOf(Model::Brown, {-0.1, 0.02, 0.001, 0.002, 0.01, 0.05, -0.01, 0.004}), lensOf(Model::Fisheye, {0.02, -0.01, 0.003, -0.001})};
}

/** A lens's image of a disc, `channels` alike; smooth within two pixels of its edge where asked for. `straight`: straightened() of the lens. */
std::vector<std::uint8_t> discImage(const std::vector<Vector2>& straight, const Vector2& centre, double radius, int channels, bool isSmooth)
{
  std::vector<std::uint8_t> pixels;
  for (const Vector2& pixel : straight)
  {
    const double inside = radius - (pixel - centre).norm();
    const double share = isSmooth ? std::min(std::max(0.5 + inside / 4.0, 0.0), 1.0) : double(inside >= 0.0);
    pixels.insert(pixels.end(), std::size_t(channels), std::uint8_t(std::lround(255.0 * share)));
  }
  return pixels;
}

} // namespace

TEST(LensDistortion, BlobsComeBackWhereTheyWouldBe)
{
  for (const LensDistortion& lens : lenses())
  {
    const std::vector<Vector2> straight = straightened(lens);
    for (const Vector2& centre : {Vector2(60.25, 50.5), Vector2(200.0, 140.0), Vector2(330.5, 240.75)})
    {
      const auto result = undistorted(discImage(straight, centre, 12.0, 3, true).data(), Width, Height, 3, lens);
      ASSERT_EQ(result.size(), std::size_t(Width * Height * 3));
      Vector2 sum = Vector2::Zero();
      double mass = 0.0;
      for (int i = 0; i < Width * Height; ++i)
      {
        const double value = result[std::size_t(3 * i + 1)];
        sum += value * Vector2(i % Width, i / Width);
        mass += value;
      }
      EXPECT_LT((sum / mass - centre).norm(), 0.05) << centre.transpose();
    }
  }
}

TEST(LensDistortion, MasksKeepTheirTwoValues)
{
  for (const LensDistortion& lens : lenses())
  {
    const std::vector<Vector2> straight = straightened(lens);
    for (const int object : {1, 255})
    {
      const Vector2 centre(190.0, 150.0);
      const double radius = 110.0;
      auto mask = discImage(straight, centre, radius, 1, false);
      std::replace(mask.begin(), mask.end(), std::uint8_t(255), std::uint8_t(object));
      const auto result = undistorted(mask.data(), Width, Height, 1, lens);
      for (int i = 0; i < Width * Height; ++i)
      {
        const double inside = radius - (Vector2(i % Width, i / Width) - centre).norm();
        const int value = result[std::size_t(i)];
        ASSERT_TRUE(value == 0 || value == object) << value;
        ASSERT_TRUE(std::abs(inside) < 1.5 || (value == object) == (inside > 0.0)) << i % Width << " " << i / Width;
      }
    }
  }
}

TEST(LensDistortion, NoDistortionLeavesTheImageAsItIs)
{
  const LensDistortion lens = lensOf(LensDistortion::Model::Brown, {0, 0, 0, 0, 0});
  EXPECT_FALSE(lens.isAny());
  EXPECT_TRUE(lenses()[0].isAny());
  EXPECT_TRUE(lensOf(LensDistortion::Model::Fisheye, {0, 0, 0, 0}).isAny()) << "its centre alone is not bent";
  std::vector<std::uint8_t> image(8 * 5 * 4);
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    image[i] = std::uint8_t(37 * i);
  }
  EXPECT_EQ(undistorted(image.data(), 8, 5, 4, lens), image);
}

TEST(LensDistortion, BeyondTheImageItsBorderGoesOn)
{
  const LensDistortion lens = lensOf(LensDistortion::Model::Brown, {0.3, 0.0, 0.0, 0.0}); // corners come from beyond
  const std::vector<std::uint8_t> white(std::size_t(Width * Height), 255);
  EXPECT_EQ(undistorted(white.data(), Width, Height, 1, lens), white);
}

TEST(LensDistortion, PolynomialsThatTurnBackShowNothingTwice)
{
  LensDistortion lens = lensOf(LensDistortion::Model::Brown, {-0.25, 0.0, 0.0, 0.0});
  lens.intrinsics << 150.0, 0.0, 199.5, 0.0, 150.0, 149.5, 0.0, 0.0, 1.0;
  EXPECT_LT((bent(lens, {0.0, 0.0}) - Vector2(199.5, 149.5)).norm(), 90.0) << "the corner falls onto the disc";
  std::vector<std::uint8_t> disc;
  for (int i = 0; i < Width * Height; ++i)
  {
    const double radius = (Vector2(i % Width, i / Width) - Vector2(199.5, 149.5)).norm();
    disc.push_back(radius < 90.0 ? 255 : 0);
  }
  const auto result = undistorted(disc.data(), Width, Height, 1, lens);
  EXPECT_EQ(result[std::size_t(150 * Width + 200)], 255);
  for (const int corner : {0, Width - 1, (Height - 1) * Width, Height * Width - 1})
  {
    EXPECT_EQ(result[std::size_t(corner)], 0);
  }
  lens.model = LensDistortion::Model::Fisheye;
  EXPECT_EQ(undistorted(disc.data(), Width, Height, 1, lens)[0], 0);
}

TEST(LensDistortion, Refuses)
{
  const std::vector<std::uint8_t> row(40000, 0);
  const LensDistortion good = lenses()[0];
  EXPECT_EQ(errorOf([&] { undistorted(row.data(), 32767, 1, 1, good); }),
            "an image of 32767 x 1 pixels and 1 channels; a lens's distortion is taken out of images of 1 to 32766 pixels a side and 1 to 4 channels");
  EXPECT_EQ(undistorted(row.data(), 32766, 1, 1, good).size(), 32766u);
  EXPECT_EQ(errorOf([&] { undistorted(row.data(), 2, 2, 1, lensOf(LensDistortion::Model::Brown, {1, 2, 3})); }), "Brown's lens model has no 3 coefficients");
  EXPECT_EQ(errorOf([&] { undistorted(row.data(), 2, 2, 1, lensOf(LensDistortion::Model::Fisheye, {1, 2, 3, 4, 5})); }),
            "the fisheye lens model has no 5 coefficients");
}
