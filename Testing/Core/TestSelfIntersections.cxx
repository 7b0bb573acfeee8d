// SPDX-License-Identifier: BSD-3-Clause
#include "SelfIntersections.h"

#include "Error.h"
#include "EvaluationTestMeshes.h"
#include "TriangleIntersection.h"

#include <gtest/gtest.h>

#include <cmath>

#include <random>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

std::vector<TrianglePair> allPairs(const Mesh& mesh)
{
  std::vector<TrianglePair> result;
  for (std::int32_t a = 0; a < std::int32_t(mesh.triangles.size()); ++a)
  {
    if (isDegenerate(mesh.points, mesh.triangles[a]))
    {
      result.push_back({ a, a });
    }
    for (std::int32_t b = a + 1; b < std::int32_t(mesh.triangles.size()); ++b)
    {
      if (trianglesIntersect(mesh.points, mesh.triangles[a], mesh.triangles[b]))
      {
        result.push_back({ a, b });
      }
    }
  }
  return result;
}

/** Small triangles in a unit cube, on a coarse grid so that some touch and some are degenerate. */
Mesh randomTriangles(int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> place(0, 60), step(0, 6), point(0, 3 * count - 1), dice(0, 9);
  Mesh mesh;
  for (int t = 0; t < count; ++t)
  {
    const Eigen::Vector3d origin(place(random), place(random), place(random));
    Triangle triangle{ 3 * t, 3 * t + 1, 3 * t + 2 };
    for (int c = 0; c < 3; ++c)
    {
      mesh.points.push_back(0.1 * (origin + Eigen::Vector3d(step(random), step(random), step(random))));
    }
    if (dice(random) == 0)
    {
      triangle[0] = point(random);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::vector<TrianglePair> found(const Mesh& mesh)
{
  Execution serial;
  return selfIntersections(mesh, serial);
}

} // namespace

TEST(SelfIntersections, SoundMeshesHaveNone)
{
  EXPECT_TRUE(found(Mesh()).empty());
  EXPECT_TRUE(found(boxMesh(0, 1)).empty());
  EXPECT_TRUE(found(sphereMesh(4, 1.0)).empty());
  EXPECT_TRUE(found(torusMesh(60, 30, 3.0, 1.0)).empty());
}

TEST(SelfIntersections, EqualAllPairs)
{
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    const Mesh mesh = randomTriangles(800, seed);
    const std::vector<TrianglePair> pairs = found(mesh);
    EXPECT_EQ(pairs, allPairs(mesh));
    EXPECT_GT(pairs.size(), 50u);
  }
}

TEST(SelfIntersections, InterpenetratingAndTouchingTetrahedra)
{
  EXPECT_FALSE(found(joined(tetrahedron({ 0, 0, 0 }, 1), tetrahedron({ 0.2, 0.2, 0.2 }, 1))).empty());
  EXPECT_TRUE(found(joined(tetrahedron({ 0, 0, 0 }, 1), tetrahedron({ 2, 0, 0 }, 1))).empty());
  EXPECT_TRUE(found(joined(tetrahedron({ 0, 0, 0 }, 4), tetrahedron({ 0.5, 0.5, 0.5 }, 0.5))).empty())
    << "nested";
  // Corner (1, 0, 0) of the one is the origin of the other, and their edges lie on the x axis: a touch.
  const Mesh touching = joined(tetrahedron({ 0, 0, 0 }, 1), tetrahedron({ 1, 0, 0 }, 1));
  EXPECT_EQ(found(touching), allPairs(touching));
  EXPECT_EQ(found(touching).size(), 9u) << "three triangles of each meet in that corner";
}

TEST(SelfIntersections, CoplanarOverlap)
{
  Mesh mesh = boxMesh(0, 1);
  const Mesh other = boxMesh({ 0.25, 0.25, 1.0 }, { 0.75, 0.75, 2.0 }); // stands on the first one's top
  mesh = joined(mesh, other);
  EXPECT_EQ(found(mesh), allPairs(mesh));
  EXPECT_FALSE(found(mesh).empty());
}

TEST(SelfIntersections, DegenerateTrianglesMeetThemselves)
{
  Mesh mesh = boxMesh(0, 1);
  mesh.triangles.push_back({ 0, 0, 1 });
  EXPECT_EQ(found(mesh), (std::vector<TrianglePair>{ { 12, 12 } }));
}

TEST(SelfIntersections, AnyNumberOfThreads)
{
  const Mesh mesh = randomTriangles(6000, 9);
  ThreadedExecution threads(5);
  EXPECT_EQ(selfIntersections(mesh, threads), found(mesh));
}

TEST(SelfIntersections, PartOfAMesh)
{
  const Mesh mesh = randomTriangles(600, 5);
  std::vector<std::int32_t> subset{ 590, 3, 3 };
  std::vector<char> chosen(600, 0);
  for (std::int32_t t = 100; t < 400; t += 2)
  {
    subset.push_back(t);
  }
  for (const auto t : subset)
  {
    chosen[t] = 1;
  }
  std::vector<TrianglePair> among, with;
  for (const TrianglePair& pair : allPairs(mesh))
  {
    if (chosen[pair[0]] && chosen[pair[1]])
    {
      among.push_back(pair);
    }
    if (chosen[pair[0]] || chosen[pair[1]])
    {
      with.push_back(pair);
    }
  }
  ThreadedExecution threads(3);
  EXPECT_EQ(selfIntersectionsAmong(mesh, subset, threads), among);
  EXPECT_EQ(selfIntersectionsWith(mesh, subset, threads), with);
  EXPECT_FALSE(among.empty());
  EXPECT_GT(with.size(), among.size());
  EXPECT_THROW(selfIntersectionsAmong(mesh, { 1, 600 }, threads), InvalidInput);
  EXPECT_THROW(selfIntersectionsWith(mesh, { -1 }, threads), InvalidInput);
}

TEST(SelfIntersections, CancelAndProgress)
{
  const Mesh mesh = randomTriangles(600, 5);
  CancelledExecution cancelled;
  EXPECT_THROW(selfIntersections(mesh, cancelled), Cancelled);
  EXPECT_THROW(selfIntersectionsWith(mesh, { 1 }, cancelled), Cancelled);
  ProgressExecution progress;
  selfIntersections(mesh, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
  ProgressExecution part;
  selfIntersectionsWith(mesh, { 1, 2, 3 }, part);
  EXPECT_TRUE(part.Monotone);
  EXPECT_EQ(part.Last, 1.0);
}

/** Where each triangle's box meets all others' the work is their square: whoever wants to stop is asked after a small part of it. */
TEST(SelfIntersections, AskOftenWhetherToStopWhereAllBoxesOverlap)
{
  Mesh fan;
  constexpr int count = 4000;
  fan.points.emplace_back(0.0, 0.0, 1.0);
  for (int n = 0; n < count; ++n)
  {
    const double angle = 2.0 * 3.14159265358979 * n / count;
    fan.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    fan.triangles.push_back({ 0, 1 + n, 1 + (n + 1) % count });
  }
  StoppedAt never(1 << 30);
  EXPECT_TRUE(selfIntersections(fan, never).empty());
  EXPECT_GT(never.asked(), 10);
  StoppedAt early(5);
  EXPECT_THROW(selfIntersections(fan, early), Cancelled);
}
