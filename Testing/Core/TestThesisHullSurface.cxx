// SPDX-License-Identifier: BSD-3-Clause
#include "ThesisHullSurface.h"

#include "CarvingTestCaptures.h"
#include "LatticeRegions.h"
#include "MeshDistance.h"
#include "SurvivorCoverage.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** The promise, judged from the mesh and the octree alone. */
void expectPromise(const Mesh& mesh, const Octree& octree, const std::string& what)
{
  Execution execution;
  const MeshSoundness s = assessMesh(mesh, execution);
  EXPECT_TRUE(s.sound()) << what << ": open " << s.openEdges << ", non-manifold " << s.nonManifoldEdges << " + "
                         << s.nonManifoldVertices << ", self-intersections " << s.selfIntersections;
  EXPECT_EQ(s.unusedPoints, 0u);
  EXPECT_EQ(lostSurvivors(octree, mesh, execution), 0u) << what;
  EXPECT_LE(s.components, countSurvivorComponents(octree, execution)) << what;
}

Mesh shapeOf(int shape)
{
  switch (shape)
  {
    case 0:
      return sphereMesh(4, 0.9);
    case 1:
      return torusMesh(48, 24, 0.7, 0.3);
    case 2:
      return torusMesh(64, 12, 0.8, 0.02); // thinner than a leaf
    case 3:
      return joined(boxMesh({ -0.9, -0.2, -0.2 }, { -0.3, 0.2, 0.2 }), boxMesh({ 0.2, -0.8, -0.1 }, { 0.3, 0.8, 0.8 }));
    case 4: // an L
      return joined(boxMesh({ -0.8, -0.3, -0.8 }, { -0.2, 0.3, 0.8 }), boxMesh({ -0.3, -0.3, -0.8 }, { 0.8, 0.3, -0.3 }));
    default: // slanted, longer than wide
      Mesh ellipsoid = sphereMesh(4, 1.0);
      for (auto& p : ellipsoid.points)
      {
        p = Eigen::AngleAxisd(0.6, Vector3(1, 2, 3).normalized()) * Vector3(0.85 * p.x(), 0.5 * p.y(), 0.4 * p.z());
      }
      return ellipsoid;
  }
}

struct Scene
{
  Scene(int shape, int kind, int k, int depth = 5, std::uint64_t seed = 1000, int views_ = 11, int size = 110)
  {
    Random random(seed + std::uint64_t(100 * shape + kind));
    auto captured = viewsOf(shapeOf(shape), swayingRing(views_, size), size);
    disturb(captured, kind, random);
    this->views = prepareViews(captured, OutsidePolicy((shape + kind) % 3));
    this->octree = carveViews(this->views, unitCube(), depth, k);
    VotingOptions options;
    options.share = double(views_ - k) / views_;
    this->imperfect = votingMarchingCubes(this->octree, this->views, options, this->execution).mesh;
    this->covered = coveredSurface(this->imperfect, this->octree, &this->views, {}, this->execution).mesh;
  }
  Execution execution;
  PreparedViews views;
  Octree octree;
  Mesh imperfect;
  Mesh covered;
};

} // namespace

TEST(ThesisHullSurface, KeepsThePromiseForEveryNoiseVoteAndSeed)
{
  int runs = 0;
  for (int shape = 0; shape <= 5; ++shape)
  {
    for (int kind = 0; kind <= 5; ++kind)
    {
      for (const int k : { 0, 3 })
      {
        if (k == 0 && shape > 1 && shape % 2 != kind % 2)
        {
          continue; // half of the strict ones: each shape and each noise is there
        }
        try
        {
          const Scene run(shape, kind, k, 4, (shape + kind) % 2 == 0 ? 1000 : 77000);
          Execution execution;
          const auto result = thesisHullSurface(run.covered, run.octree, {}, execution);
          expectPromise(result.mesh, run.octree,
            "shape " + std::to_string(shape) + " noise " + std::to_string(kind) + " votes " + std::to_string(k));
          EXPECT_EQ(result.survivors, survivorsOf(run.octree));
          ++runs;
        }
        catch (const NothingSurvives&)
        {
          EXPECT_EQ(k, 0);
        }
      }
    }
  }
  EXPECT_GE(runs, 50);
}

