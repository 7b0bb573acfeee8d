// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRendering.h"

#include "Error.h"
#include "EvaluationTestMeshes.h"
#include "ExactPredicates.h"

#include <gtest/gtest.h>

#include <random>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** u = x, v = y for any z. */
Projection flat()
{
  Projection P = Projection::Zero();
  P(0, 0) = P(1, 1) = P(2, 3) = 1.0;
  return P;
}

/** A camera at the origin that looks along +z. */
Projection pinhole(double focal, double centre)
{
  Projection P = Projection::Zero();
  P << focal, 0, centre, 0, 0, focal, centre, 0, 0, 0, 1, 0;
  return P;
}

bool inTriangle(const Vector2& p, const std::array<Vector2, 3>& t)
{
  const int a = orient2d(t[0], t[1], p), b = orient2d(t[1], t[2], p), c = orient2d(t[2], t[0], p);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

std::size_t objectPixels(const BinaryImage& image)
{
  return std::size_t(std::count(image.pixels.begin(), image.pixels.end(), 1));
}

Mesh flatTriangles(std::mt19937& random, int count, bool whole)
{
  std::uniform_real_distribution<double> place(-10.0, 50.0);
  Mesh mesh;
  for (int t = 0; t < count; ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double x = place(random), y = place(random);
      mesh.points.emplace_back(whole ? std::round(x) : x, whole ? std::round(y) : y, 0.0);
    }
    mesh.triangles.push_back({ 3 * t, 3 * t + 1, 3 * t + 2 });
  }
  return mesh;
}

void compareWithPointInTriangle(bool whole)
{
  std::mt19937 random(7);
  for (int run = 0; run < 200; ++run)
  {
    const Mesh mesh = flatTriangles(random, 1, whole);
    const std::array<Vector2, 3> t{ mesh.points[0].head<2>(), mesh.points[1].head<2>(),
      mesh.points[2].head<2>() };
    if (orient2d(t[0], t[1], t[2]) == 0)
    {
      continue;
    }
    const BinaryImage image = renderSilhouette(mesh, flat(), 40, 30);
    for (int v = 0; v < 30; ++v)
    {
      for (int u = 0; u < 40; ++u)
      {
        ASSERT_EQ(bool(image.at(u, v)), inTriangle(Vector2(u, v), t)) << run << " pixel " << u << " " << v;
      }
    }
  }
}

} // namespace

TEST(SilhouetteRendering, EqualsPointInTriangle)
{
  compareWithPointInTriangle(false);
}

TEST(SilhouetteRendering, TrianglesAreClosedAtWholeCoordinates)
{
  compareWithPointInTriangle(true);
}

TEST(SilhouetteRendering, NeighboursLeaveNoCracks)
{
  // A random fan around a point covers its whole polygon.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int run = 0; run < 50; ++run)
  {
    Mesh mesh;
    mesh.points.emplace_back(99.5 + part(random), 99.5 + part(random), 0.0);
    const int n = 60;
    for (int i = 0; i < n; ++i)
    {
      const double angle = 2 * std::acos(-1.0) * (i + 0.9 * part(random)) / n;
      mesh.points.emplace_back(100 + 95 * std::cos(angle), 100 + 95 * std::sin(angle), 0.0);
      mesh.triangles.push_back({ 0, i + 1, i + 2 == n + 1 ? 1 : i + 2 });
    }
    const BinaryImage image = renderSilhouette(mesh, flat(), 200, 200);
    for (int v = 0; v < 200; ++v)
    {
      for (int u = 0; u < 200; ++u)
      {
        if (std::hypot(u - 100, v - 100) < 90)
        {
          ASSERT_EQ(image.at(u, v), 1) << u << " " << v;
        }
      }
    }
  }
}

TEST(SilhouetteRendering, SphereIsADisc)
{
  Mesh mesh = sphereMesh(5, 1.0);
  for (auto& p : mesh.points)
  {
    p[2] += 4.0;
  }
  const BinaryImage image = renderSilhouette(mesh, pinhole(500, 200), 401, 401);
  const double radius = 500.0 / std::sqrt(15.0); // of the cone that touches the sphere
  const double area = std::acos(-1.0) * radius * radius;
  EXPECT_NEAR(double(objectPixels(image)), area, 0.002 * area);
  EXPECT_EQ(image.at(200, 200), 1);
  EXPECT_EQ(image.at(200, 200 - int(radius) + 1), 1);
  EXPECT_EQ(image.at(200, 200 - int(radius) - 1), 0);
}

TEST(SilhouetteRendering, ScaleOfTheProjectionDoesNotCount)
{
  Mesh mesh = boxMesh({ -1, -1, 3 }, { 1, 1, 5 });
  const BinaryImage image = renderSilhouette(mesh, pinhole(64, 40), 81, 81);
  EXPECT_EQ(renderSilhouette(mesh, pinhole(64, 40) * 1024.0, 81, 81).pixels, image.pixels);
  EXPECT_GT(objectPixels(image), 0u);
}

TEST(SilhouetteRendering, CutsAtTheCameraPlane)
{
  // A wide floor one unit below the camera, from behind it to far in front: all rows below the horizon.
  Mesh mesh;
  mesh.points = { { -1e5, 1, -10 }, { 1e5, 1, -10 }, { 1e5, 1, 1e4 }, { -1e5, 1, 1e4 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  const BinaryImage image = renderSilhouette(mesh, pinhole(50, 50), 101, 101);
  for (int v = 0; v < 101; ++v)
  {
    for (int u = 0; u < 101; ++u)
    {
      ASSERT_EQ(image.at(u, v), v > 50 ? 1 : 0) << u << " " << v;
    }
  }
}

TEST(SilhouetteRendering, BehindTheCameraNothingIsSeen)
{
  EXPECT_EQ(
    objectPixels(renderSilhouette(boxMesh({ -1, -1, -5 }, { 1, 1, -3 }), pinhole(50, 50), 101, 101)), 0u);
  EXPECT_EQ(objectPixels(renderSilhouette(Mesh(), pinhole(50, 50), 101, 101)), 0u);
}

TEST(SilhouetteRendering, InsideTheObjectAllIsObject)
{
  EXPECT_EQ(objectPixels(renderSilhouette(boxMesh(-1, 1), pinhole(50, 50), 101, 101)), 101u * 101u);
}

TEST(SilhouetteRendering, RejectsInvalidInput)
{
  EXPECT_THROW(renderSilhouette(boxMesh(0, 1), flat(), 0, 5), InvalidInput);
  Mesh mesh = boxMesh(0, 1);
  mesh.triangles[3][1] = 8;
  EXPECT_THROW(renderSilhouette(mesh, flat(), 5, 5), InvalidInput);
  Projection P = flat();
  P(0, 0) = std::nan("");
  EXPECT_THROW(renderSilhouette(boxMesh(0, 1), P, 5, 5), InvalidInput);
}
