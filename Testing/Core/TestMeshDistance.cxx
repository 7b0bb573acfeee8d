// SPDX-License-Identifier: BSD-3-Clause
#include "MeshDistance.h"

#include "Error.h"
#include "EvaluationTestMeshes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

Mesh squareAt(double z, double size)
{
  Mesh mesh;
  mesh.points = { { 0, 0, z }, { size, 0, z }, { size, size, z }, { 0, size, z } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return mesh;
}

MeshDistance distance(const Mesh& from, const Mesh& to, double spacing)
{
  Execution serial;
  return meshDistance(from, to, spacing, serial);
}

Mesh randomTriangles(int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, 4.0), step(-0.5, 0.5);
  Mesh mesh;
  for (int t = 0; t < count; ++t)
  {
    const Eigen::Vector3d origin(place(random), place(random), place(random));
    for (int c = 0; c < 3; ++c)
    {
      mesh.points.push_back(origin + Eigen::Vector3d(step(random), step(random), step(random)));
    }
    mesh.triangles.push_back({ 3 * t, 3 * t + 1, 3 * t + 2 });
  }
  return mesh;
}

/** By descent on barycentric coordinates: slow, and of another kind than what is tested. */
double distanceByDescent(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  const Eigen::Vector3d& c)
{
  double u = 1.0 / 3, v = 1.0 / 3;
  double least = (a + u * (b - a) + v * (c - a) - x).norm();
  for (double step = 0.5; step > 1e-9; step *= 0.7)
  {
    for (int tries = 0; tries < 8; ++tries)
    {
      for (int d = 0; d < 6; ++d)
      {
        const double du[] = { 1, -1, 0, 0, 1, -1 }, dv[] = { 0, 0, 1, -1, -1, 1 };
        const double nu = std::clamp(u + step * du[d], 0.0, 1.0);
        const double nv = std::clamp(v + step * dv[d], 0.0, 1.0 - nu);
        const double here = (a + nu * (b - a) + nv * (c - a) - x).norm();
        if (here < least)
        {
          least = here;
          u = nu;
          v = nv;
        }
      }
    }
  }
  return least;
}

} // namespace

TEST(MeshDistance, ParallelSquares)
{
  const MeshDistance d = distance(squareAt(0, 1), squareAt(0.25, 1), 0.1);
  EXPECT_NEAR(d.mean, 0.25, 1e-12);
  EXPECT_NEAR(d.rms, 0.25, 1e-12);
  EXPECT_NEAR(d.maximum, 0.25, 1e-12);
}

TEST(MeshDistance, BeyondTheBorder)
{
  // A square against its lower left quarter: farthest at the corner.
  const MeshDistance d = distance(squareAt(0, 2), squareAt(0, 1), 0.02);
  EXPECT_NEAR(d.maximum, std::sqrt(2.0), 1e-12);
  // Zero on a quarter; two strips of mean 1/2; on the last quarter the mean distance from a corner.
  const double corner = (std::sqrt(2.0) + std::log(1.0 + std::sqrt(2.0))) / 3.0;
  EXPECT_NEAR(d.mean, (0.0 + 0.5 + 0.5 + corner) / 4.0, 1e-4);
  EXPECT_NEAR(d.rms, std::sqrt((1.0 / 3 + 1.0 / 3 + 2.0 / 3) / 4.0), 1e-4);
  EXPECT_NEAR(distance(squareAt(0, 1), squareAt(0, 2), 0.02).maximum, 0.0, 1e-12);
}

TEST(MeshDistance, ConcentricSpheres)
{
  Execution serial;
  const MeshComparison c = compareMeshes(sphereMesh(4, 1.0), sphereMesh(4, 1.1), 0.05, serial);
  EXPECT_NEAR(c.meshToTruth.mean, 0.1, 0.003);
  EXPECT_NEAR(c.truthToMesh.mean, 0.1, 0.003);
  EXPECT_NEAR(c.mean, (c.meshToTruth.mean + c.truthToMesh.mean) / 2, 1e-15);
  EXPECT_EQ(c.hausdorff, std::max(c.meshToTruth.maximum, c.truthToMesh.maximum));
  const double squares = c.meshToTruth.rms * c.meshToTruth.rms + c.truthToMesh.rms * c.truthToMesh.rms;
  EXPECT_NEAR(c.rms, std::sqrt(squares / 2), 1e-15);
}

