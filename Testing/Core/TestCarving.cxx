// SPDX-License-Identifier: BSD-3-Clause
#include "Carving.h"

#include "CarvingTestCaptures.h"
#include "CornerShell.h"
#include "TreePieces.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

const int ImageSize = 160;

std::vector<View> torusViews(int count = 14)
{
  Mesh torus = torusMesh(48, 24, 0.7, 0.28);
  for (auto& p : torus.points)
  {
    p = Eigen::AngleAxisd(0.4, Vector3::UnitX()) * p;
  }
  return viewsOf(torus, swayingRing(count, ImageSize), ImageSize);
}

std::string carveMessage(const std::vector<View>& views, int depth, int backgroundVotes, RootCube cube = unitCube())
{
  try
  {
    const PreparedViews prepared = prepareViews(views);
    carveViews(prepared, cube, depth, backgroundVotes);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

double volumeOfStates(const Octree& octree, bool withIntersections)
{
  double volume = 0.0;
  for (int g = octree.treeGeneration; g <= octree.lattice.depth; ++g)
  {
    const double octant = std::pow(std::ldexp(octree.lattice.root.edge, -g), 3);
    volume += octant * double(octree.count(OctantState::Inside, g));
    if (withIntersections && g == octree.lattice.depth)
    {
      volume += octant * double(octree.count(OctantState::Intersection, g));
    }
  }
  return volume;
}

/** The theorem of the method: no cell outside the shell has corners of both labels, and no octant lies about its points. */
void expectConsistent(const PreparedViews& views, const Octree& octree)
{
  const LatticeViews lattice(views, octree.lattice);
  const int required = views.size() - octree.backgroundVotes;
  const int n = octree.lattice.cells();
  for (int c = 0; c < n * n * n; ++c)
  {
    const LatticePoint cell{ c % n, c / n % n, c / n / n };
    const auto location = octree.locate(cell);
    ASSERT_GE(location.generation, 0);
    int inside = 0;
    for (int k = 0; k < 8; ++k)
    {
      const LatticePoint p = cell + cornerOffset(k);
      inside += !octree.lattice.onBorder(p) && lattice.insideVotes(p) >= required;
    }
    if (location.state == OctantState::Background)
    {
      EXPECT_EQ(inside, 0);
    }
    if (location.state == OctantState::Inside)
    {
      EXPECT_EQ(inside, 8);
    }
  }
}

} // namespace

TEST(Carving, NoMixedCellLiesOutsideTheShell)
{
  for (int kind = 0; kind <= 5; ++kind)
  {
    for (const int k : { 0, 1, 4 })
    {
      Random random(100 + kind);
      auto views = torusViews();
      disturb(views, kind, random);
      const PreparedViews prepared = prepareViews(views);
      try
      {
        expectConsistent(prepared, carveViews(prepared, unitCube(), 5, k));
      }
      catch (const NothingSurvives&)
      {
        EXPECT_EQ(k, 0) << "noise " << kind;
      }
    }
  }
}

TEST(Carving, TheStateOfALeafIsKnownFromTheViewsAlone)
{
  for (int kind = 0; kind <= 5; ++kind)
  {
    const int k = kind == 4 ? 6 : kind % 3;
    Random random(200 + kind);
    auto views = torusViews(kind == 3 ? 4 : 14);
    disturb(views, kind, random);
    views[0].projection = lookAtOrigin({ 0.4, 0.1, 0.2 }, 150.0, ImageSize); // in the cube
    const PreparedViews prepared = prepareViews(views, OutsidePolicy(kind % 3));
    const Octree octree = carveViews(prepared, unitCube(), 5, k);
    const LatticeViews lattice(prepared, octree.lattice);
    for (std::uint64_t cell = 0; cell < std::uint64_t(1) << 15; ++cell)
    {
      ASSERT_EQ(int(leafState(lattice, k, fromMorton(cell))), int(octree.locate(fromMorton(cell)).state))
        << "noise " << kind << ", cell " << cell;
    }
  }
}

TEST(Carving, TheTheoremHoldsWithCamerasInTheBoxAndEveryPolicy)
{
  Random random(5);
  for (int run = 0; run < 9; ++run)
  {
    auto views = torusViews(6);
    for (auto& view : views)
    {
      const Vector3 eye(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2));
      view.projection = lookAtOrigin(eye, 60, ImageSize);
      for (auto& pixel : view.silhouette.pixels)
      {
        pixel |= std::uint8_t(random.uniform() < 0.6);
      }
    }
    const PreparedViews prepared = prepareViews(views, OutsidePolicy(run % 3));
    try
    {
      expectConsistent(prepared, carveViews(prepared, unitCube(), 4, run % 2));
    }
    catch (const NothingSurvives&)
    {
    }
  }
}

