// SPDX-License-Identifier: BSD-3-Clause
#include "CameraGeometry.h"

#include "CaptureTesting.h"
#include "LensTesting.h"

using namespace silhouette;

namespace
{

Matrix3 matrix(std::initializer_list<double> numbers)
{
  return Eigen::Map<const Matrix3>(numbers.begin());
}

} // namespace

TEST(CameraGeometry, ComposedProjection)
{
  const Matrix3 K = matrix({ 100, 3, 50, 0, 120, 40, 0, 0, 1 });
  const Matrix3 R = matrix({ 0, -1, 0, 1, 0, 0, 0, 0, 1 });
  const Projection P = composedProjection(K, R, Vector3(1, 2, 3), "a");
  // (4, 5, 6) turns to (-5, 4, 6), moves to (-4, 6, 9).
  const Vector2 pixel = pixelOf(P, Vector3(4, 5, 6));
  EXPECT_NEAR(pixel.x(), (100 * -4 + 3 * 6) / 9.0 + 50, 1e-12);
  EXPECT_NEAR(pixel.y(), 120 * 6 / 9.0 + 40, 1e-12);
  EXPECT_EQ(errorOf([&] { composedProjection(1e300 * K, R, Vector3(1e300, 0, 0), "a.yml view 0 'b'"); }),
            "a.yml view 0 'b': K [R t] is too large to be finite");
}

TEST(CameraGeometry, RotationAboutAVector)
{
  EXPECT_EQ(rotationAbout(Vector3::Zero()), Matrix3::Identity());
  const double angle = 0.7;
  const Matrix3 expected = matrix({ std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1 });
  EXPECT_LT((rotationAbout(Vector3(0, 0, angle)) - expected).norm(), 1e-15);
  const Vector3 axis(0.3, -0.5, 0.2); // a third of a turn three times is none
  const Matrix3 third = rotationAbout(axis.normalized() * (2 * EIGEN_PI / 3));
  EXPECT_LT((third * third * third - Matrix3::Identity()).norm(), 1e-14);
  EXPECT_LT((third * axis - axis).norm(), 1e-15);
}

TEST(CameraGeometry, WhatIsNoCameraIsRefused)
{
  const Matrix3 K = matrix({ 100, 3, 50, 0, 120, 40, 0, 0, 1 });
  EXPECT_EQ(checkedIntrinsics(K, "a"), K);
  EXPECT_EQ(errorOf([] { checkedIntrinsics(matrix({ 1, 0, 0, 0.5, 1, 0, 0, 0, 1 }), "a"); }),
            "a: K is 1 0 0, 0.5 1 0, 0 0 1; fx s cx, 0 fy cy, 0 0 1 are needed");
  EXPECT_EQ(errorOf([] { checkedIntrinsics(matrix({ 1, 0, 0, 0, 1, 0, 0, 0, 2 }), "a"); }), "a: K is 1 0 0, 0 1 0, 0 0 2; fx s cx, 0 fy cy, 0 0 1 are needed");
  EXPECT_EQ(errorOf([] { checkedIntrinsics(matrix({ 1, 0, 0, 0, -2, 0, 0, 0, 1 }), "a"); }), "a: focal lengths 1 and -2 are not above 0");
  EXPECT_EQ(checkedRotation(Matrix3::Identity(), "a"), Matrix3::Identity());
  EXPECT_EQ(errorOf([] { checkedRotation(-Matrix3::Identity(), "a"); }), "a: R is no rotation: -1 -0 -0, -0 -1 -0, -0 -0 -1");
  EXPECT_EQ(errorOf([] { checkedRotation(matrix({ 1, 0, 0, 0, 1, 0, 0, 0, 1.01 }), "a"); }), "a: R is no rotation: 1 0 0, 0 1 0, 0 0 1.01");
}
