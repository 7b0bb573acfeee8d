// SPDX-License-Identifier: BSD-3-Clause
#include "LocalHullSurface.h"

#include "CarvingTestCaptures.h"
#include "LatticeRegions.h"
#include "MeshDistance.h"
#include "SurvivorCoverage.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <array>
#include <utility>

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
    default:
      return joined(boxMesh({ -0.9, -0.2, -0.2 }, { -0.3, 0.2, 0.2 }), boxMesh({ 0.2, -0.8, -0.1 }, { 0.3, 0.8, 0.8 }));
  }
}

struct Scene
{
  Scene(int shape, int kind, int k, OutsidePolicy policy = OutsidePolicy::Border, EdgePlacement edges = EdgePlacement::Exact)
  {
    Random random(std::uint64_t(1000 + 100 * shape + kind));
    auto captured = viewsOf(shapeOf(shape), swayingRing(11, 110), 110);
    disturb(captured, kind, random);
    this->views = prepareViews(captured, policy);
    this->octree = carveViews(this->views, unitCube(), 5, k);
    VotingOptions options;
    options.share = (11.0 - k) / 11.0;
    options.edges = edges;
    this->surface = votingMarchingCubes(this->octree, this->views, options, this->execution);
  }
  Execution execution;
  PreparedViews views;
  Octree octree;
  VotingSurface surface;
};

/** An ellipse that fills two thirds of an image. */
BinaryImage ellipse(int width, int height)
{
  BinaryImage image{ width, height, std::vector<std::uint8_t>(std::size_t(width) * height) };
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const double x = (column - (width - 1) / 2.0) / width, y = (row - (height - 1) / 2.0) / height;
      image.at(column, row) = x * x + y * y < 0.12;
    }
  }
  return image;
}

BinaryImage imageOf(int width, int height, std::vector<std::uint8_t> pixels)
{
  return { width, height, std::move(pixels) };
}

/** Four pixels a hexadecimal digit, the first one lowest. */
BinaryImage imageOf(int width, int height, const std::string& digits)
{
  BinaryImage image{ width, height, {} };
  for (int pixel = 0; pixel < width * height; ++pixel)
  {
    const char digit = digits[std::size_t(pixel / 4)];
    const int bits = digit <= '9' ? digit - '0' : digit - 'a' + 10;
    image.pixels.push_back(std::uint8_t(bits >> pixel % 4 & 1));
  }
  return image;
}

View viewOf(const std::array<double, 12>& matrix, BinaryImage silhouette)
{
  View view;
  view.projection = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(matrix.data());
  view.silhouette = std::move(silhouette);
  return view;
}

} // namespace

TEST(LocalHullSurface, KeepsItsPromiseForEveryShapeNoiseAndVoteWithAndWithoutViews)
{
  int runs = 0;
  for (int shape = 0; shape < 4; ++shape)
  {
    for (int kind = 0; kind <= 5; ++kind)
    {
      for (const int k : { 0, 3 })
      {
        try
        {
          const Scene run(shape, kind, k, OutsidePolicy((shape + kind) % 3));
          const std::string what =
            "shape " + std::to_string(shape) + " noise " + std::to_string(kind) + " votes " + std::to_string(k);
          Execution execution;
          for (const bool withViews : { true, false })
          {
            const auto result = localHullSurface(
              run.surface.mesh, run.octree, withViews ? &run.views : nullptr, LocalHullOptions(), execution);
            expectPromise(result.mesh, run.octree, what + (withViews ? "" : ", no views"));
            EXPECT_EQ(result.survivors, survivorsOf(run.octree));
          }
          ++runs;
        }
        catch (const NothingSurvives&)
        {
          EXPECT_EQ(k, 0);
        }
      }
    }
  }
  EXPECT_GE(runs, 36);
}

TEST(LocalHullSurface, KeepsItsPromiseForSubPixelSurfaces)
{
  Execution execution;
  for (int shape = 0; shape < 4; ++shape)
  {
    for (const int kind : { 0, 2 })
    {
      const int k = kind == 0 ? 0 : 3;
      const Scene run(shape, kind, k, OutsidePolicy::Border, EdgePlacement::SubPixel);
      for (const bool withViews : { true, false })
      {
        const auto result = localHullSurface(
          run.surface.mesh, run.octree, withViews ? &run.views : nullptr, LocalHullOptions(), execution);
        expectPromise(result.mesh, run.octree, "shape " + std::to_string(shape) + (withViews ? "" : ", no views"));
        EXPECT_EQ(result.survivors, survivorsOf(run.octree));
      }
    }
  }
}

