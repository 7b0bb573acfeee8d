// SPDX-License-Identifier: BSD-3-Clause
#include "VotingMarchingCubes.h"

#include "CarvingTestCaptures.h"
#include "CornerShell.h"
#include "DistanceMap.h"
#include "LatticeSurface.h"
#include "SilhouetteComparison.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

VotingSurface surfaceOf(const PreparedViews& views, const Octree& octree, const VotingOptions& options = {})
{
  Execution execution;
  return votingMarchingCubes(octree, views, options, execution);
}

double volumeOf(const Mesh& mesh)
{
  Execution execution;
  return assessMesh(mesh, execution).volume;
}

/** Discs of radius `radius` in the given affine cameras: intersections of cylinders. */
std::vector<View> discs(double radius, double scale, int size, int count)
{
  std::vector<View> views;
  for (const auto& camera : axisCameras(scale, size))
  {
    View view{ "disc", camera, { size, size, {} } };
    for (int i = 0; i < size * size; ++i)
    {
      const double u = (i % size - 0.5 * (size - 1)) / scale, v = (i / size - 0.5 * (size - 1)) / scale;
      view.silhouette.pixels.push_back(std::hypot(u, v) < radius);
    }
    views.push_back(view);
  }
  views.resize(count);
  return views;
}

} // namespace

TEST(VotingMarchingCubes, VolumesOfTheTwoAndThreeCylinderSolidsInClosedForm)
{
  const double r = 0.9;
  for (const int count : { 2, 3 })
  {
    const double truth = (count == 2 ? 16.0 / 3.0 : 8.0 * (2.0 - std::sqrt(2.0))) * r * r * r;
    double error = 1.0;
    for (int depth = 4; depth <= 7; ++depth)
    {
      const PreparedViews views = prepareViews(discs(r, 500.0, 1200, count));
      const double now = std::abs(volumeOf(surfaceOf(views, carveViews(views, unitCube(1.01), depth)).mesh) / truth - 1);
      EXPECT_LT(now, error) << count << " cylinders, depth " << depth;
      error = now;
    }
    EXPECT_LT(error, 1e-3);
  }
}

TEST(VotingMarchingCubes, TheHullOfASphereHoldsItAndComesNearItWithMoreViews)
{
  const double truth = 4.0 / 3.0 * std::acos(-1.0) * std::pow(0.9, 3);
  double excess = 1.0;
  for (const int count : { 6, 12, 48 })
  {
    const PreparedViews views = prepareViews(viewsOf(sphereMesh(5, 0.9), swayingRing(count, 500), 500));
    const double now = volumeOf(surfaceOf(views, carveViews(views, unitCube(), 6)).mesh) / truth - 1.0;
    EXPECT_GT(now, -5e-3) << "chords of the surface and facets of the sphere cut off some thousandths";
    EXPECT_LT(now, excess);
    excess = now;
  }
  EXPECT_LT(excess, 0.02);
}

TEST(VotingMarchingCubes, ConsistentIsClosedAndManifoldAtEveryShareUnderEveryNoise)
{
  Execution execution;
  for (int kind = 0; kind <= 5; ++kind)
  {
    Random random(40 + kind);
    auto views = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 120), 120);
    disturb(views, kind, random);
    const PreparedViews prepared = prepareViews(views);
    for (int k = kind == 4 ? 3 : 0; k < 9; k += 2)
    {
      VotingOptions options;
      options.share = (10.0 - k) / 10.0;
      try
      {
        const Octree octree = carveViews(prepared, unitCube(), 5, k);
        for (const EdgePlacement edges : { k % 4 == 0 ? EdgePlacement::Middle : EdgePlacement::Exact, EdgePlacement::SubPixel })
        {
          options.edges = edges;
          const auto surface = surfaceOf(prepared, octree, options);
          const MeshSoundness s = assessMesh(surface.mesh, execution);
          EXPECT_EQ(s.openEdges, 0u) << "noise " << kind << " votes " << k;
          EXPECT_EQ(s.nonManifoldEdges + s.nonManifoldVertices + s.inconsistentEdges, 0u);
          EXPECT_GE(s.volume, 0.0);
        }
      }
      catch (const NothingSurvives&)
      {
        EXPECT_LE(k, 3);
      }
    }
  }
}

TEST(VotingMarchingCubes, FaithfulOpensWhereTheShareFalls)
{
  Execution execution;
  auto views = viewsOf(sphereMesh(4, 0.9), swayingRing(20, 160), 160);
  Random random(3);
  disturb(views, 2, random);
  const PreparedViews prepared = prepareViews(views);
  const Octree octree = carveViews(prepared, unitCube(), 6);
  std::uint64_t faces = ~std::uint64_t(0), lost = 0;
  for (const double share : { 1.0, 0.9, 0.8, 0.7 })
  {
    VotingOptions options;
    options.share = share;
    options.mode = VotingMode::Faithful;
    options.edges = EdgePlacement::Middle;
    const auto surface = surfaceOf(prepared, octree, options);
    const MeshSoundness s = assessMesh(surface.mesh, execution);
    EXPECT_EQ(s.openEdges == 0, share == 1.0);
    EXPECT_LT(s.triangles, faces);
    EXPECT_GE(surface.lostNoCorner + surface.lostAllCorners, lost);
    EXPECT_EQ(surface.intersectionOctants, octree.count(OctantState::Intersection, 6));
    faces = s.triangles;
    lost = surface.lostNoCorner + surface.lostAllCorners;
  }
}

