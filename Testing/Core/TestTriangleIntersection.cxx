// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleIntersection.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace silhouette;
using Rational = boost::multiprecision::cpp_rational;

namespace
{

using Point = Eigen::Vector3d;
using Exact = std::array<Rational, 3>;
using Polygon = std::vector<Exact>;

Exact exact(const Point& p)
{
  return { Rational(p[0]), Rational(p[1]), Rational(p[2]) };
}

Exact operator-(const Exact& a, const Exact& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Exact cross(const Exact& a, const Exact& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Rational dot(const Exact& a, const Exact& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** What lies in the closed half-space normal . (x - origin) >= 0. */
Polygon clipped(const Polygon& polygon, const Exact& normal, const Exact& origin)
{
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Exact& p = polygon[i];
    const Exact& q = polygon[(i + 1) % polygon.size()];
    const Rational dp = dot(normal, p - origin), dq = dot(normal, q - origin);
    if (dp >= 0)
    {
      result.push_back(p);
    }
    if (dp * dq < 0)
    {
      const Rational t = dp / (dp - dq);
      const Exact d = q - p;
      result.push_back({ p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2] });
    }
  }
  return result;
}

/** The corners of what two triangles have in common, by clipping one at the other's plane and sides. */
Polygon common(const std::vector<Point>& points, const Triangle& a, const Triangle& b)
{
  const std::array<Exact, 3> t{ exact(points[a[0]]), exact(points[a[1]]), exact(points[a[2]]) };
  Polygon polygon{ exact(points[b[0]]), exact(points[b[1]]), exact(points[b[2]]) };
  const Exact normal = cross(t[1] - t[0], t[2] - t[0]);
  polygon = clipped(polygon, normal, t[0]);
  polygon = clipped(polygon, { -normal[0], -normal[1], -normal[2] }, t[0]);
  for (int c = 0; c < 3; ++c)
  {
    polygon = clipped(polygon, cross(normal, t[(c + 1) % 3] - t[c]), t[c]);
  }
  return polygon;
}

/**
 * True where a common corner is none of the shared points, nor, for two of them, on the line through them.
 */
bool truth(const std::vector<Point>& points, const Triangle& a, const Triangle& b)
{
  std::vector<Exact> shared;
  for (const auto p : a)
  {
    if (std::find(b.begin(), b.end(), p) != b.end())
    {
      shared.push_back(exact(points[p]));
    }
  }
  for (const Exact& p : common(points, a, b))
  {
    const Exact zero{ 0, 0, 0 };
    const bool explained = (shared.size() == 1 && p == shared[0]) ||
      (shared.size() == 2 && cross(p - shared[0], shared[1] - shared[0]) == zero);
    if (!explained)
    {
      return true;
    }
  }
  return false;
}

/** Random triangles on a small grid: touching, coplanar and folded ones are frequent. */
void compareWithClipping(int shared, int side, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> place(0, side);
  int met = 0;
  int runs = 0;
  for (int n = 0; n < 1500; ++n)
  {
    std::vector<Point> points(6);
    for (Point& p : points)
    {
      // A tilted grid in doubles: what is coplanar on the grid is nearly so here.
      const Point g(place(random), place(random), n % 3 == 0 ? 0 : place(random));
      p = n % 2 == 0 ? g : Point(0.1 * g[0] + 0.3 * g[1], 0.7 * g[1] - 0.1 * g[2], 0.2 * g[2] + 0.1 * g[0]);
    }
    Triangle a{ 0, 1, 2 };
    Triangle b{ shared > 0 ? 0 : 3, shared > 1 ? 1 : 4, shared > 2 ? 2 : 5 };
    std::shuffle(b.begin(), b.end(), random);
    std::shuffle(a.begin(), a.end(), random);
    if (isDegenerate(points, a) || isDegenerate(points, b))
    {
      continue;
    }
    const bool expected = truth(points, a, b);
    ++runs;
    met += expected;
    ASSERT_EQ(trianglesIntersect(points, a, b), expected) << "run " << n;
    ASSERT_EQ(trianglesIntersect(points, b, a), expected) << "run " << n;
  }
  EXPECT_GT(met, 0);
  EXPECT_GT(runs, 500);
}

} // namespace

TEST(TriangleIntersection, NothingShared)
{
  compareWithClipping(0, 3, 1);
  compareWithClipping(0, 6, 2);
}

TEST(TriangleIntersection, CornerShared)
{
  compareWithClipping(1, 3, 3);
}

TEST(TriangleIntersection, EdgeShared)
{
  compareWithClipping(2, 3, 4);
}

TEST(TriangleIntersection, AllShared)
{
  compareWithClipping(3, 3, 5);
}

TEST(TriangleIntersection, FoldedAndFlat)
{
  std::vector<Point> points{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { 1, 1, 0 } };
  points[5][2] = std::ldexp(1.0, -300);
  EXPECT_FALSE(trianglesIntersect(points, { 0, 1, 2 }, { 1, 0, 3 }));
  EXPECT_TRUE(trianglesIntersect(points, { 0, 1, 2 }, { 1, 0, 4 }));
  EXPECT_FALSE(trianglesIntersect(points, { 0, 1, 2 }, { 1, 0, 5 })) << "folded, but for a hair";
}

TEST(TriangleIntersection, ATouchCounts)
{
  const std::vector<Point> points{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0.5, 0.5, 0 }, { 0.5, 0.5, 1 },
    { 1, 0.5, 1 }, { 0.5, 0.5, 1e-60 } };
  EXPECT_TRUE(trianglesIntersect(points, { 0, 1, 2 }, { 3, 4, 5 }));
  EXPECT_FALSE(trianglesIntersect(points, { 0, 1, 2 }, { 6, 4, 5 }));
}

