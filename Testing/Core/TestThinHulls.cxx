// SPDX-License-Identifier: BSD-3-Clause
#include "ThinHullFitting.h"

#include "CarvingTestCaptures.h"
#include "CellSafety.h"
#include "EdgeCrossing.h"
#include "LatticeRegions.h"
#include "MeshDistance.h"
#include "RobustLabels.h"
#include "SurvivorCovering.h"
#include "SurvivorCoverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Everything up to the covered surface, and the thin hulls on it. */
struct Covered
{
  Covered(PreparedViews given, const RootCube& cube, int depth, int k)
    : prepared(std::move(given))
    , views(prepared, { cube, depth })
    , octree(carveViews(prepared, cube, depth, k))
    , labels(octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), prepared, execution)
  {
    for (std::uint32_t c = 0; c < this->labels.shell().cells.size(); ++c)
    {
      const auto& corners = this->labels.shell().cellCorners[c];
      if (this->labels.isSurvivor(c) && std::none_of(corners.begin(), corners.end(),
            [&](std::uint32_t corner) { return this->labels.inside()[corner] != 0; }))
      {
        this->cells.push_back(c);
      }
    }
    for (const std::uint32_t corner : coverSurvivors(this->labels, {}, 0).coveringCorners)
    {
      this->added.push_back(this->labels.shell().corners[corner]);
    }
    std::sort(this->added.begin(), this->added.end());
    this->shell = extendedShell(this->labels.shell(), this->added, this->execution);
    std::vector<std::uint8_t> inside;
    for (const std::uint64_t corner : this->shell.corners)
    {
      inside.push_back(this->labels.insideAt(fromMorton(corner)));
    }
    this->surface = contour(this->shell, inside, this->execution);
  }

  Mesh place(bool singlePrecision)
  {
    std::vector<double> fractions;
    for (const CrossedEdge& edge : this->surface.edges)
    {
      const std::uint64_t a = this->shell.corners[edge.inside], b = this->shell.corners[edge.outside];
      const bool covering = std::binary_search(this->added.begin(), this->added.end(), a);
      const double t = exactCrossing(this->views, fromMorton(a), fromMorton(b), this->octree.backgroundVotes);
      fractions.push_back(covering ? 0.03 : std::clamp(t, CrossingMargin, 1.0 - CrossingMargin));
    }
    Mesh mesh = placePoints(this->octree.lattice, this->shell, this->surface, fractions, singlePrecision);
    removeCellIntersections(
      this->octree.lattice, this->shell, this->surface, singlePrecision, mesh, this->execution);
    return mesh;
  }

  Execution execution;
  PreparedViews prepared;
  LatticeViews views;
  Octree octree;
  LatticeLabels labels;
  std::vector<std::uint32_t> cells;
  std::vector<std::uint64_t> added;
  CornerShell shell;
  LatticeSurface surface;
};

struct Moved
{
  std::vector<ThinHull> hulls;
  Mesh mesh;
  std::uint64_t points = 0;
};

Moved move(Covered& covered, const ThinHullOptions& options, Execution& execution, bool singlePrecision = false,
  bool withDepth = true)
{
  Moved moved;
  const SilhouetteDepth depth(covered.views, covered.octree.backgroundVotes, 1.0, execution);
  moved.hulls = thinHulls(covered.labels, covered.cells, depth, options, execution);
  moved.mesh = covered.place(singlePrecision);
  const ThinSurface thin{ covered.labels, covered.labels.octree(), covered.added, covered.shell, covered.surface, singlePrecision };
  moved.points =
    moveToThinHulls(moved.hulls, thin, withDepth ? &depth : nullptr, options, moved.mesh, execution);
  return moved;
}

/** A straight tube of half an octant's radius or so, across the lattice's directions. */
Mesh tube(double radius)
{
  Mesh mesh = sphereMesh(4, 1.0);
  const Vector3 along = Vector3(0.5, 0.3, 0.8).normalized();
  for (Vector3& p : mesh.points)
  {
    const double t = p.dot(along);
    p = radius * p + 0.7 * (t > 0.0 ? 1.0 : (t < 0.0 ? -1.0 : 0.0)) * along;
  }
  return mesh;
}

PreparedViews look(const Mesh& mesh, int kind, std::uint64_t seed, int count, int size)
{
  Random random(seed);
  auto captured = viewsOf(mesh, swayingRing(count, size), size);
  disturb(captured, kind, random);
  return prepareViews(captured);
}

