// SPDX-License-Identifier: BSD-3-Clause
#include "MeshSoundness.h"

#include "Error.h"
#include "EvaluationTestMeshes.h"

#include <gtest/gtest.h>

#include <random>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

const double Pi = std::acos(-1.0);

MeshSoundness assessed(const Mesh& mesh)
{
  Execution serial;
  return assessMesh(mesh, serial);
}

/** Replaces point `from` by point `to` in the triangles. */
Mesh merged(Mesh mesh, std::int32_t from, std::int32_t to)
{
  for (Triangle& t : mesh.triangles)
  {
    std::replace(t.begin(), t.end(), from, to);
  }
  return mesh;
}

Mesh flipped(Mesh mesh)
{
  for (Triangle& t : mesh.triangles)
  {
    std::swap(t[1], t[2]);
  }
  return mesh;
}

/** Every triangle with points of its own, as a format without shared points stores it. */
Mesh soup(const Mesh& mesh)
{
  Mesh result;
  for (const Triangle& t : mesh.triangles)
  {
    const auto first = std::int32_t(result.points.size());
    for (const auto p : t)
    {
      result.points.push_back(mesh.points[p]);
    }
    result.triangles.push_back({ first, first + 1, first + 2 });
  }
  return result;
}

} // namespace

TEST(MeshSoundness, Box)
{
  const MeshSoundness box = assessed(boxMesh({ 1000, 2000, 3000 }, { 1001, 2002, 3003 }));
  EXPECT_TRUE(box.closed());
  EXPECT_TRUE(box.sound());
  EXPECT_EQ(box.points, 8u);
  EXPECT_EQ(box.unusedPoints, 0u);
  EXPECT_EQ(box.triangles, 12u);
  EXPECT_EQ(box.components, 1u);
  ASSERT_TRUE(box.genus.has_value());
  EXPECT_EQ(*box.genus, 0);
  EXPECT_NEAR(box.volume, 6.0, 1e-12);
  EXPECT_NEAR(box.area, 22.0, 1e-12);
}

TEST(MeshSoundness, Icosahedron)
{
  const MeshSoundness solid = assessed(sphereMesh(0, 1.0));
  const double edge = 1.0 / std::sin(2.0 * Pi / 5.0);
  EXPECT_TRUE(solid.sound());
  EXPECT_EQ(*solid.genus, 0);
  EXPECT_NEAR(solid.volume, 5.0 / 12.0 * (3.0 + std::sqrt(5.0)) * edge * edge * edge, 1e-12);
  EXPECT_NEAR(solid.area, 5.0 * std::sqrt(3.0) * edge * edge, 1e-12);
}

TEST(MeshSoundness, SphereConverges)
{
  double last = 1.0;
  for (int s = 2; s < 6; ++s)
  {
    const MeshSoundness sphere = assessed(sphereMesh(s, 2.0));
    const double error = std::abs(sphere.volume / (32.0 / 3.0 * Pi) - 1.0);
    EXPECT_TRUE(sphere.sound());
    EXPECT_LT(error, 0.3 * last); // of second order: a quarter each time
    last = error;
  }
}

TEST(MeshSoundness, Torus)
{
  const MeshSoundness torus = assessed(torusMesh(200, 100, 3.0, 1.0));
  EXPECT_TRUE(torus.sound());
  EXPECT_EQ(*torus.genus, 1);
  EXPECT_NEAR(torus.volume, 2.0 * Pi * Pi * 3.0, 0.002 * torus.volume);
  EXPECT_NEAR(torus.area, 4.0 * Pi * Pi * 3.0, 0.002 * torus.area);
}

TEST(MeshSoundness, ComponentsAddUp)
{
  Mesh mesh = joined(torusMesh(20, 10, 3.0, 1.0), boxMesh(10, 11));
  Mesh other = torusMesh(20, 10, 3.0, 1.0);
  for (auto& p : other.points)
  {
    p[2] += 50;
  }
  mesh = joined(mesh, other);
  mesh.points.emplace_back(5, 5, 5);
  const MeshSoundness all = assessed(mesh);
  EXPECT_TRUE(all.sound());
  EXPECT_EQ(all.components, 3u);
  EXPECT_EQ(*all.genus, 2);
  EXPECT_EQ(all.unusedPoints, 1u);
  EXPECT_EQ(all.points, 408u);
}

TEST(MeshSoundness, CavityCountsNegative)
{
  const MeshSoundness hollow = assessed(joined(boxMesh(0, 3), flipped(boxMesh(1, 2))));
  EXPECT_TRUE(hollow.sound());
  EXPECT_NEAR(hollow.volume, 26.0, 1e-12);
  EXPECT_EQ(hollow.components, 2u);
}

TEST(MeshSoundness, InsideOutIsNotSound)
{
  const MeshSoundness box = assessed(flipped(boxMesh(0, 1)));
  EXPECT_TRUE(box.closed());
  EXPECT_NEAR(box.volume, -1.0, 1e-12);
  EXPECT_FALSE(box.sound());
}

TEST(MeshSoundness, Empty)
{
  const MeshSoundness nothing = assessed(Mesh());
  EXPECT_FALSE(nothing.closed());
  EXPECT_FALSE(nothing.sound());
  EXPECT_FALSE(nothing.genus.has_value());
  EXPECT_EQ(nothing.components, 0u);
  EXPECT_EQ(nothing.volume, 0.0);
}

