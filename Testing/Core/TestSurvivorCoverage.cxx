// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorCoverage.h"

#include "Error.h"
#include "EvaluationTestMeshes.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <random>

using namespace silhouette;
using namespace silhouette::test;
using Rational = boost::multiprecision::cpp_rational;

namespace
{

using Point = Eigen::Vector3d;

/** A lattice of which every octant of the last generation survives; its cells have the given edge. */
Octree fullOctree(int depth, const Point& origin, double leafEdge)
{
  Octree octree;
  octree.lattice.root.origin = origin;
  octree.lattice.root.edge = std::ldexp(leafEdge, depth);
  octree.lattice.depth = depth;
  octree.generations.resize(depth + 1);
  Generation& last = octree.generations.back();
  for (std::uint64_t code = 0; code < std::uint64_t(1) << 3 * depth; ++code)
  {
    last.code.push_back(code);
    last.state.push_back(code % 2 == 0 ? OctantState::Intersection : OctantState::Inside);
  }
  return octree;
}

Point centreOf(const Octree& octree, std::size_t o)
{
  const LatticePoint p = fromMorton(octree.last().code[o]);
  const Lattice& lattice = octree.lattice;
  return { lattice.coordinate(0, p.i + 0.5), lattice.coordinate(1, p.j + 0.5),
    lattice.coordinate(2, p.k + 0.5) };
}

std::vector<Coverage> covered(const Octree& octree, const Mesh& mesh)
{
  Execution serial;
  return survivorCoverage(octree, mesh, serial);
}

std::uint64_t lost(const Octree& octree, const Mesh& mesh)
{
  Execution serial;
  return lostSurvivors(octree, mesh, serial);
}

/**
 * What the triangle and the closed cube have in common, exactly, by clipping; it reaches the open cube iff on
 * no axis it lies wholly in one face.
 */
bool meetsOpenCube(const std::array<Point, 3>& triangle, const Point& low, const Point& high)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [least, greatest] = std::minmax({ triangle[0][axis], triangle[1][axis], triangle[2][axis] });
    if (greatest <= low[axis] || least >= high[axis])
    {
      return false;
    }
  }
  using Exact = std::array<Rational, 3>;
  std::vector<Exact> polygon;
  for (const Point& p : triangle)
  {
    polygon.push_back({ Rational(p[0]), Rational(p[1]), Rational(p[2]) });
  }
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const int sign = side % 2 == 0 ? 1 : -1;
    const Rational plane(side % 2 == 0 ? low[axis] : high[axis]);
    std::vector<Exact> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Exact &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const Rational dp = sign * (p[axis] - plane), dq = sign * (q[axis] - plane);
      if (dp >= 0)
      {
        kept.push_back(p);
      }
      if (dp * dq < 0)
      {
        const Rational t = dp / (dp - dq);
        kept.push_back({ p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2]) });
      }
    }
    polygon = kept;
  }
  for (int side = 0; side < 6; ++side)
  {
    const Rational plane(side % 2 == 0 ? low[side / 2] : high[side / 2]);
    if (std::all_of(polygon.begin(), polygon.end(), [&](const Exact& p) { return p[side / 2] == plane; }))
    {
      return false; // also where nothing is left
    }
  }
  return true;
}

/** How often the mesh winds around the point: the sum of the solid angles. */
double windingNumber(const Mesh& mesh, const Point& x)
{
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    const Point a = mesh.points[t[0]] - x, b = mesh.points[t[1]] - x, c = mesh.points[t[2]] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 *
      std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * std::acos(-1.0));
}

Coverage coverageByBruteForce(const Octree& octree, const Mesh& mesh, std::size_t o)
{
  const LatticePoint p = fromMorton(octree.last().code[o]);
  const Point low = octree.lattice.position(p), high = octree.lattice.position(p + LatticePoint{ 1, 1, 1 });
  for (const Triangle& t : mesh.triangles)
  {
    if (meetsOpenCube({ mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]] }, low, high))
    {
      return Coverage::Crossed;
    }
  }
  return windingNumber(mesh, centreOf(octree, o)) > 0.5 ? Coverage::Enclosed : Coverage::Lost;
}

