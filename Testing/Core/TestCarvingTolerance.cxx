// SPDX-License-Identifier: BSD-3-Clause
#include "CarvingTolerance.h"

#include "CarvingTestCaptures.h"
#include "LatticeRegions.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 240;
constexpr int Count = 20; ///< two background votes are a tenth

/** A thin upright rod on a slab. */
std::vector<View> rodOnSlab()
{
  const Mesh mesh =
    joined(boxMesh({ -0.8, -0.8, -0.9 }, { 0.8, 0.8, -0.5 }), boxMesh({ -0.06, -0.06, -0.4 }, { 0.06, 0.06, 1.0 }));
  return viewsOf(mesh, swayingRing(Count, Size), Size);
}

/** Cut the rod out of the first `count` views: background in the rows of the image's middle. */
std::vector<View> cutRod(int count)
{
  auto views = rodOnSlab();
  for (int i = 0; i < count; ++i)
  {
    for (int row = Size / 2 - 25; row < Size / 2 + 5; ++row)
    {
      std::fill_n(&views[i].silhouette.at(0, row), Size, std::uint8_t(0));
    }
  }
  return views;
}

Carve inUnitCube()
{
  return [](const PreparedViews& views, int k, Execution&) { return carveViews(views, unitCube(), 6, k); };
}

TolerantCarving tolerant(const std::vector<View>& views, const CarvingToleranceOptions& options = {})
{
  Execution execution;
  return carveTolerantly(std::make_shared<const PreparedViews>(prepareViews(views)), inUnitCube(), options, execution);
}

} // namespace

TEST(CarvingTolerance, CleanSilhouettesAreCarvedStrictlyAndOnce)
{
  const TolerantCarving carving = tolerant(rodOnSlab());
  EXPECT_EQ(carving.octree.backgroundVotes, 0);
  EXPECT_EQ(carving.dilation, 0);
  EXPECT_EQ(carving.carves, 1);
  EXPECT_EQ(carving.uncovered, 0.0);
  EXPECT_EQ(carving.strictUncovered, 0.0);
  EXPECT_TRUE(carving.dilatedViews.empty());
  EXPECT_TRUE(sameOctants(carving.octree, carveViews(prepareViews(rodOnSlab()), unitCube(), 6)));
}

TEST(CarvingTolerance, WhatNoiseTakesOffAllRoundIsLeftToTheSurface)
{
  // Every other silhouette is ten pixels, three octants, too large: these lack a skin, and no part.
  auto views = viewsOf(boxMesh({ -0.8, -0.8, -0.9 }, { 0.8, 0.8, -0.5 }), swayingRing(Count, Size), Size);
  Execution execution;
  const auto larger = dilatedSilhouettes(prepareViews(views), 10, execution);
  for (std::size_t i = 0; i < views.size(); i += 2)
  {
    views[i] = larger[i];
  }
  CarvingToleranceOptions options;
  const TolerantCarving carving = tolerant(views, options);
  EXPECT_EQ(carving.carves, 1);
  EXPECT_EQ(carving.octree.backgroundVotes, 0);
  options.measure.bridged = 0.0; // a skin is lost, too
  EXPECT_GT(tolerant(views, options).strictUncovered, options.uncoveredShare);
}

TEST(CarvingTolerance, NoisyContoursAndWrongCamerasTakeNoVotesFromASolid)
{
  SyntheticCaptureOptions contours, cameras;
  contours.width = contours.height = cameras.width = cameras.height = 384;
  contours.noiseContour = 3.0;
  cameras.noiseCamera = 3.0;
  contours.photographs = cameras.photographs = false;
  for (const auto& noise : { contours, cameras })
  {
    Execution execution;
    std::vector<View> views;
    for (const SyntheticView& view : synthesizeCapture(syntheticShape(SyntheticShape::Jug), noise, execution).views)
    {
      views.push_back({ view.name, view.projection, view.mask });
    }
    const auto prepared = std::make_shared<const PreparedViews>(prepareViews(views));
    const Carve carve = [](const PreparedViews& some, int k, Execution&) { return carveViews(some, unitCube(), 7, k); };
    CarvingToleranceOptions options;
    EXPECT_EQ(carveTolerantly(prepared, carve, options, execution).octree.backgroundVotes, 0);
    options.measure.bridged = 0.0; // as if all that is uncovered were lost
    EXPECT_GT(carveTolerantly(prepared, carve, options, execution).octree.backgroundVotes, 0);
  }
}