TEST(LocalHullSurface, KeepsItsPromiseForSurfacesFullOfHoles)
{
  Execution execution;
  const Scene run(1, 2, 0);
  for (const double share : { 0.9, 0.6, 0.3 })
  {
    VotingOptions options;
    options.share = share;
    options.mode = VotingMode::Faithful;
    options.edges = EdgePlacement::Middle;
    const auto torn = votingMarchingCubes(run.octree, run.views, options, execution);
    for (const bool withViews : { true, false })
    {
      const auto result =
        localHullSurface(torn.mesh, run.octree, withViews ? &run.views : nullptr, LocalHullOptions(), execution);
      expectPromise(result.mesh, run.octree, "share " + std::to_string(share));
    }
  }
}

TEST(LocalHullSurface, KeepsItsPromiseForASurfaceThatHasNothingToDoWithTheOctree)
{
  Execution execution;
  const Scene run(3, 0, 0);
  for (const Mesh& strange : { Mesh(), sphereMesh(2, 0.4), joined(run.surface.mesh, run.surface.mesh) })
  {
    for (const bool withViews : { true, false })
    {
      const auto result =
        localHullSurface(strange, run.octree, withViews ? &run.views : nullptr, LocalHullOptions(), execution);
      expectPromise(result.mesh, run.octree, "strange surface");
    }
  }
}

TEST(LocalHullSurface, KeepsItsPromiseInSinglePrecisionAndForTheShallowestTrees)
{
  Execution execution;
  for (const int depth : { 1, 2, 3 })
  {
    const Scene run(0, 1, 3);
    const Octree octree = carveViews(run.views, unitCube(1.0), depth, 3);
    LocalHullOptions options;
    options.singlePrecision = true;
    const auto result = localHullSurface(Mesh(), octree, &run.views, options, execution);
    expectPromise(result.mesh, octree, "depth " + std::to_string(depth));
    for (const auto& p : result.mesh.points)
    {
      EXPECT_EQ(p, roundedToFloat(p));
    }
  }
}

TEST(LocalHullSurface, AnObjectCutByTheCubeStaysWhole)
{
  Execution execution;
  const Scene run(1, 0, 0);
  const Octree octree = carveViews(run.views, { Vector3(-0.3, 0.2, -0.3), 0.6 }, 4);
  expectPromise(localHullSurface(Mesh(), octree, &run.views, {}, execution).mesh, octree, "cut");
  expectPromise(localHullSurface(Mesh(), octree, nullptr, {}, execution).mesh, octree, "cut, no views");
}

/** Lost = 0 is not bought by fattening: on clean silhouettes the volume stays that of exact marching cubes. */
TEST(LocalHullSurface, DoesNotFattenCleanSolids)
{
  Execution execution;
  for (const int shape : { 0, 1 })
  {
    const PreparedViews views = prepareViews(viewsOf(shapeOf(shape), swayingRing(14, 500), 500));
    const Octree octree = carveViews(views, unitCube(), 7);
    const auto exact = votingMarchingCubes(octree, views, VotingOptions(), execution);
    const auto result = localHullSurface(exact.mesh, octree, &views, LocalHullOptions(), execution);
    const double before = assessMesh(exact.mesh, execution).volume;
    const double after = assessMesh(result.mesh, execution).volume;
    EXPECT_NEAR(after / before, 1.0, 0.005) << "shape " << shape;
    EXPECT_LE(assessMesh(result.mesh, execution).genus.value(), assessMesh(exact.mesh, execution).genus.value());
    EXPECT_GE(assessMesh(result.mesh, execution).genus.value(), shape);
  }
}

TEST(LocalHullSurface, KeepsItsPromiseForWhatIsNotGivenUp)
{
  Execution execution;
  std::uint64_t given = 0;
  for (const int kind : { 0, 1, 2, 3, 5 })
  {
    const Scene run(kind % 3, kind, 0);
    for (const PreparedViews* views : { static_cast<const PreparedViews*>(nullptr), &run.views })
    {
      LocalHullOptions options;
      options.islandShare = 0.5;
      const auto result = localHullSurface(run.surface.mesh, run.octree, views, options, execution);
      DroppedSurvivors dropped;
      const Octree kept = dropLeaves(run.octree, result.dropped.leaves, dropped);
      EXPECT_EQ(dropped.leaves, result.dropped.leaves);
      expectPromise(result.mesh, kept, "noise " + std::to_string(kind) + (views ? ", views" : ""));
      given += dropped.octants;
      options.islandShare = 0.0;
      EXPECT_EQ(localHullSurface(run.surface.mesh, run.octree, views, options, execution).dropped.octants, 0u);
    }
  }
  EXPECT_GT(given, 0u);
}