TEST(MeshDistance, OneSideAlone)
{
  // What the mesh lacks only the other direction sees.
  Execution serial;
  const Mesh truth = joined(boxMesh(0, 1), boxMesh(5, 6));
  const MeshComparison c = compareMeshes(boxMesh(0, 1), truth, 0.2, serial);
  EXPECT_NEAR(c.meshToTruth.maximum, 0.0, 1e-12);
  EXPECT_NEAR(c.truthToMesh.maximum, std::sqrt(75.0), 1e-12);
  EXPECT_NEAR(c.hausdorff, std::sqrt(75.0), 1e-12);
}

TEST(MeshDistance, EqualsBruteForce)
{
  const Mesh to = randomTriangles(60, 1);
  for (unsigned seed = 2; seed < 6; ++seed)
  {
    const Mesh from = randomTriangles(10, seed);
    double sum = 0.0, weight = 0.0;
    for (const Triangle& t : from.triangles)
    {
      const auto &a = from.points[t[0]], &b = from.points[t[1]], &c = from.points[t[2]];
      double least = std::numeric_limits<double>::infinity();
      for (const Triangle& o : to.triangles)
      {
        least = std::min(
          least, distanceByDescent((a + b + c) / 3.0, to.points[o[0]], to.points[o[1]], to.points[o[2]]));
      }
      const double area = (b - a).cross(c - a).norm();
      sum += area * least;
      weight += area;
    }
    // A spacing beyond every edge: one sample a triangle, its centroid.
    EXPECT_NEAR(distance(from, to, 100.0).mean, sum / weight, 1e-5);
  }
}

TEST(MeshDistance, SamplesAreCentroids)
{
  // The mean of a linear function over equal parts is exact: distance to a far plane is such a function.
  Mesh from;
  from.points = { { 0, 0, 1 }, { 1, 0, 2 }, { 0.2, 0.9, 4 } };
  from.triangles = { { 0, 1, 2 } };
  Mesh plane = squareAt(0, 100);
  for (auto& p : plane.points)
  {
    p -= Eigen::Vector3d(50, 50, 0);
  }
  for (const double spacing : { 10.0, 1.0, 0.3, 0.05 })
  {
    EXPECT_NEAR(distance(from, plane, spacing).mean, 7.0 / 3.0, 1e-12) << spacing;
    EXPECT_NEAR(distance(from, plane, spacing).maximum, 4.0, 1e-12) << spacing;
  }
}

TEST(MeshDistance, DegenerateTriangles)
{
  Mesh needle;
  needle.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  needle.triangles = { { 0, 1, 2 } };
  EXPECT_NEAR(distance(squareAt(1, 2), needle, 0.1).maximum, std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(distance(needle, squareAt(1, 2), 0.1).mean, 1.0, 1e-12);
}

TEST(MeshDistance, AnyNumberOfThreads)
{
  const Mesh from = randomTriangles(700, 8), to = randomTriangles(500, 9);
  ThreadedExecution threads(5);
  const MeshDistance a = distance(from, to, 0.3), b = meshDistance(from, to, 0.3, threads);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.rms, b.rms);
  EXPECT_EQ(a.maximum, b.maximum);
}

TEST(MeshDistance, RejectsAndCancels)
{
  EXPECT_THROW(distance(Mesh(), squareAt(0, 1), 0.1), InvalidInput);
  EXPECT_THROW(distance(squareAt(0, 1), Mesh(), 0.1), InvalidInput);
  EXPECT_THROW(distance(squareAt(0, 1), squareAt(0, 1), 0.0), InvalidInput);
  EXPECT_THROW(distance(squareAt(0, 1), squareAt(0, 1), std::nan("")), InvalidInput);
  EXPECT_THROW(distance(squareAt(0, 1), squareAt(0, 1), 1e-9), InvalidInput);
  CancelledExecution cancelled;
  EXPECT_THROW(meshDistance(squareAt(0, 1), squareAt(0, 1), 0.1, cancelled), Cancelled);
  ProgressExecution progress;
  compareMeshes(squareAt(0, 1), squareAt(0, 1), 0.1, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}