TEST(CarvingTolerance, AsManyVotesAsViewsCutARodAreTheLeastThatBringItBack)
{
  for (const int views : { 1, 2 })
  {
    const TolerantCarving carving = tolerant(cutRod(views));
    EXPECT_EQ(carving.octree.backgroundVotes, views);
    EXPECT_EQ(carving.dilation, 0);
    EXPECT_GT(carving.strictUncovered, CarvingToleranceOptions().uncoveredShare);
    EXPECT_LE(carving.uncovered, CarvingToleranceOptions().uncoveredShare);
    EXPECT_EQ(carving.views->fingerprint(), carving.octree.fingerprint);
  }
}

TEST(CarvingTolerance, TheLeastIsFoundAmongMany)
{
  CarvingToleranceOptions options;
  options.voteShare = 0.9;
  options.greatestDilation = 0;
  for (const int views : { 3, 6 })
  {
    const TolerantCarving carving = tolerant(cutRod(views), options);
    const int k = carving.octree.backgroundVotes;
    EXPECT_LE(k, views);
    EXPECT_LE(carving.uncovered, options.uncoveredShare);
    options.backgroundVotes = k - 1;
    EXPECT_GT(tolerant(cutRod(views), options).strictUncovered, options.uncoveredShare) << "one less is too few";
    options.backgroundVotes = 0;
  }
}

TEST(CarvingTolerance, DilationBringsTogetherWhatMatricesTookApart)
{
  // Half of the views are shifted to one side, half to the other, by more than the rod is wide: no two votes
  // do it.
  auto views = rodOnSlab();
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
    shift(0, 2) = i % 2 ? 8.5 : -8.5;
    views[i].projection = shift * views[i].projection;
  }
  CarvingToleranceOptions options;
  options.greatestDilation = 4.0;
  const TolerantCarving carving = tolerant(views, options);
  EXPECT_EQ(carving.octree.backgroundVotes, 2);
  EXPECT_GT(carving.dilation, 0);
  EXPECT_LE(carving.uncovered, options.uncoveredShare);
  ASSERT_EQ(carving.dilatedViews.size(), views.size());
  Execution execution;
  EXPECT_EQ(PreparedViews(carving.dilatedViews, ViewOptions(), execution).fingerprint(), carving.octree.fingerprint);
  options.greatestDilation =
    (carving.dilation - 0.5) / pixelsPerOctant(prepareViews(views), carving.octree.lattice);
  EXPECT_GT(tolerant(views, options).uncovered, options.uncoveredShare) << "a pixel less is too little";
}

TEST(CarvingTolerance, WhatNothingRemediesStaysStrict)
{
  // More views than votes may outweigh.
  CarvingToleranceOptions options;
  options.greatestDilation = 0;
  const TolerantCarving carving = tolerant(cutRod(12), options);
  EXPECT_GT(carving.uncovered, options.uncoveredShare);
  EXPECT_EQ(carving.octree.backgroundVotes, 0);
  EXPECT_EQ(carving.dilation, 0);
  EXPECT_EQ(carving.uncovered, carving.strictUncovered);
  EXPECT_EQ(carving.carves, 3) << "none, one and two votes";
}

TEST(CarvingTolerance, TooManyVotesToBoundTheObjectAreTooMany)
{
  Execution execution;
  const auto views = std::make_shared<const PreparedViews>(prepareViews(cutRod(1)));
  const Carve carve = [](const PreparedViews& prepared, int k, Execution&)
  {
    if (k > 0)
    {
      throw UnboundedObject("no bounds");
    }
    return carveViews(prepared, unitCube(), 6, k);
  };
  EXPECT_EQ(carveTolerantly(views, carve, {}, execution).octree.backgroundVotes, 0);
  const Carve never = [](const PreparedViews&, int, Execution&) -> Octree { throw NothingSurvives("nothing"); };
  EXPECT_THROW(carveTolerantly(views, never, {}, execution), NothingSurvives);
}

TEST(CarvingTolerance, TheLeastCoveredViewIsNamed)
{
  Execution execution;
  auto views = rodOnSlab();
  CarvingToleranceOptions strict;
  strict.voteShare = 0.0;
  strict.greatestDilation = 0.0;
  auto& pixels = views[3].silhouette;
  for (int row = 0; row < pixels.height / 2; ++row)
  {
    std::fill_n(pixels.pixels.begin() + row * pixels.width, pixels.width, std::uint8_t(1)); // what no other view has there
  }
  const TolerantCarving carving = tolerant(views, strict);
  const auto shares = uncoveredShares(carving.octree, prepareViews(views), {}, execution);
  EXPECT_EQ(carving.leastCoveredView, 3);
  EXPECT_EQ(carving.greatestUncovered, *std::max_element(shares.begin(), shares.end()));
  EXPECT_GT(carving.greatestUncovered, carving.uncovered);
}