TEST(VotingMarchingCubes, SubPixelPlacesAreNearerToACircleThanItsPixels)
{
  const double r = 0.9, scale = 50.0;
  for (const int count : { 2, 3 })
  {
    const std::vector<View> cylinders = discs(r, scale, 121, count);
    const PreparedViews views = prepareViews(cylinders);
    const Octree octree = carveViews(views, unitCube(1.01), 5);
    double errors[2], means[2];
    for (const int n : { 0, 1 })
    {
      VotingOptions options;
      options.edges = n == 0 ? EdgePlacement::Exact : EdgePlacement::SubPixel;
      const Mesh mesh = surfaceOf(views, octree, options).mesh;
      double sum = 0.0, squares = 0.0;
      for (const auto& p : mesh.points)
      {
        double radius = 0.0; // of the cylinder that the point is farthest out in
        for (const View& view : cylinders)
        {
          const Vector3 h = view.projection * p.homogeneous();
          radius = std::max(radius, std::hypot(h[0] / h[2] - 60.0, h[1] / h[2] - 60.0));
        }
        sum += radius - r * scale;
        squares += (radius - r * scale) * (radius - r * scale);
      }
      means[n] = sum / double(mesh.points.size());
      errors[n] = std::sqrt(squares / double(mesh.points.size()));
    }
    EXPECT_LT(errors[1], 0.75 * errors[0]) << count << " views: px, root of the mean square";
    EXPECT_LT(std::abs(means[1]), std::abs(means[0]));
  }
}

namespace
{

/** The surface of a field on all of the lattice: the least distance of all views, contoured as a dense volume is. */
Mesh denseSurface(const std::vector<View>& views, const Lattice& lattice)
{
  Execution execution;
  std::vector<DistanceMap> maps;
  for (const View& view : views)
  {
    maps.push_back(distanceMap(view.silhouette.pixels.data(), view.silhouette.width, view.silhouette.height, 10.0));
  }
  std::vector<std::uint64_t> cells(std::size_t(1) << 3 * lattice.depth);
  std::iota(cells.begin(), cells.end(), std::uint64_t(0));
  const CornerShell shell = makeCornerShell(cells, execution);
  std::vector<float> least(shell.corners.size(), 10.0f);
  std::vector<std::uint8_t> inside;
  for (std::size_t c = 0; c < least.size(); ++c)
  {
    for (std::size_t view = 0; view < views.size(); ++view)
    {
      const Vector3 h = views[view].projection * lattice.position(fromMorton(shell.corners[c])).homogeneous();
      least[c] = std::min(least[c], maps[view].at(h[0] / h[2], h[1] / h[2]));
    }
    inside.push_back(least[c] > 0.0f);
  }
  const LatticeSurface surface = contour(shell, inside, execution);
  Mesh mesh;
  mesh.triangles = surface.triangles;
  for (const CrossedEdge& edge : surface.edges)
  {
    const double from = least[edge.inside], to = least[edge.outside];
    mesh.points.push_back(crossingPosition(lattice, shell, edge, from / (from - to)));
  }
  return mesh;
}

double xorShare(const Mesh& mesh, const std::vector<View>& views)
{
  Execution execution;
  return totalAgreement(compareSilhouettes(mesh, views, execution)).xorShare;
}

} // namespace

/** Octants of two pixels and a half and of one and a quarter: the smaller, the more is due to labels by distances. */
TEST(VotingMarchingCubes, SubPixelEdgesMissLessOfTheSilhouettesThanADenseFieldAndLabelsByVotes)
{
  for (const int depth : { 5, 6 })
  {
    const std::vector<View> views = viewsOf(torusMesh(96, 48, 0.7, 0.3), swayingRing(16, 84), 84);
    const PreparedViews prepared = prepareViews(views);
    const Octree octree = carveViews(prepared, unitCube(), depth);
    VotingOptions options;
    const double exact = xorShare(surfaceOf(prepared, octree, options).mesh, views);
    options.edges = EdgePlacement::SubPixel;
    const double subPixel = xorShare(surfaceOf(prepared, octree, options).mesh, views);
    options.mode = VotingMode::Faithful; // labels are those of the nearest pixels
    const double byVotes = xorShare(surfaceOf(prepared, octree, options).mesh, views);
    const double dense = xorShare(denseSurface(views, octree.lattice), views);
    EXPECT_LT(subPixel, dense) << depth;
    EXPECT_LT(subPixel, byVotes) << depth;
    EXPECT_LT(byVotes, exact) << depth;
  }
}