void expectSound(const Mesh& mesh, const Octree& octree, const std::string& what)
{
  Execution execution;
  const MeshSoundness s = assessMesh(mesh, execution);
  EXPECT_TRUE(s.sound()) << what << ": " << s.selfIntersections << " self-intersections";
  EXPECT_EQ(lostSurvivors(octree, mesh, execution), 0u) << what;
}

} // namespace

TEST(ThinHulls, ABallsDistanceIsThatOfTheNearestBetweenTheTwo)
{
  Random random(1);
  const auto anywhere = [&] { return Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
  for (int run = 0; run < 300; ++run)
  {
    ThinHull hull{ { anywhere(), anywhere() }, { random.uniform(0.1, 1.5), random.uniform(0.1, 0.5) } };
    if (run % 10 == 0)
    {
      hull.centre[1] = hull.centre[0];
      hull.radius[1] = hull.radius[0];
    }
    const Vector3 p = 2.0 * anywhere();
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n <= 2000; ++n)
    {
      const double t = n / 2000.0;
      const Vector3 centre = (1 - t) * hull.centre[0] + t * hull.centre[1];
      least = std::min(least, (p - centre).norm() - ((1 - t) * hull.radius[0] + t * hull.radius[1]));
    }
    EXPECT_NEAR(nearestBall(hull, p).distance, least, 1e-3);
    EXPECT_LE(nearestBall(hull, p).distance, least + 1e-12);
  }
}

TEST(ThinHulls, DepthIsTheDistanceFromASpheresSurface)
{
  Execution execution;
  const PreparedViews prepared = look(sphereMesh(5, 0.9), 0, 0, 40, 400);
  const LatticeViews views(prepared, { unitCube(), 6 });
  const double edge = views.lattice().leafEdge();
  const SilhouetteDepth depth(views, 0, 2.0, execution), tolerant(views, 3, 2.0, execution);
  Random random(2);
  for (int run = 0; run < 200; ++run)
  {
    const Vector3 way = Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const double d = random.uniform(-1.0, 1.9);
    const Vector3 p = ((0.9 - d * edge) * way - views.lattice().root.origin) / edge;
    const double found = depth(p);
    // Outside, views that do not see the point on their contour call it less far away than it is.
    EXPECT_GE(found, d - 0.15);
    EXPECT_LE(found, (d > 0.0 ? d : 0.0) + 0.35);
    EXPECT_GE(tolerant(p), found);
    EXPECT_LE(depth(p, found), found);
  }
  EXPECT_THROW(SilhouetteDepth(views, 40, 2.0, execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, 0, 0.0, execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, 0, 1.0, execution, { Vector2::Zero() }), InvalidInput);
}

TEST(ThinHulls, AThinTubeBecomesRound)
{
  Execution execution;
  const Mesh truth = tube(0.014); // an octant is 0.041 wide
  Covered covered(look(truth, 0, 0, 16, 400), unitCube(), 6, 0);
  ASSERT_GT(covered.cells.size(), 30u);
  const double leaf = covered.octree.lattice.leafEdge();
  const Mesh before = covered.place(false);
  const Moved moved = move(covered, {}, execution);
  const auto was = compareMeshes(before, truth, leaf / 2, execution);
  const auto is = compareMeshes(moved.mesh, truth, leaf / 2, execution);
  EXPECT_LT(is.truthToMesh.mean, 0.12 * leaf);
  EXPECT_LT(is.meshToTruth.mean, 0.15 * leaf);
  EXPECT_LT(is.mean, 0.7 * was.mean);
  EXPECT_NEAR(assessMesh(moved.mesh, execution).volume / assessMesh(truth, execution).volume, 1.0, 0.6);
  expectSound(moved.mesh, covered.octree, "tube");
}

TEST(ThinHulls, StaySoundAndLoseNothingUnderNoise)
{
  int runs = 0;
  std::uint64_t points = 0;
  for (int kind = 0; kind <= 5; ++kind)
  {
    for (const std::uint64_t seed : { 1, 2, 3 })
    {
      const Mesh shape = seed == 1 ? tube(0.03) : (seed == 2 ? torusMesh(64, 12, 0.8, 0.02) : torusMesh(48, 24, 0.7, 0.3));
      try
      {
        Covered covered(look(shape, kind, seed, 9, 70), unitCube(), 4, kind == 0 ? 0 : 2);
        ThreadedExecution execution(2);
        const std::string what = "noise " + std::to_string(kind) + " seed " + std::to_string(seed);
        const Moved moved = move(covered, {}, execution, seed == 2, seed != 1 || kind % 2 == 0);
        expectSound(moved.mesh, covered.octree, what);
        points += moved.points;
        for (const auto& p : moved.mesh.points)
        {
          EXPECT_TRUE(seed != 2 || (p[0] == double(float(p[0])) && p[1] == double(float(p[1])))) << what;
        }
        ++runs;
      }
      catch (const NothingSurvives&)
      {
        EXPECT_GT(kind, 0);
      }
    }
  }
  EXPECT_GE(runs, 12);
  EXPECT_GT(points, 1000u);
}