TEST(CarvingTolerance, OfWhichNothingSurvivesStrictly)
{
  Execution execution;
  auto views = rodOnSlab();
  std::fill(views[3].silhouette.pixels.begin(), views[3].silhouette.pixels.end(), std::uint8_t(0));
  views[3].silhouette.at(2, 2) = 1; // what no other view has there
  EXPECT_THROW(carveViews(prepareViews(views), unitCube(), 6, 0), NothingSurvives);
  const TolerantCarving carving = tolerant(views);
  EXPECT_EQ(carving.octree.backgroundVotes, 1);
  EXPECT_EQ(carving.strictUncovered, 1.0);
  EXPECT_LT(carving.uncovered, 0.001) << "the one pixel is a speck";

  // What is empty is not noisy.
  views[3].silhouette.at(2, 2) = 0;
  EXPECT_THROW(tolerant(views), NothingSurvives);
  CarvingToleranceOptions strict;
  strict.voteShare = 0.0;
  strict.greatestDilation = 0.0;
  views[3].silhouette.at(2, 2) = 1;
  EXPECT_THROW(tolerant(views, strict), NothingSurvives);
}

TEST(CarvingTolerance, DilationIsADiscAboutEachPixel)
{
  Random random(5);
  View view{ "v", axisCameras(10.0, 61)[0], { 61, 47, std::vector<std::uint8_t>(61 * 47, 0) } };
  for (int n = 0; n < 40; ++n)
  {
    view.silhouette.at(random.below(61), random.below(47)) = 1;
  }
  Execution execution;
  for (const int radius : { 0, 1, 2, 5 })
  {
    const auto dilated = dilatedSilhouettes(prepareViews({ view }), radius, execution);
    ASSERT_EQ(dilated.size(), 1u);
    for (int row = 0; row < 47; ++row)
    {
      for (int column = 0; column < 61; ++column)
      {
        bool near = false;
        for (int i = 0; i < 61 * 47; ++i)
        {
          near |= view.silhouette.pixels[i] && std::hypot(i % 61 - column, i / 61 - row) <= radius + 0.5;
        }
        ASSERT_EQ(dilated[0].silhouette.at(column, row) != 0, near) << radius << ": " << column << ", " << row;
      }
    }
  }
}

TEST(CarvingTolerance, RefusesOptionsOutOfRange)
{
  const auto refused = [](const CarvingToleranceOptions& options, const std::string& text)
  {
    try
    {
      tolerant(rodOnSlab(), options);
      FAIL() << text;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  CarvingToleranceOptions options;
  options.backgroundVotes = Count;
  refused(options, "background votes 20 are outside 0 to 19");
  options = {};
  options.uncoveredShare = std::numeric_limits<double>::quiet_NaN();
  refused(options, "uncovered share nan is outside 0 to 1");
  options = {};
  options.voteShare = 1.0;
  refused(options, "share of the views 1 is outside 0 to below 1");
  options = {};
  options.greatestDilation = 10.5;
  refused(options, "dilation in octants 10.5 is outside 0 to 10");
}

TEST(CarvingTolerance, CanBeCancelledAndTellsProgressThatNeverFalls)
{
  struct Listening : Execution
  {
    double last = 0.0;
    double stopAt = 2.0;
    bool fell = false;
    bool cancelled() const override { return this->last >= this->stopAt; }
    void progress(double fraction) override
    {
      this->fell |= fraction < this->last;
      this->last = fraction;
    }
  };
  const auto views = std::make_shared<const PreparedViews>(prepareViews(cutRod(2)));
  for (const double stop : { 2.0, 0.0, 0.45, 0.7 })
  {
    Listening execution;
    execution.stopAt = stop;
    if (stop > 1.0)
    {
      carveTolerantly(views, inUnitCube(), {}, execution);
      EXPECT_EQ(execution.last, 1.0);
    }
    else
    {
      EXPECT_THROW(carveTolerantly(views, inUnitCube(), {}, execution), Cancelled) << stop;
    }
    EXPECT_FALSE(execution.fell);
  }
}