/** As of an octree that was read from a file. */
TEST(VotingMarchingCubes, WithoutTheCarvingsViewsTheBytesAreTheSame)
{
  const PreparedViews prepared = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 120), 120));
  for (const int k : { 0, 2 })
  {
    VotingOptions options;
    options.share = 1.0 - k / 10.0;
    options.edges = EdgePlacement::SubPixel;
    Octree octree = carveViews(prepared, unitCube(), 6, k);
    const auto known = surfaceOf(prepared, octree, options);
    octree.undecided = UndecidedViews();
    const auto unknown = surfaceOf(prepared, octree, options);
    EXPECT_EQ(known.mesh.points, unknown.mesh.points);
    EXPECT_EQ(known.mesh.triangles, unknown.mesh.triangles);
    EXPECT_EQ(known.insideVotes, unknown.insideVotes);
  }
}

TEST(VotingMarchingCubes, TreesSurfacedApartAddUpToTheWhole)
{
  for (const EdgePlacement placement : { EdgePlacement::Exact, EdgePlacement::SubPixel })
  {
    VotingOptions voting;
    voting.edges = placement;
    const PreparedViews prepared = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 120), 120));
    const LatticeViews latticeViews(prepared, { unitCube(), 5 });
    Execution execution;
    const auto whole = surfaceOf(prepared, carve(latticeViews, CarveOptions(), execution), voting);
    std::vector<std::array<std::array<double, 3>, 3>> expected, found;
    const auto append = [](const Mesh& mesh, auto& triangles)
    {
      for (const auto& t : mesh.triangles)
      {
        std::array<std::array<double, 3>, 3> corners;
        for (int c = 0; c < 3; ++c)
        {
          corners[c] = { mesh.points[t[c]].x(), mesh.points[t[c]].y(), mesh.points[t[c]].z() };
        }
        triangles.push_back(corners);
      }
    };
    append(whole.mesh, expected);
    for (std::uint64_t part = 0; part < 8; ++part)
    {
      CarveOptions options;
      for (std::uint64_t tree = part * 64; tree < (part + 1) * 64; ++tree)
      {
        options.trees.push_back(tree);
      }
      append(surfaceOf(prepared, carve(latticeViews, options, execution), voting).mesh, found);
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(expected, found);
  }
}

TEST(VotingMarchingCubes, SameBytesForAnyNumberOfThreads)
{
  const PreparedViews prepared = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 120), 120));
  const Octree octree = carveViews(prepared, unitCube(), 6);
  for (const int n : { 2, 8, -2, -8 })
  {
    VotingOptions options;
    options.edges = n > 0 ? EdgePlacement::Exact : EdgePlacement::SubPixel;
    const auto one = surfaceOf(prepared, octree, options);
    ThreadedExecution execution(std::abs(n));
    const auto many = votingMarchingCubes(octree, prepared, options, execution);
    EXPECT_EQ(one.mesh.points, many.mesh.points);
    EXPECT_EQ(one.mesh.triangles, many.mesh.triangles);
    EXPECT_EQ(one.insideVotes, many.insideVotes);
  }
}

TEST(VotingMarchingCubes, ShareAndVotesAndViewsHaveToFit)
{
  EXPECT_EQ(requiredInsideVotes(1.0, 36), 36);
  EXPECT_EQ(requiredInsideVotes(0.9, 10), 9);
  EXPECT_EQ(requiredInsideVotes(0.91, 10), 10);
  EXPECT_EQ(requiredInsideVotes(1e-9, 10), 1);
  EXPECT_THROW(requiredInsideVotes(0.0, 10), InvalidInput);
  EXPECT_THROW(requiredInsideVotes(1.01, 10), InvalidInput);
  EXPECT_THROW(requiredInsideVotes(std::nan(""), 10), InvalidInput);
  const PreparedViews prepared = prepareViews(viewsOf(sphereMesh(3, 0.9), swayingRing(10, 96), 96));
  const Octree octree = carveViews(prepared, unitCube(), 4);
  VotingOptions options;
  options.share = 0.8;
  try
  {
    surfaceOf(prepared, octree, options);
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("allows 0 background votes"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("needs exactly 2"), std::string::npos);
  }
  const PreparedViews others = prepareViews(viewsOf(sphereMesh(3, 0.8), swayingRing(10, 96), 96));
  EXPECT_THROW(surfaceOf(others, octree), InvalidInput);
  CancelledExecution cancelled;
  EXPECT_THROW(votingMarchingCubes(octree, prepared, VotingOptions(), cancelled), Cancelled);
}

TEST(VotingMarchingCubes, AnObjectCutByTheCubeStaysClosed)
{
  Execution execution;
  const PreparedViews prepared = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 120), 120));
  const auto surface = surfaceOf(prepared, carveViews(prepared, { Vector3(-0.3, 0.2, -0.3), 0.6 }, 5));
  EXPECT_TRUE(assessMesh(surface.mesh, execution).sound());
}