TEST(ThinHulls, OtherHullsMakeAnotherSurfaceAndWithoutReachNothingMoves)
{
  Execution execution;
  Covered covered(look(tube(0.014), 0, 0, 12, 300), unitCube(), 6, 0);
  const Mesh before = covered.place(false);
  ThinHullOptions options;
  const Moved usual = move(covered, options, execution, false, false);
  options.smallestRadius = 0.45;
  const Moved fat = move(covered, options, execution, false, false);
  EXPECT_GT(assessMesh(fat.mesh, execution).volume, 1.1 * assessMesh(usual.mesh, execution).volume);
  options.reach = 0.0;
  const Moved still = move(covered, options, execution);
  EXPECT_EQ(still.points, 0u);
  EXPECT_EQ(still.mesh.points, before.points);
  EXPECT_EQ(still.mesh.triangles, before.triangles);
  EXPECT_GT(usual.points, 100u);
  for (std::size_t p = 0; p < before.points.size(); ++p)
  {
    EXPECT_LE((usual.mesh.points[p] - before.points[p]).norm(), 0.9001 * covered.octree.lattice.leafEdge());
  }
  Mesh mesh = before;
  const ThinSurface thin{ covered.labels, covered.labels.octree(), covered.added, covered.shell, covered.surface, false };
  EXPECT_EQ(moveToThinHulls({}, thin, nullptr, {}, mesh, execution), 0u);
}

TEST(ThinHulls, SameBytesForAnyNumberOfThreads)
{
  Execution serial;
  Covered covered(look(tube(0.02), 2, 5, 12, 200), unitCube(), 5, 3);
  const Moved one = move(covered, {}, serial);
  EXPECT_GT(one.points, 0u);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const Moved many = move(covered, {}, execution);
    EXPECT_EQ(one.mesh.points, many.mesh.points);
    EXPECT_EQ(one.points, many.points);
    ASSERT_EQ(one.hulls.size(), many.hulls.size());
    for (std::size_t h = 0; h < one.hulls.size(); ++h)
    {
      EXPECT_EQ(one.hulls[h].centre[1], many.hulls[h].centre[1]);
      EXPECT_EQ(one.hulls[h].radius[1], many.hulls[h].radius[1]);
    }
  }
}

TEST(ThinHulls, OptionsOutOfRangeAreErrorsAndItCanBeCancelled)
{
  Execution execution;
  Covered covered(look(tube(0.02), 0, 5, 8, 150), unitCube(), 5, 0);
  for (const ThinHullOptions& wrong : { ThinHullOptions{ 0.0, 0.5, 0.9 }, ThinHullOptions{ 0.3, 0.2, 0.9 },
         ThinHullOptions{ 0.1, 1.5, 0.9 }, ThinHullOptions{ 0.1, 0.5, -0.1 }, ThinHullOptions{ 0.1, 0.5, 1.1 },
         ThinHullOptions{ 0.1, std::numeric_limits<double>::quiet_NaN(), 0.5 } })
  {
    EXPECT_THROW(move(covered, wrong, execution), InvalidInput);
  }
  const SilhouetteDepth depth(covered.views, 0, 1.0, execution);
  const auto hulls = thinHulls(covered.labels, covered.cells, depth, {}, execution);
  const ThinSurface thin{ covered.labels, covered.labels.octree(), covered.added, covered.shell, covered.surface, false };
  Mesh mesh = covered.place(false);
  CancelledExecution cancelled;
  EXPECT_THROW(SilhouetteDepth(covered.views, 0, 1.0, cancelled), Cancelled);
  EXPECT_THROW(thinHulls(covered.labels, covered.cells, depth, {}, cancelled), Cancelled);
  EXPECT_THROW(moveToThinHulls(hulls, thin, &depth, {}, mesh, cancelled), Cancelled);
  ProgressExecution progress;
  moveToThinHulls(hulls, thin, &depth, {}, mesh, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}
