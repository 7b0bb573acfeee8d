// SPDX-License-Identifier: BSD-3-Clause
#include "ThinHullFitting.h"

#include "MeshDistance.h"
#include "ThinHullScene.h"

using namespace silhouette;
using namespace silhouette::test;

TEST(ThinHullFitting, AThinTubeBecomesRound)
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
  EXPECT_LT(is.mean, 0.67 * was.mean);
  // Points on the tube and chords between them: four points around a circle hold 0.64 of it, and the lattice's
  // staircase takes some more. Neither larger balls nor a longer reach hold more.
  const double share = assessMesh(moved.mesh, execution).volume / assessMesh(truth, execution).volume;
  EXPECT_GT(share, 0.45);
  EXPECT_LT(share, 0.75);
  EXPECT_GT(share, 1.5 * assessMesh(before, execution).volume / assessMesh(truth, execution).volume);
  expectSound(moved.mesh, covered.octree, "tube");
}

TEST(ThinHullFitting, StaySoundAndLoseNothingUnderNoise)
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

TEST(ThinHullFitting, OtherHullsMakeAnotherSurfaceAndWithoutReachNothingMoves)
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

TEST(ThinHullFitting, SameBytesForAnyNumberOfThreads)
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
  }
}

TEST(ThinHullFitting, OptionsOutOfRangeAreErrorsAndItCanBeCancelledAtAnyTime)
{
  Execution execution;
  Covered covered(look(tube(0.02), 0, 5, 8, 150), unitCube(), 5, 0);
  const SilhouetteDepth depth(covered.views, 0, 1.0, execution);
  const auto hulls = thinHulls(covered.labels, covered.cells, depth, {}, execution);
  const ThinSurface thin{ covered.labels, covered.labels.octree(), covered.added, covered.shell, covered.surface, false };
  Mesh mesh = covered.place(false);
  EXPECT_THROW(moveToThinHulls(hulls, thin, &depth, { 0.1, 0.5, 1.1 }, mesh, execution), InvalidInput);
  StoppedAt never(1 << 30);
  Mesh moved = mesh;
  moveToThinHulls(hulls, thin, &depth, {}, moved, never);
  EXPECT_GE(never.asked(), 24);
  for (int last = 0; last < never.asked(); ++last)
  {
    StoppedAt stopped(last);
    moved = mesh;
    EXPECT_THROW(moveToThinHulls(hulls, thin, &depth, {}, moved, stopped), Cancelled) << last;
  }
  ProgressExecution progress;
  moveToThinHulls(hulls, thin, &depth, {}, mesh, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}