TEST(ThesisHullSurface, KeepsThePromiseForEveryOption)
{
  Execution execution;
  for (const int shape : { 1, 4 })
  {
    const Scene run(shape, 3, 0, 4);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double tolerance : { 0.0, 1.0, 5.0 })
      {
        LocalHullOptions options;
        options.slices.axis = axis;
        options.slices.tolerance = options.chains.tolerance = tolerance;
        options.chains.overlap = axis == 0 ? 0.1 : 1.0;
        options.singlePrecision = axis == 1;
        const auto result = thesisHullSurface(run.covered, run.octree, options, execution);
        expectPromise(result.mesh, run.octree, "axis " + std::to_string(axis) + " tolerance " + std::to_string(tolerance));
        for (const auto& p : result.mesh.points)
        {
          const Vector3 rounded = roundedToFloat(p);
          EXPECT_TRUE(axis != 1 || p == rounded) << (p - rounded).norm();
        }
      }
    }
  }
}

TEST(ThesisHullSurface, AConvexObjectIsOneHullGivenOutAsItsOwnFacets)
{
  Execution execution;
  const Mesh box = boxMesh({ -0.7, -0.5, -0.6 }, { 0.73, 0.55, 0.6 });
  for (const int shape : { 0, 5, 6 })
  {
    const PreparedViews views =
      prepareViews(viewsOf(shape == 6 ? box : shapeOf(shape), swayingRing(24, 300), 300));
    const Octree octree = carveViews(views, unitCube(), 5);
    const Mesh imperfect = votingMarchingCubes(octree, views, {}, execution).mesh;
    const Mesh covered = coveredSurface(imperfect, octree, &views, {}, execution).mesh;
    for (const bool single : { false, true })
    {
      LocalHullOptions options;
      options.singlePrecision = single;
      const auto hulls = thesisHulls(covered, octree, options, execution);
      ASSERT_EQ(hulls.size(), 1u) << "shape " << shape;
      EXPECT_EQ(hulls[0].surfacePoints.size(), covered.points.size());
      const auto result = thesisHullSurface(covered, octree, options, execution);
      expectPromise(result.mesh, octree, "shape " + std::to_string(shape));
      EXPECT_EQ(result.mesh.triangles.size(), hulls[0].mesh.triangles.size());
      EXPECT_LT(result.mesh.triangles.size(), covered.triangles.size()) << "fewer than marching cubes'";
      if (!single)
      {
        EXPECT_EQ(result.mesh.points, hulls[0].mesh.points);
        EXPECT_EQ(result.mesh.triangles, hulls[0].mesh.triangles);
      }
    }
  }
}

TEST(ThesisHullSurface, ConcaveObjectsKeepTheirConcavities)
{
  Scene torus(1, 0, 0, 6, 1000, 24, 400);
  const auto hulls = thesisHulls(torus.covered, torus.octree, {}, torus.execution);
  EXPECT_GT(hulls.size(), 4u);
  const double volume = assessMesh(torus.covered, torus.execution).volume;
  std::vector<bool> held(torus.covered.points.size(), false);
  for (const auto& hull : hulls)
  {
    const MeshSoundness s = assessMesh(hull.mesh, torus.execution);
    EXPECT_EQ(s.openEdges + s.nonManifoldEdges, 0u);
    EXPECT_GT(s.volume, 0.0);
    EXPECT_LT(s.volume, 0.5 * volume);
    for (const auto p : hull.surfacePoints)
    {
      held[p] = true;
    }
  }
  EXPECT_GT(double(std::count(held.begin(), held.end(), true)), 0.99 * double(held.size()));
  const auto result = thesisHullSurface(torus.covered, torus.octree, {}, torus.execution);
  const MeshSoundness s = assessMesh(result.mesh, torus.execution);
  EXPECT_GE(s.genus.value_or(-1), 1) << "the hole stays";
  const double leaf = torus.octree.lattice.leafEdge();
  EXPECT_LT(compareMeshes(result.mesh, torus.covered, 0.5 * leaf, torus.execution).mean, 0.25 * leaf);
  EXPECT_GT(s.volume, volume) << "a union holds what it is made of";
  EXPECT_LT(s.volume, 1.065 * volume);
}

TEST(ThesisHullSurface, ALargerToleranceGivesFewerHullsAndMoreVolume)
{
  Scene torus(1, 0, 0, 5, 1000, 24, 300);
  std::size_t previousHulls = 100000;
  double previousVolume = 0.0;
  for (const double tolerance : { 0.1, 0.5, 1.0, 3.0, 100.0 })
  {
    LocalHullOptions options;
    options.slices.tolerance = options.chains.tolerance = tolerance;
    const auto hulls = thesisHulls(torus.covered, torus.octree, options, torus.execution);
    const auto result = combineLocalHulls(hulls, torus.covered, torus.octree, options, torus.execution);
    const double volume = assessMesh(result.mesh, torus.execution).volume;
    EXPECT_LT(hulls.size(), previousHulls) << tolerance;
    EXPECT_GT(volume, previousVolume) << tolerance;
    previousHulls = hulls.size();
    previousVolume = volume;
  }
  EXPECT_EQ(previousHulls, 1u);
}

