// SPDX-License-Identifier: BSD-3-Clause
#include "ExactPredicates.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using namespace silhouette;
using Rational = boost::multiprecision::cpp_rational;

namespace
{

using Point2 = Eigen::Vector2d;
using Point3 = Eigen::Vector3d;

int truth2d(const Point2& a, const Point2& b, const Point2& c)
{
  const Rational x = Rational(b[0]) - Rational(a[0]), y = Rational(b[1]) - Rational(a[1]);
  const Rational determinant = x * (Rational(c[1]) - Rational(a[1])) - y * (Rational(c[0]) - Rational(a[0]));
  return determinant.sign();
}

int truth3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  std::array<std::array<Rational, 3>, 3> m;
  for (int i = 0; i < 3; ++i)
  {
    m[0][i] = Rational(b[i]) - Rational(a[i]);
    m[1][i] = Rational(c[i]) - Rational(a[i]);
    m[2][i] = Rational(d[i]) - Rational(a[i]);
  }
  const Rational determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
    m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return determinant.sign();
}

struct Numbers
{
  std::mt19937_64 random{ 11 };

  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(this->random); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(this->random); }
  /** A few steps to a neighbouring double. */
  double nudged(double x)
  {
    for (int n = this->whole(0, 2); n > 0; --n)
    {
      x = std::nextafter(x, this->whole(0, 1) ? 10.0 : -10.0);
    }
    return x;
  }
  template <typename Point>
  Point point()
  {
    Point p;
    for (int i = 0; i < p.size(); ++i)
    {
      p[i] = this->uniform();
    }
    return p;
  }
  template <typename Point>
  Point nudged(Point p)
  {
    for (int i = 0; i < p.size(); ++i)
    {
      p[i] = this->nudged(p[i]);
    }
    return p;
  }
};

} // namespace

TEST(ExactPredicates, Orientation)
{
  EXPECT_EQ(orient2d({ 0, 0 }, { 1, 0 }, { 0, 1 }), 1);
  EXPECT_EQ(orient2d({ 0, 0 }, { 0, 1 }, { 1, 0 }), -1);
  EXPECT_EQ(orient2d({ 0, 0 }, { 1, 1 }, { 3, 3 }), 0);
  EXPECT_EQ(orient3d({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 1);
  EXPECT_EQ(orient3d({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, -1 }), -1);
  EXPECT_EQ(orient3d({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 7, 5, 0 }), 0);
}

TEST(ExactPredicates, RandomPoints2d)
{
  Numbers numbers;
  for (int n = 0; n < 5000; ++n)
  {
    const auto a = numbers.point<Point2>(), b = numbers.point<Point2>(), c = numbers.point<Point2>();
    ASSERT_EQ(orient2d(a, b, c), truth2d(a, b, c));
  }
}

TEST(ExactPredicates, NearlyCollinear)
{
  Numbers numbers;
  int misjudged = 0;
  for (int n = 0; n < 10000; ++n)
  {
    const auto a = numbers.point<Point2>(), b = numbers.point<Point2>();
    const Point2 c = numbers.nudged(Point2(a + numbers.uniform() * (b - a)));
    const int sign = orient2d(a, b, c);
    const Point2 p = b - a, q = c - a;
    misjudged += (p[0] * q[1] > p[1] * q[0]) != (sign > 0);
    ASSERT_EQ(sign, truth2d(a, b, c));
    ASSERT_EQ(orient2d(b, a, c), -sign);
    ASSERT_EQ(orient2d(b, c, a), sign);
  }
  EXPECT_GT(misjudged, 0) << "plain floating point is right each time: the test shows nothing";
}

TEST(ExactPredicates, RandomPoints3d)
{
  Numbers numbers;
  for (int n = 0; n < 5000; ++n)
  {
    const auto a = numbers.point<Point3>(), b = numbers.point<Point3>(), c = numbers.point<Point3>();
    const auto d = numbers.point<Point3>();
    ASSERT_EQ(orient3d(a, b, c, d), truth3d(a, b, c, d));
  }
}

TEST(ExactPredicates, NearlyCoplanar)
{
  Numbers numbers;
  for (int n = 0; n < 10000; ++n)
  {
    const auto a = numbers.point<Point3>(), b = numbers.point<Point3>(), c = numbers.point<Point3>();
    const Point3 d = numbers.nudged(Point3(a + numbers.uniform() * (b - a) + numbers.uniform() * (c - a)));
    const int sign = orient3d(a, b, c, d);
    ASSERT_EQ(sign, truth3d(a, b, c, d));
    ASSERT_EQ(orient3d(b, a, c, d), -sign);
    ASSERT_EQ(orient3d(d, c, b, a), sign);
  }
}

TEST(ExactPredicates, NearlyCoincident)
{
  Numbers numbers;
  for (int n = 0; n < 10000; ++n)
  {
    const auto a = numbers.point<Point3>();
    const Point3 b = numbers.nudged(a), c = numbers.nudged(a), d = numbers.nudged(a);
    ASSERT_EQ(orient3d(a, b, c, d), truth3d(a, b, c, d));
  }
}

TEST(ExactPredicates, LatticePoints)
{
  Numbers numbers;
  int zeros = 0;
  for (int n = 0; n < 5000; ++n)
  {
    std::array<Point3, 4> p;
    for (auto& q : p)
    {
      // The steps are not exact, so that what looks coplanar is not quite.
      q = Point3(numbers.whole(0, 3), numbers.whole(0, 3), numbers.whole(0, 3)) * 0.1 + Point3(0.3, 0.7, 1e3);
    }
    const int sign = orient3d(p[0], p[1], p[2], p[3]);
    zeros += sign == 0;
    ASSERT_EQ(sign, truth3d(p[0], p[1], p[2], p[3]));
  }
  EXPECT_GT(zeros, 500);
}

TEST(ExactPredicates, MagnitudesFarApart)
{
  Numbers numbers;
  const auto scaled = [&numbers](Point3 p)
  {
    for (int i = 0; i < 3; ++i)
    {
      p[i] = numbers.whole(0, 5) == 0 ? 0.0 : std::ldexp(p[i], numbers.whole(-290, 290));
    }
    return p;
  };
  for (int n = 0; n < 2000; ++n)
  {
    const Point3 a = scaled(numbers.point<Point3>()), b = scaled(numbers.point<Point3>());
    const Point3 c = scaled(numbers.point<Point3>()), d = scaled(numbers.point<Point3>());
    ASSERT_EQ(orient3d(a, b, c, d), truth3d(a, b, c, d));
    ASSERT_EQ(
      orient2d(a.head<2>(), b.head<2>(), c.head<2>()), truth2d(a.head<2>(), b.head<2>(), c.head<2>()));
  }
}