void compareWithBruteForce(const Octree& octree, const Mesh& mesh)
{
  const std::vector<Coverage> coverage = covered(octree, mesh);
  for (std::size_t o = 0; o < coverage.size(); ++o)
  {
    ASSERT_EQ(int(coverage[o]), int(coverageByBruteForce(octree, mesh, o))) << "octant " << o;
  }
}

/** A triangle with corners on a grid of half cells, where touching and lying in faces is frequent. */
std::array<Point, 3> gridTriangle(std::mt19937& random, int span)
{
  std::uniform_int_distribution<int> place(-1, 9), step(-span, span);
  const Point origin(place(random), place(random), place(random));
  std::array<Point, 3> t;
  for (Point& p : t)
  {
    p = 0.5 * (origin + Point(step(random), step(random), step(random)));
  }
  return t;
}

} // namespace

TEST(SurvivorCoverage, OpenCubeAndTriangleEqualClipping)
{
  std::mt19937 random(1);
  const Octree octree = fullOctree(2, Point::Zero(), 1.0);
  int met = 0;
  int touched = 0;
  for (int n = 0; n < 12000; ++n)
  {
    const auto t = gridTriangle(random, 1 + n % 6);
    std::uniform_int_distribution<int> cell(0, 3);
    const LatticePoint low{ cell(random), cell(random), cell(random) };
    const LatticePoint high = low + LatticePoint{ 1, 1, 1 };
    const Point lowest = octree.lattice.position(low), highest = octree.lattice.position(high);
    const bool expected = meetsOpenCube(t, lowest, highest);
    ASSERT_EQ(triangleMeetsOpenCells(octree.lattice, low, high, t[0], t[1], t[2]), expected) << n;
    met += expected;
    const Point hair = Point::Constant(1e-3);
    touched += !expected && meetsOpenCube(t, lowest - hair, highest + hair);
  }
  EXPECT_GT(met, 200);
  EXPECT_GT(touched, 50);
}

TEST(SurvivorCoverage, CrossedCellsEqualClippingForAnyTriangle)
{
  std::mt19937 random(2);
  const Octree octree = fullOctree(2, Point::Zero(), 1.0);
  for (int n = 0; n < 150; ++n)
  {
    const auto t = gridTriangle(random, 1 + n % 8);
    Mesh mesh;
    mesh.points.assign(t.begin(), t.end());
    mesh.triangles = { { 0, 1, 2 } };
    const std::vector<Coverage> coverage = covered(octree, mesh);
    for (std::size_t o = 0; o < coverage.size(); ++o)
    {
      const LatticePoint p = fromMorton(o);
      const bool expected =
        meetsOpenCube(t, octree.lattice.position(p), octree.lattice.position(p + LatticePoint{ 1, 1, 1 }));
      ASSERT_EQ(coverage[o] == Coverage::Crossed, expected) << n << " octant " << o;
    }
  }
}

TEST(SurvivorCoverage, SolidsEqualBruteForce)
{
  const Octree octree = fullOctree(3, Point(-1.3, -1.2, -1.1), 0.3);
  compareWithBruteForce(octree, sphereMesh(2, 1.0));
  compareWithBruteForce(octree, torusMesh(12, 8, 0.8, 0.3));
  compareWithBruteForce(octree, tetrahedron({ -0.9, -0.8, -0.7 }, 1.9));
  compareWithBruteForce(
    octree, joined(tetrahedron({ -1.2, -1.1, -1 }, 0.9), tetrahedron({ 0.2, -1, -1 }, 1.2)));
}

TEST(SurvivorCoverage, RaysThroughEdgesAndPoints)
{
  // The sphere's points lie on rows of centres, and so do its edges: the lattice has a centre at the origin.
  Octree octree = fullOctree(3, Point::Constant(-1.125), 0.25);
  compareWithBruteForce(octree, boxMesh(-0.75, 0.75));
  Mesh octahedron;
  octahedron.points = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } };
  octahedron.triangles = { { 0, 1, 2 }, { 1, 3, 2 }, { 3, 4, 2 }, { 4, 0, 2 }, { 1, 0, 5 }, { 3, 1, 5 },
    { 4, 3, 5 }, { 0, 4, 5 } };
  compareWithBruteForce(octree, octahedron);
}