TEST(ThesisHullSurface, EveryHullBearsOnTheSurface)
{
  Scene torus(1, 0, 0, 5, 1000, 24, 300);
  LocalHullOptions options;
  options.slices.tolerance = options.chains.tolerance = 2.0;
  const auto hulls = thesisHulls(torus.covered, torus.octree, options, torus.execution);
  const auto whole = combineLocalHulls(hulls, torus.covered, torus.octree, options, torus.execution);
  const auto volumeOf = [&](const Mesh& mesh) { return assessMesh(mesh, torus.execution).volume; };
  int changed = 0;
  for (std::size_t h = 0; h < hulls.size(); ++h)
  {
    auto fewer = hulls;
    fewer.erase(fewer.begin() + std::ptrdiff_t(h));
    const auto result = combineLocalHulls(fewer, torus.covered, torus.octree, options, torus.execution);
    changed += volumeOf(result.mesh) < volumeOf(whole.mesh) - 1e-9;
  }
  EXPECT_GT(2 * changed, int(hulls.size())) << "most hulls hold something that no other does";
  const auto none = combineLocalHulls({}, torus.covered, torus.octree, options, torus.execution);
  EXPECT_EQ(none.mesh.triangles, torus.covered.triangles) << "without hulls it is the covered surface";
  EXPECT_LT(volumeOf(none.mesh), volumeOf(whole.mesh));
  // A hull that grows takes the surface along.
  auto grown = hulls;
  const double leaf = torus.octree.lattice.leafEdge();
  for (auto& p : grown[0].mesh.points)
  {
    p += 3.0 * leaf * p.normalized();
  }
  const auto moved = combineLocalHulls(grown, torus.covered, torus.octree, options, torus.execution);
  EXPECT_GT(volumeOf(moved.mesh), volumeOf(whole.mesh) + std::pow(leaf, 3));
}

/** What hulls add that touches no part of the solid is dropped, and what they enclose is filled, or not. */
TEST(ThesisHullSurface, LooseHullsAreDroppedAndCavitiesFilledByOption)
{
  const Scene run(3, 0, 0);
  Execution execution;
  const LocalHull loose{ boxMesh({ -1.0, 0.7, -1.0 }, { -0.6, 1.0, -0.6 }), {} };
  const auto with = combineLocalHulls({ loose }, run.covered, run.octree, {}, execution);
  EXPECT_EQ(with.mesh.triangles, combineLocalHulls({}, run.covered, run.octree, {}, execution).mesh.triangles);
  // Six walls around the smaller box.
  std::vector<LocalHull> walls;
  const Vector3 low(-1.1, -0.5, -0.5), high(-0.05, 0.5, 0.5);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool upper : { false, true })
    {
      Vector3 a = low, b = high;
      (upper ? a : b)[axis] = upper ? high[axis] - 0.12 : low[axis] + 0.12;
      walls.push_back({ boxMesh(a, b), {} });
    }
  }
  walls.push_back({ boxMesh({ -0.4, -0.1, -0.1 }, { -0.05, 0.1, 0.1 }), {} }); // joins walls and box
  const auto filled = combineLocalHulls(walls, run.covered, run.octree, {}, execution);
  expectPromise(filled.mesh, run.octree, "filled");
  EXPECT_EQ(filled.cavitiesFilled, 1u);
  LocalHullOptions options;
  options.fillCavities = false;
  const auto open = combineLocalHulls(walls, run.covered, run.octree, options, execution);
  EXPECT_EQ(open.cavitiesFilled, 0u);
  EXPECT_EQ(assessMesh(open.mesh, execution).components, assessMesh(filled.mesh, execution).components + 1);
  EXPECT_LT(assessMesh(open.mesh, execution).volume, assessMesh(filled.mesh, execution).volume - 0.05);
}

