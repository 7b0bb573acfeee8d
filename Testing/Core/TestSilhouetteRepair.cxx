// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRepair.h"

#include "AutomaticBounds.h"
#include "CarvingTestCaptures.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 384;

class Threads : public Execution
{
public:
  explicit Threads(int count) : Count(count) {}
  void forRanges(std::size_t count, std::size_t, const Range& work) override
  {
    std::vector<std::thread> threads;
    for (int t = 0; t < this->Count; ++t)
    {
      threads.emplace_back([=, &work] { work(count * t / this->Count, count * (t + 1) / this->Count); });
    }
    for (auto& thread : threads)
    {
      thread.join();
    }
  }

private:
  int Count;
};

class CancelledAt : public Execution
{
public:
  explicit CancelledAt(int calls) : Left(calls) {}
  bool cancelled() const override { return --this->Left < 0; }
  mutable int Left;
};

/** A capture of a shape, rendered once; its views before and after noise. */
class Capture
{
public:
  explicit Capture(SyntheticShape shape, int size = Size) : Truth(syntheticShape(shape))
  {
    this->Options.photographs = false;
    this->Options.width = this->Options.height = size;
    Execution execution;
    this->Views = synthesizeCapture(this->Truth, this->Options, execution);
  }
  std::vector<View> views(int blobs, double contour, double pixels, double camera, std::uint64_t seed)
  {
    Execution execution;
    auto options = this->Options;
    options.noiseBlobs = blobs;
    options.noiseContour = contour;
    options.noisePixels = pixels;
    options.noiseCamera = camera;
    options.seed = seed;
    redrawNoise(this->Views, this->Truth, options, execution);
    std::vector<View> noisy;
    for (const auto& view : this->Views.views)
    {
      noisy.push_back({view.name, view.projection, view.mask});
    }
    return noisy;
  }
  /** Pixels that are not the clean masks'. */
  std::uint64_t wrong(const PreparedViews& views) const
  {
    std::uint64_t count = 0;
    for (int i = 0; i < views.size(); ++i)
    {
      const auto& clean = this->Views.views[i].cleanMask.pixels;
      for (std::size_t p = 0; p < clean.size(); ++p)
      {
        count += clean[p] != views[i].object[p];
      }
    }
    return count;
  }

private:
  Mesh Truth;
  SyntheticCaptureOptions Options;
  SyntheticCapture Views;
};

SilhouetteRepair repair(const PreparedViews& views, int depth, Execution& execution,
                        const SilhouetteRepairOptions& options = {})
{
  Execution alone;
  const Octree octree = carveViews(views, unitCube(1.0), depth);
  const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), alone);
  return repairSilhouettes(octree, shell, views, options, execution);
}

Capture& torus()
{
  static Capture capture(SyntheticShape::Torus);
  return capture;
}

void paintDisc(BinaryImage& image, const HomogeneousPixel& centre, double radius)
{
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      if (std::hypot(column - centre.U / centre.W, row - centre.V / centre.W) <= radius)
      {
        image.at(column, row) = 0;
      }
    }
  }
}

} // namespace

TEST(SilhouetteRepair, FillsTheDiscsThatAreCutOutOfAFewMasks)
{
  Execution execution;
  for (const std::uint64_t seed : {1, 2, 3})
  {
    const PreparedViews views = prepareViews(torus().views(3, 0, 0, 0, seed));
    const auto before = torus().wrong(views);
    const auto result = repair(views, 7, execution);
    ASSERT_TRUE(result.views);
    EXPECT_GT(before, 500u);
    // What is left are discs that cross the contour: the solid is thin behind them, the chord short.
    EXPECT_LE(torus().wrong(*result.views), before / 3) << "seed " << seed << " of " << before;
    for (int i = 0; i < views.size(); ++i)
    {
      EXPECT_EQ(result.views->operator[](i).name, views[i].name);
      EXPECT_EQ(result.views->operator[](i).projection, views[i].projection);
      EXPECT_EQ(result.blobs[i] > 0, result.views->operator[](i).object != views[i].object);
    }
  }
}

TEST(SilhouetteRepair, LeavesCleanMasksAndOtherNoiseAlone)
{
  Execution execution;
  const double scale = 256 / 1024.0;
  for (const SyntheticShape shape : {SyntheticShape::Torus, SyntheticShape::Jug, SyntheticShape::Sphere,
                                     SyntheticShape::Twig, SyntheticShape::Pebble, SyntheticShape::Pumpkin})
  {
    Capture capture(shape, 256);
    for (const int kind : {0, 1, 2})
    {
      const auto noisy = capture.views(0, kind == 1 ? 4 * scale : 0, 0, kind == 2 ? 2 * scale : 0, 1);
      try
      {
        EXPECT_FALSE(repair(prepareViews(noisy), 6, execution).views)
            << "shape " << int(shape) << " noise " << kind;
      }
      catch (const NothingSurvives&)
      {
        EXPECT_EQ(shape, SyntheticShape::Twig); // thinner than the noise
      }
    }
  }
}