TEST(SurvivorCoverage, AFaceOfTheLatticeIsNotCrossed)
{
  // The solid's faces lie in lattice planes: its own cells are enclosed, no cell is crossed, the rest
  // are lost.
  const Octree octree = fullOctree(3, Point(0.1, 0.2, 0.3), 0.1);
  const Lattice& lattice = octree.lattice;
  const Mesh box = boxMesh(lattice.position({ 2, 1, 3 }), lattice.position({ 5, 6, 7 }));
  const std::vector<Coverage> coverage = covered(octree, box);
  EXPECT_EQ(std::count(coverage.begin(), coverage.end(), Coverage::Crossed), 0);
  EXPECT_EQ(std::count(coverage.begin(), coverage.end(), Coverage::Enclosed), 3 * 5 * 4);
  EXPECT_EQ(lost(octree, box), 512u - 60u);
  // Grown by a hair it crosses the cells around it.
  Mesh grown = box;
  for (Point& p : grown.points)
  {
    p += 1e-12 * (p - lattice.position({ 4, 4, 5 })) / 0.1;
  }
  EXPECT_EQ(lost(octree, grown), 512u - 5u * 7u * 6u);
}

TEST(SurvivorCoverage, CountsSurvivorsAlone)
{
  Octree octree = fullOctree(3, Point::Zero(), 1.0);
  EXPECT_EQ(lost(octree, boxMesh(-1, 9)), 0u);
  EXPECT_EQ(lost(octree, Mesh()), 512u);
  for (std::size_t o = 100; o < 512; ++o)
  {
    octree.generations.back().state[o] = OctantState::Background;
  }
  EXPECT_EQ(lost(octree, Mesh()), 100u);
  EXPECT_EQ(lost(octree, boxMesh(-1, 9)), 0u);
  // An octree of which some trees only were carved.
  octree.generations.back().code.erase(
    octree.generations.back().code.begin(), octree.generations.back().code.begin() + 64);
  octree.generations.back().state.erase(
    octree.generations.back().state.begin(), octree.generations.back().state.begin() + 64);
  EXPECT_EQ(lost(octree, Mesh()), 36u);
  EXPECT_EQ(lost(octree, boxMesh(-1, 9)), 0u);
}

TEST(SurvivorCoverage, AnOpenMeshIsJudgedByItsRay)
{
  const Octree octree = fullOctree(3, Point::Zero(), 1.0);
  Mesh mesh = boxMesh(-1, 9);
  mesh.triangles.resize(10); // without the face of greatest x, which the rays go through
  EXPECT_EQ(lost(octree, mesh), 512u);
  mesh = boxMesh(-1, 9);
  mesh.triangles.erase(mesh.triangles.begin() + 8, mesh.triangles.begin() + 10); // without the opposite one
  EXPECT_EQ(lost(octree, mesh), 0u);
}

TEST(SurvivorCoverage, AnyNumberOfThreads)
{
  const Octree octree = fullOctree(4, Point::Constant(-1.21), 0.15);
  const Mesh mesh = sphereMesh(4, 1.0);
  ThreadedExecution threads(5);
  EXPECT_EQ(survivorCoverage(octree, mesh, threads), covered(octree, mesh));
}

TEST(SurvivorCoverage, RejectsAndCancels)
{
  Octree octree = fullOctree(2, Point::Zero(), 1.0);
  CancelledExecution cancelled;
  EXPECT_THROW(lostSurvivors(octree, boxMesh(0, 1), cancelled), Cancelled);
  ProgressExecution progress;
  lostSurvivors(octree, boxMesh(0, 1), progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
  octree.generations.clear();
  EXPECT_THROW(lost(octree, boxMesh(0, 1)), InvalidInput);
}