/** Debris of flipped pixels that touches the object is no island, but the repair of the silhouettes tells it. */
TEST(LocalHullSurface, DebrisIsGivenUpWithTheIslands)
{
  Execution execution;
  auto captured = viewsOf(shapeOf(1), swayingRing(24, 400), 400);
  const PreparedViews cleanViews = prepareViews(captured);
  const Octree clean = carveViews(cleanViews, unitCube(), 6);
  const Mesh truth = localHullSurface(
    votingMarchingCubes(clean, cleanViews, VotingOptions(), execution).mesh, clean, &cleanViews, {}, execution).mesh;
  Random random(5);
  for (View& view : captured)
  {
    for (auto& pixel : view.silhouette.pixels)
    {
      pixel ^= std::uint8_t(random.uniform() < 0.01);
    }
  }
  const PreparedViews views = prepareViews(captured);
  const Octree octree = carveViews(views, unitCube(), 6);
  const Mesh imperfect = votingMarchingCubes(octree, views, VotingOptions(), execution).mesh;
  const double leaf = octree.lattice.leafEdge();
  const auto error = [&](double share, bool repair, LocalHullSurface& surface)
  {
    LocalHullOptions options;
    options.islandShare = share;
    options.repairSilhouettes = repair;
    surface = localHullSurface(imperfect, octree, &views, options, execution);
    return compareMeshes(surface.mesh, truth, leaf / 2.0, execution).mean / leaf;
  };
  LocalHullSurface all, islandless, unrepaired;
  const double kept = error(0.0, true, all), without = error(0.05, true, islandless);
  error(0.05, false, unrepaired);
  EXPECT_EQ(all.dropped.octants, 0u);
  expectPromise(all.mesh, octree, "all kept");
  EXPECT_GT(islandless.dropped.octants, unrepaired.dropped.octants) << "debris beside islands";
  const MeshSoundness soundness = assessMesh(islandless.mesh, execution);
  EXPECT_TRUE(soundness.sound());
  EXPECT_EQ(soundness.components, 1u);
  EXPECT_EQ(soundness.genus.value(), assessMesh(truth, execution).genus.value());
  EXPECT_LT(without, 0.05);
  EXPECT_LT(without, 0.3 * kept);
}

/** A capture, found among random ones, whose repair fills a place that holds no survivor; no field corrects it. */
TEST(LocalHullSurface, ARepairAddsNoComponent)
{
  const std::string noisy = "00400000800000000000002040000000080000000200000009c30000e70000ff0008ff100cff300cf7301cff300eff540eff700aff708ffff00f7ff00ffff00f"
                            "fbf00ffff00ffff00fff700dfff00ffff00fffe00ffbb00feff00ffff00ffff00ffff00ffff006ef700eff700eff780cff300cff302cef3008ff1000ff0000e7"
                            "0400c300100004000050000400400000000000000000008400010000";
  const PreparedViews views = prepareViews({
    viewOf({ 28.46979879367295, 9.7097651466063244, -2.2297962792423114, 18.43483786056531, 7.5629853594521776, 2.4872556513383302, -5.6205405038599645,
             5.8159672349472809, 0.77049467603815591, 0.55089506658438203, -0.32070637631616628, 0.65723984267018298 },
      ellipse(57, 19)),
    viewOf({ -1.2971417198714614, 2.1163368941467744, -1.1944973998990591, 2.2894606464460265, -3.7650438429566395, -1.7112731447156473, 0.63806330075255213,
             4.6345120615582944, -0.34663528752456546, 0.47899030508205959, 0.80648141025082365, 4.6982402245839667 },
      imageOf(2, 3, std::vector<std::uint8_t>{ 0, 0, 0, 1, 0, 0 })),
    viewOf({ 3.7567636526635422, 17.043739995247037, 33.444894803649433, 24.610880017699674, 11.797310259382973, -18.79945638083581, 32.952513281789443,
             26.65865561928775, 0.70187640646163896, 0.10592377849867596, 0.70437892018505188, 0.86827743020662629 },
      ellipse(57, 60)),
    viewOf({ -0.98691714589894886, 1.8341580165076372, 0.72576101328894593, 0.045739273256282242, -0.24183405967847621, -1.7429351432661564, 4.0759261398045759,
             2.1140547506984673, 0.88083381543762684, 0.34616375309939251, 0.32295889153534002, 4.5708447332272142 },
      imageOf(1, 2, std::vector<std::uint8_t>{ 1, 1 })),
    viewOf({ 0.6208656435053066, 1.3769277103370254, 1.1871386592647661, 0.023902979443955363, 5.0086467854989838, -20.348606957639404, 20.982270169339579,
             34.203155983376043, 0.94469896437453227, -0.28275661890854836, -0.16611008751154144, 4.7030768150454589 },
      imageOf(1, 15, std::vector<std::uint8_t>(15, 1))),
    viewOf({ 6.7612599660714885, -7.6242677789302054, 6.3069071774216399, 2.6395332237474336, 6.5721861878564543, -15.99598728450526, 20.113828636512157,
             5.6853139635361565, 0.316295334525173, -0.77340199824409683, 0.54936928424298259, 0.22504813159126499 },
      imageOf(24, 52, noisy)),
  });
  const RootCube cube{ { -1.4336150120943785, -0.65593220014125109, -1.444470897084102 }, 2.4649056014604867 };
  const Octree octree = carveViews(views, cube, 5);
  Execution execution;
  VotingOptions voting;
  voting.edges = EdgePlacement::SubPixel;
  const Mesh imperfect = votingMarchingCubes(octree, views, voting, execution).mesh;
  LocalHullOptions options;
  options.bridgeGap = 0;
  options.tunnels.width = 1;
  options.tunnels.loop = 1.3259072708897293;
  options.handles.loop = 0.89085924299433827;
  options.repair.blobDepth = 0.10884854127652943;
  const LocalHullSurface surface = localHullSurface(imperfect, octree, &views, options, execution);
  EXPECT_GT(countSurvivorComponents(octree, execution), 0u);
  expectPromise(surface.mesh, octree, "a repair without survivors");
}