TEST(SilhouetteRepair, LeavesFewViewsAlone)
{
  Execution execution;
  const Mesh mesh = torusMesh(48, 24, 0.6, 0.25);
  for (const int count : {1, 2, 3, 4, 6, 9, 13})
  {
    const PreparedViews views = prepareViews(viewsOf(mesh, swayingRing(count, 200), 200));
    EXPECT_FALSE(repair(views, 6, execution).views) << count << " views";
  }
}

TEST(SilhouetteRepair, FlipsSaltAndPepper)
{
  Execution execution;
  for (const double share : {0.001, 0.01})
  {
    const PreparedViews views = prepareViews(torus().views(0, 0, share, 0, 5));
    const auto before = torus().wrong(views);
    const auto result = repair(views, 6, execution);
    ASSERT_TRUE(result.views);
    EXPECT_LE(torus().wrong(*result.views), before / 20)
        << before; // what touches a contour, and thick clusters
  }
}

TEST(SilhouetteRepair, FillsBlobsThatCrossInTheSolid)
{
  Execution execution;
  const Mesh mesh = sphereMesh(4, 0.9);
  const auto clean = viewsOf(mesh, swayingRing(24, 300), 300);
  auto views = clean;
  for (const int i : {2, 7})
  {
    const Vector3 h = views[i].projection * Eigen::Vector4d(0.1, 0.1, 0.1, 1.0);
    paintDisc(views[i].silhouette, {h[0], h[1], h[2]}, 8.0);
  }
  const auto result = repair(prepareViews(views), 6, execution);
  ASSERT_TRUE(result.views);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    EXPECT_EQ(result.views->operator[](int(i)).object, clean[i].silhouette.pixels) << "view " << i;
  }
}

/** A mask that lacks half of the object, as the solid that it alone rejects, is filled like any other blob. */
TEST(SilhouetteRepair, FillsHalfOfAMask)
{
  const Mesh mesh = sphereMesh(4, 0.9);
  const auto clean = viewsOf(mesh, swayingRing(24, 300), 300);
  auto views = clean;
  BinaryImage& half = views[5].silhouette;
  for (int row = 0; row < half.height; ++row)
  {
    std::fill(&half.at(150, row), &half.at(half.width - 1, row) + 1, std::uint8_t(0));
  }
  Execution execution;
  ThreadedExecution threads(3);
  for (const int depth : {5, 6, 7})
  {
    const auto result = repair(prepareViews(views), depth, depth == 6 ? threads : execution);
    ASSERT_TRUE(result.views);
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const auto& repaired = result.views->operator[](int(i)).object;
      for (std::size_t p = 0; p < repaired.size(); ++p)
      {
        wrong += repaired[p] != clean[i].silhouette.pixels[p];
      }
      EXPECT_EQ(result.blobs[i] > 0, i == 5);
    }
    EXPECT_GT(result.blobs[5], 10000u);
    // The hull of the other views is a little larger than the ball.
    EXPECT_LE(wrong, result.blobs[5] / 50) << "depth " << depth << " of " << result.blobs[5];
  }
}

TEST(SilhouetteRepair, IsTheSameForAnyNumberOfThreads)
{
  Execution execution;
  const PreparedViews views = prepareViews(torus().views(2, 0, 0.001, 0, 3));
  const auto expected = repair(views, 6, execution);
  ASSERT_TRUE(expected.views);
  for (const int count : {2, 8})
  {
    Threads threads(count);
    const auto result = repair(views, 6, threads);
    ASSERT_TRUE(result.views);
    EXPECT_EQ(result.views->fingerprint(), expected.views->fingerprint());
    EXPECT_EQ(result.blobs, expected.blobs);
    EXPECT_EQ(result.speckles, expected.speckles);
  }
}

TEST(SilhouetteRepair, RejectsOptionsOutOfRangeAndCanBeCancelled)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(2, 0.9), swayingRing(9, 60), 60));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1.0, nan})
  {
    for (const auto member : {&SilhouetteRepairOptions::speckleArea, &SilhouetteRepairOptions::speckleShare,
                              &SilhouetteRepairOptions::blobDepth, &SilhouetteRepairOptions::blobChord})
    {
      SilhouetteRepairOptions options;
      options.*member = bad;
      EXPECT_THROW(repair(views, 4, execution, options), InvalidInput);
    }
  }
  SilhouetteRepairOptions options;
  options.blobCorners = 0;
  EXPECT_THROW(repair(views, 4, execution, options), InvalidInput);
  for (const int calls : {0, 1, 2})
  {
    CancelledAt cancelled(calls);
    EXPECT_THROW(repair(views, 4, cancelled), Cancelled) << calls;
  }
  const PreparedViews one = prepareViews(viewsOf(sphereMesh(2, 0.9), swayingRing(9, 60), 60));
  const auto result = repairSilhouettes(carveViews(one, unitCube(), 4), CornerShell(), one, {}, execution);
  EXPECT_FALSE(result.views);
  EXPECT_EQ(result.blobs.size(), 9u);
}