/** Two silhouettes with a hole, either of which may be wrong: what lies in both holes is enclosed. */
TEST(ThesisHullSurface, CountsTheCavitiesThatTheCoveringFilled)
{
  Execution execution;
  std::vector<View> captured = viewsOf(boxMesh(-0.8, 0.8), axisCameras(40.0, 120), 120);
  captured.resize(2);
  for (View& view : captured)
  {
    for (int n = 0; n < 120 * 120; ++n)
    {
      view.silhouette.pixels[std::size_t(n)] &= std::hypot(n % 120 - 59.5, n / 120 - 59.5) > 12.0;
    }
  }
  const PreparedViews views = prepareViews(captured);
  const Octree octree = carveViews(views, unitCube(), 5, 1);
  VotingOptions voting;
  voting.share = 0.5;
  const Mesh surface = votingMarchingCubes(octree, views, voting, execution).mesh;
  LocalHullOptions options;
  options.mode = LocalHullMode::Thesis;
  const LocalHullSurface filled = localHullSurface(surface, octree, &views, options, execution);
  EXPECT_EQ(filled.cavitiesFilled, 1u);
  EXPECT_EQ(assessMesh(filled.mesh, execution).components, 1u);
  options.mode = LocalHullMode::Robust;
  EXPECT_EQ(localHullSurface(surface, octree, &views, options, execution).cavitiesFilled, 1u);
}

TEST(ThesisHullSurface, HasNoHullsOfIslandsThatAreGivenUp)
{
  Execution execution;
  const Mesh object = joined(boxMesh({ -0.1, -0.5, -0.5 }, { 0.8, 0.5, 0.5 }), boxMesh({ -0.8, -0.15, -0.15 }, { -0.5, 0.15, 0.15 }));
  const PreparedViews views = prepareViews(viewsOf(object, swayingRing(16, 300), 300));
  const Octree octree = carveViews(views, unitCube(), 5);
  const Mesh surface = votingMarchingCubes(octree, views, VotingOptions(), execution).mesh;
  LocalHullOptions options;
  options.mode = LocalHullMode::Thesis;
  for (const double share : { 0.0, 0.5 })
  {
    options.islandShare = share;
    double least = 1.0;
    for (const LocalHull& hull : classifyLocalHulls(surface, octree, &views, options, execution))
    {
      for (const auto& p : hull.mesh.points)
      {
        least = std::min(least, p.x());
      }
    }
    EXPECT_EQ(least > -0.4, share > 0.0) << share << ": " << least;
  }
}

TEST(ThesisHullSurface, SameBytesForAnyNumberOfThreads)
{
  const Scene run(1, 3, 0);
  Execution serial;
  const auto hulls = thesisHulls(run.covered, run.octree, {}, serial);
  const auto one = thesisHullSurface(run.covered, run.octree, {}, serial);
  EXPECT_GT(hulls.size(), 1u);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = thesisHullSurface(run.covered, run.octree, {}, execution);
    EXPECT_EQ(one.mesh.points, many.mesh.points);
    EXPECT_EQ(one.mesh.triangles, many.mesh.triangles);
    const auto others = thesisHulls(run.covered, run.octree, {}, execution);
    ASSERT_EQ(hulls.size(), others.size());
    for (std::size_t h = 0; h < hulls.size(); ++h)
    {
      EXPECT_EQ(hulls[h].mesh.points, others[h].mesh.points);
      EXPECT_EQ(hulls[h].mesh.triangles, others[h].mesh.triangles);
      EXPECT_EQ(hulls[h].surfacePoints, others[h].surfacePoints);
    }
  }
}

TEST(ThesisHullSurface, ASurfaceThatDoesNotCoverIsAnError)
{
  const Scene run(3, 0, 0);
  Execution execution;
  for (const Mesh& bare : { Mesh(), sphereMesh(2, 0.1) })
  {
    try
    {
      thesisHullSurface(bare, run.octree, {}, execution);
      FAIL();
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find("without an inside corner"), std::string::npos) << error.what();
    }
  }
  EXPECT_TRUE(thesisHullSurface(Mesh(), Octree(), {}, execution).mesh.triangles.empty());
}

namespace
{

/** Cancelled at the n-th question. */
class LateCancel : public Execution
{
public:
  explicit LateCancel(int questions)
    : Left(questions)
  {
  }
  bool cancelled() const override { return --this->Left < 0; }

private:
  mutable int Left;
};

} // namespace

TEST(ThesisHullSurface, CanBeCancelledBeforeAndDuring)
{
  const Scene run(1, 0, 0);
  CancelledExecution cancelled;
  EXPECT_THROW(thesisHullSurface(run.covered, run.octree, {}, cancelled), Cancelled);
  int during = 0;
  for (;; ++during)
  {
    LateCancel late(during);
    try
    {
      thesisHullSurface(run.covered, run.octree, {}, late);
      break;
    }
    catch (const Cancelled&)
    {
    }
  }
  EXPECT_GE(during, 10) << "it is asked often enough";
  ProgressExecution progress;
  thesisHullSurface(run.covered, run.octree, {}, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}