/** Three boxes in a row, the gaps between them a good octant and two good ones. */
TEST(LocalHullSurface, ALargerBridgeGapJoinsMoreAndNoneJoinsNothing)
{
  const double leaf = 1.0 / 16.0;
  const Mesh mesh = joined(joined(boxMesh({ -0.8, -0.3, -0.3 }, { -3.2 * leaf, 0.3, 0.3 }),
                             boxMesh({ -1.3 * leaf, -0.3, -0.3 }, { 4.4 * leaf, 0.3, 0.3 })),
    boxMesh({ 7.3 * leaf, -0.3, -0.3 }, { 0.9, 0.3, 0.3 }));
  const PreparedViews views = prepareViews(viewsOf(mesh, axisCameras(200.0, 500), 500));
  const Octree octree = carveViews(views, unitCube(1.0), 5);
  Execution execution;
  ASSERT_EQ(countSurvivorComponents(octree, execution), 3u);
  for (const PreparedViews* given : { static_cast<const PreparedViews*>(nullptr), &views })
  {
    for (const int gap : { 0, 1, 2, 3 })
    {
      LocalHullOptions options;
      options.bridgeGap = gap;
      const auto result = localHullSurface(Mesh(), octree, given, options, execution);
      EXPECT_EQ(result.bridges, std::uint64_t(std::min(gap, 2))) << "gap " << gap;
      EXPECT_EQ(assessMesh(result.mesh, execution).components, std::uint64_t(3 - std::min(gap, 2))) << "gap " << gap;
      expectPromise(result.mesh, octree, "gap " + std::to_string(gap));
    }
  }
}

TEST(LocalHullSurface, ACleanCaptureHasNothingToGiveUp)
{
  Execution execution;
  const Scene run(1, 0, 0);
  LocalHullOptions options;
  const auto kept = localHullSurface(run.surface.mesh, run.octree, &run.views, options, execution);
  options.islandShare = 1.0;
  const auto asked = localHullSurface(run.surface.mesh, run.octree, &run.views, options, execution);
  EXPECT_EQ(asked.dropped.octants, 0u);
  EXPECT_EQ(asked.mesh.points, kept.mesh.points);
  EXPECT_EQ(asked.mesh.triangles, kept.mesh.triangles);
}

TEST(LocalHullSurface, SameBytesForAnyNumberOfThreadsAndAnyOrderOfViews)
{
  const Scene run(1, 1, 3);
  Execution serial;
  const auto one = localHullSurface(run.surface.mesh, run.octree, &run.views, {}, serial);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = localHullSurface(run.surface.mesh, run.octree, &run.views, {}, execution);
    EXPECT_EQ(one.mesh.points, many.mesh.points);
    EXPECT_EQ(one.mesh.triangles, many.mesh.triangles);
  }
}

TEST(LocalHullSurface, OptionsOutOfRangeAndOtherViewsAreErrors)
{
  const Scene run(0, 0, 0);
  const Scene other(1, 0, 0);
  Execution execution;
  EXPECT_THROW(localHullSurface(run.surface.mesh, run.octree, &other.views, {}, execution), InvalidInput);
  LocalHullOptions options;
  options.coverOffset = 0.0;
  EXPECT_THROW(localHullSurface(run.surface.mesh, run.octree, &run.views, options, execution), InvalidInput);
  options = {};
  options.bridgeGap = -1;
  EXPECT_THROW(localHullSurface(run.surface.mesh, run.octree, &run.views, options, execution), InvalidInput);
  CancelledExecution cancelled;
  EXPECT_THROW(localHullSurface(run.surface.mesh, run.octree, &run.views, {}, cancelled), Cancelled);
  EXPECT_TRUE(localHullSurface(Mesh(), Octree(), nullptr, {}, execution).mesh.triangles.empty());
  ProgressExecution progress;
  localHullSurface(run.surface.mesh, run.octree, &run.views, {}, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}