TEST(MeshSoundness, Open)
{
  Mesh mesh = boxMesh(0, 1);
  mesh.triangles.pop_back();
  const MeshSoundness open = assessed(mesh);
  EXPECT_EQ(open.openEdges, 3u);
  EXPECT_EQ(open.nonManifoldVertices, 0u);
  EXPECT_FALSE(open.closed());
  EXPECT_FALSE(open.sound());
  EXPECT_FALSE(open.genus.has_value());
}

TEST(MeshSoundness, FlippedTriangle)
{
  Mesh mesh = boxMesh(0, 1);
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  const MeshSoundness box = assessed(mesh);
  EXPECT_EQ(box.inconsistentEdges, 3u);
  EXPECT_EQ(box.openEdges, 0u);
  EXPECT_TRUE(box.closed());
  EXPECT_FALSE(box.sound());
}

TEST(MeshSoundness, BoxesThatShareAPoint)
{
  // Corner 7 of the first is corner 0 of the second.
  const MeshSoundness two = assessed(merged(joined(boxMesh(0, 1), boxMesh(1, 2)), 8, 7));
  EXPECT_EQ(two.nonManifoldVertices, 1u);
  EXPECT_EQ(two.nonManifoldEdges, 0u);
  EXPECT_EQ(two.openEdges, 0u);
  EXPECT_EQ(two.components, 1u);
  EXPECT_EQ(two.unusedPoints, 1u);
  EXPECT_EQ(two.selfIntersections, 0u);
  EXPECT_FALSE(two.genus.has_value());
  EXPECT_FALSE(two.sound());
}

TEST(MeshSoundness, BoxesThatShareAnEdge)
{
  const Mesh boxes = joined(boxMesh({ 0, 0, 0 }, { 1, 1, 1 }), boxMesh({ 1, 1, 0 }, { 2, 2, 1 }));
  const MeshSoundness two = assessed(merged(merged(boxes, 8, 3), 12, 7));
  EXPECT_EQ(two.nonManifoldEdges, 1u);
  EXPECT_EQ(two.nonManifoldVertices, 2u) << "the edge's ends";
  EXPECT_EQ(two.openEdges, 0u);
  EXPECT_EQ(two.selfIntersections, 0u);
  EXPECT_FALSE(two.sound());
}

TEST(MeshSoundness, TouchingAndInterpenetratingSolids)
{
  EXPECT_GT(assessed(joined(boxMesh(0, 1), boxMesh(1, 2))).selfIntersections, 0u);
  EXPECT_GT(
    assessed(joined(tetrahedron({ 0, 0, 0 }, 1), tetrahedron({ 0.1, 0.1, 0.1 }, 1))).selfIntersections, 0u);
}

TEST(MeshSoundness, DegenerateTriangles)
{
  Mesh mesh = boxMesh(0, 1);
  mesh.triangles.push_back({ 0, 0, 1 });
  const MeshSoundness box = assessed(mesh);
  EXPECT_EQ(box.selfIntersections, 1u);
  EXPECT_GT(box.nonManifoldEdges, 0u);
  EXPECT_FALSE(box.sound());
}

TEST(MeshSoundness, WeldingASoup)
{
  Mesh mesh = torusMesh(30, 20, 3.0, 1.0);
  const Mesh loose = soup(mesh);
  EXPECT_EQ(assessed(loose).openEdges, 3u * mesh.triangles.size());
  const Mesh welded = weldCoincidentPoints(loose);
  EXPECT_EQ(welded.points.size(), mesh.points.size());
  EXPECT_TRUE(assessed(welded).sound());
  EXPECT_EQ(*assessed(welded).genus, 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(welded.points[welded.triangles[t][c]], mesh.points[mesh.triangles[t][c]]);
    }
  }
}

TEST(MeshSoundness, WeldingKeepsTheFirstAppearance)
{
  Mesh mesh;
  mesh.points = { { 3, 0, 0 }, { -0.0, 1, 0 }, { 0.0, 1, 0 }, { 1, 1, 1 }, { 3, 0, -0.0 },
    { 1, 1, 1.0000001 } };
  mesh.triangles = { { 0, 1, 3 }, { 4, 2, 5 }, { 1, 2, 3 } };
  const Mesh welded = weldCoincidentPoints(mesh);
  ASSERT_EQ(welded.points.size(), 4u);
  EXPECT_EQ(welded.points[0][0], 3.0);
  EXPECT_EQ(welded.points[3][2], 1.0000001);
  EXPECT_EQ(welded.triangles, (std::vector<Triangle>{ { 0, 1, 2 }, { 0, 1, 3 }, { 1, 1, 2 } }));
}

TEST(MeshSoundness, AnyNumberOfThreads)
{
  std::mt19937 random(4);
  std::uniform_int_distribution<int> point(0, 400);
  Mesh mesh = torusMesh(30, 20, 3.0, 1.0);
  for (int t = 0; t < 30; ++t)
  {
    mesh.triangles.push_back({ point(random), point(random), point(random) });
  }
  ThreadedExecution threads(4);
  const MeshSoundness a = assessed(mesh), b = assessMesh(mesh, threads);
  EXPECT_EQ(a.nonManifoldVertices, b.nonManifoldVertices);
  EXPECT_EQ(a.selfIntersections, b.selfIntersections);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_GT(a.nonManifoldVertices, 0u);
}

TEST(MeshSoundness, RejectsAndCancels)
{
  Mesh mesh = boxMesh(0, 1);
  CancelledExecution cancelled;
  EXPECT_THROW(assessMesh(mesh, cancelled), Cancelled);
  ProgressExecution progress;
  assessMesh(mesh, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
  mesh.triangles[0][0] = 99;
  EXPECT_THROW(assessed(mesh), InvalidInput);
  EXPECT_THROW(weldCoincidentPoints(mesh), InvalidInput);
}