TEST(Carving, VolumesBracketTheBoxOfThreeAffineViews)
{
  // Three views along the axes of a box: their hull is the box. Pixels of 1/64 fit its sides exactly.
  const int size = 160;
  const double scale = 64.0;
  std::vector<View> views;
  for (const auto& camera : axisCameras(scale, size))
  {
    View view{ "axis", camera, { size, size, {} } };
    for (int i = 0; i < size * size; ++i)
    {
      const double u = (i % size - 0.5 * (size - 1)) / scale, v = (i / size - 0.5 * (size - 1)) / scale;
      view.silhouette.pixels.push_back(std::abs(u) < 0.75 && std::abs(v) < 0.75);
    }
    views.push_back(view);
  }
  const PreparedViews prepared = prepareViews(views);
  const double truth = 1.5 * 1.5 * 1.5;
  double gap = 1e9;
  for (int depth = 3; depth <= 7; ++depth)
  {
    const Octree octree = carveViews(prepared, unitCube(), depth);
    EXPECT_LE(volumeOfStates(octree, false), truth * (1 + 1e-9));
    EXPECT_GE(volumeOfStates(octree, true), truth * (1 - 1e-9));
    const double now = volumeOfStates(octree, true) - volumeOfStates(octree, false);
    EXPECT_LT(now, 0.75 * gap) << "depth " << depth;
    gap = now;
  }
}

TEST(Carving, ViewsThatAreInsideForTheParentAreNotTestedAgain)
{
  const PreparedViews prepared = prepareViews(torusViews());
  const Octree octree = carveViews(prepared, unitCube(), 7);
  EXPECT_LT(octree.statistics.viewTests, octree.statistics.octantsTested * 6);
  double carved = 0.0;
  for (const double share : octree.statistics.carvedByView)
  {
    carved += share;
  }
  double background = 0.0;
  for (int g = octree.treeGeneration; g <= 7; ++g)
  {
    background += std::ldexp(double(octree.count(OctantState::Background, g)), -3 * g);
  }
  EXPECT_DOUBLE_EQ(carved, background);
}

TEST(Carving, TreesCarvedApartAreTheWhole)
{
  const PreparedViews prepared = prepareViews(torusViews());
  const LatticeViews views(prepared, { unitCube(), 6 });
  Execution execution;
  const Octree whole = carve(views, CarveOptions(), execution);
  std::vector<Octree> parts(8);
  for (std::uint64_t part = 0; part < 8; ++part)
  {
    CarveOptions options;
    for (std::uint64_t tree = 0; tree < 512; ++tree)
    {
      if (tree * 5 % 8 == part) // scattered, so that the merge has to sort
      {
        options.trees.push_back(tree);
      }
    }
    parts[part] = carve(views, options, execution);
  }
  const Octree merged = mergeTrees(parts);
  EXPECT_TRUE(sameOctants(whole, merged));
  EXPECT_EQ(whole.statistics.viewTests, merged.statistics.viewTests);
  EXPECT_EQ(whole.statistics.octantsTested, merged.statistics.octantsTested);
}

TEST(Carving, DoesNotDependOnThreadsNorOnTheOrderOfViews)
{
  auto views = torusViews();
  const PreparedViews prepared = prepareViews(views);
  const LatticeViews latticeViews(prepared, { unitCube(), 6 });
  Execution serial;
  CarveOptions options;
  options.backgroundVotes = 1;
  const Octree one = carve(latticeViews, options, serial);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const Octree many = carve(latticeViews, options, execution);
    EXPECT_TRUE(sameOctants(one, many));
    EXPECT_EQ(one.statistics.viewTests, many.statistics.viewTests);
    EXPECT_EQ(one.statistics.carvedByView, many.statistics.carvedByView);
  }
  std::reverse(views.begin(), views.end());
  const PreparedViews reversed = prepareViews(views);
  EXPECT_TRUE(sameOctants(one, carveViews(reversed, unitCube(), 6, 1)));
}