TEST(TriangleIntersection, CoincidentPointsOfDifferentIndexTouch)
{
  const std::vector<Point> points{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { -1, 0, 1 },
    { 0, -1, 1 } };
  EXPECT_TRUE(trianglesIntersect(points, { 0, 1, 2 }, { 3, 4, 5 }));
}

TEST(TriangleIntersection, Degenerate)
{
  const std::vector<Point> points{ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0.5, 0.5, -1 }, { 0.5, 0.5, 1 },
    { 0.5, 0.5, 3 }, { 0.5, 0.5, 0.5 }, { 3, 3, 3 }, { 6, 6, 6 }, { 0.5, 0.5, -1 }, { -1, 0.5, 1 },
    { 2, 0.5, 1 }, { 5, 0.5, 1 } };
  EXPECT_FALSE(isDegenerate(points, { 0, 1, 2 }));
  EXPECT_TRUE(isDegenerate(points, { 0, 7, 8 }));
  EXPECT_TRUE(isDegenerate(points, { 0, 0, 1 }));
  EXPECT_TRUE(isDegenerate(points, { 3, 9, 1 }));
  EXPECT_TRUE(trianglesIntersect(points, { 0, 1, 2 }, { 3, 4, 5 })) << "a needle through the triangle";
  EXPECT_TRUE(trianglesIntersect(points, { 3, 4, 5 }, { 0, 1, 2 }));
  EXPECT_FALSE(trianglesIntersect(points, { 0, 1, 2 }, { 6, 4, 5 })) << "a needle that ends above it";
  EXPECT_TRUE(trianglesIntersect(points, { 3, 4, 6 }, { 10, 11, 12 })) << "two needles that cross";
  EXPECT_FALSE(trianglesIntersect(points, { 3, 6, 6 }, { 10, 11, 12 })) << "two needles that miss each other";
  EXPECT_FALSE(trianglesIntersect(points, { 0, 1, 2 }, { 0, 7, 8 })) << "reported on its own";
}