TEST(Carving, OctantsAtTheBorderOfTheCubeAreNeverInside)
{
  const PreparedViews prepared = prepareViews(torusViews());
  const Octree octree = carveViews(prepared, { Vector3(-0.3, 0.2, -0.3), 0.6 }, 5); // cuts the torus
  std::size_t atBorder = 0;
  for (int c = 0; c < 32 * 32 * 32; ++c)
  {
    const LatticePoint cell{ c % 32, c / 32 % 32, c / 32 / 32 };
    const bool border = cell.i % 31 == 0 || cell.j % 31 == 0 || cell.k % 31 == 0;
    const auto state = octree.locate(cell).state;
    EXPECT_FALSE(border && state == OctantState::Inside);
    atBorder += border && state == OctantState::Intersection;
  }
  EXPECT_GT(atBorder, 0u);
}

TEST(Carving, ErrorsSayWhatIsWrong)
{
  const auto views = torusViews(4);
  EXPECT_EQ(carveMessage(views, 0, 0), "depth 0 is outside 1 to 16");
  EXPECT_EQ(carveMessage(views, 17, 0), "depth 17 is outside 1 to 16");
  EXPECT_NE(carveMessage(views, 4, 4).find("background votes 4 are outside 0 to 3"), std::string::npos);
  EXPECT_NE(carveMessage(views, 4, -1).find("background votes -1"), std::string::npos);
  EXPECT_NE(carveMessage(views, 4, 0, { Vector3::Zero(), 0.0 }).find("the root cube's edge is 0"), std::string::npos);
}

TEST(Carving, NothingSurvivesNamesTheViewThatEmptiedIt)
{
  auto views = torusViews(8);
  auto empty = views;
  std::fill(empty[3].silhouette.pixels.begin(), empty[3].silhouette.pixels.end(), std::uint8_t(0));
  EXPECT_NE(carveMessage(empty, 5, 0).find("silhouette of view 3 (v3) is empty"), std::string::npos);
  auto turned = views;
  turned[5].projection.row(0) *= -1.0; // mirrored: it sees the object nowhere near
  turned[5].projection.row(0) += 900.0 * turned[5].projection.row(2);
  const std::string message = carveMessage(turned, 5, 0);
  EXPECT_NE(message.find("something would be left without view 5 (v5)"), std::string::npos) << message;
}

/** A rod that one view of two along each axis sees elsewhere: coarse octants hold both places, and would survive without any one view as well as with all. */
TEST(Carving, NothingSurvivesNamesNoViewForWhatIsOnlyCoarse)
{
  constexpr int Size = 300;
  const auto cameras = axisCameras(100.0, Size);
  std::vector<View> views;
  for (int n = 0; n < 6; ++n)
  {
    BinaryImage image{ Size, Size, std::vector<std::uint8_t>(Size * Size, 0) };
    const int first = n == 4 ? 154 : 151, side = 2;
    for (int row = 151; row < 151 + side; ++row)
    {
      std::fill(&image.at(first, row), &image.at(first, row) + side, std::uint8_t(1));
    }
    views.push_back({ "v" + std::to_string(n), cameras[std::size_t(n % 3)], image });
  }
  EXPECT_GT(survivorsOf(carveViews(prepareViews(views), unitCube(), 5)), 0u);
  const std::string message = carveMessage(views, 8, 0);
  EXPECT_NE(message.find("something would be left without view 4 (v4). Check"), std::string::npos) << message;
  for (std::size_t n = 0; n < views.size(); ++n) // and it is true
  {
    auto others = views;
    others.erase(others.begin() + std::ptrdiff_t(n));
    EXPECT_EQ(carveMessage(others, 8, 0).empty(), n == 4) << n;
  }
}

TEST(Carving, StopsWhenAskedAndReportsMonotoneProgress)
{
  const PreparedViews prepared = prepareViews(torusViews());
  const LatticeViews views(prepared, { unitCube(), 6 });
  CancelledExecution cancelled;
  EXPECT_THROW(carve(views, CarveOptions(), cancelled), Cancelled);
  ProgressExecution progress;
  carve(views, CarveOptions(), progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}

TEST(Carving, ToleratesDissentingViews)
{
  auto views = torusViews();
  std::fill(views[2].silhouette.pixels.begin(), views[2].silhouette.pixels.end(), std::uint8_t(0));
  const PreparedViews prepared = prepareViews(views);
  EXPECT_THROW(carveViews(prepared, unitCube(), 5, 0), NothingSurvives);
  EXPECT_GT(survivorsOf(carveViews(prepared, unitCube(), 5, 1)), 100u);
}
