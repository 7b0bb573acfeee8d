// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteSpeckles.h"

#include "CarvingTestCaptures.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 160;
constexpr int Depth = 5;

/** A torus whose masks have so many of their pixels flipped. */
struct Scene
{
  explicit Scene(double pixels)
  {
    Execution execution;
    SyntheticShapeOptions coarse;
    coarse.refinement = 0.5;
    SyntheticCaptureOptions options;
    options.photographs = false;
    options.views = 24;
    options.width = options.height = Size;
    options.noisePixels = pixels;
    options.seed = 2;
    this->capture = synthesizeCapture(syntheticShape(SyntheticShape::Torus, coarse), options, execution);
    std::vector<View> views;
    for (const auto& view : this->capture.views)
    {
      views.push_back({ view.name, view.projection, view.mask });
    }
    this->prepared = prepareViews(views);
  }

  std::optional<PreparedViews> clean(const SilhouetteRepairOptions& options, std::vector<std::uint64_t>& flipped) const
  {
    Execution execution;
    const Octree octree = carveViews(this->prepared, unitCube(1.0), Depth);
    const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
    return withoutSpeckles(
      LatticeViews(this->prepared, octree.lattice), boxOfSurvivors(shell), options, flipped, execution);
  }

  std::uint64_t wrong(const PreparedViews& views, int i) const
  {
    const auto& pixels = this->capture.views[i].cleanMask.pixels;
    return std::inner_product(pixels.begin(), pixels.end(), views[i].silhouette(), std::uint64_t(0), std::plus<>(),
      std::not_equal_to<>());
  }

  SyntheticCapture capture;
  PreparedViews prepared;
};

} // namespace

TEST(SilhouetteSpeckles, FlippedPixelsAreFlippedBack)
{
  const Scene scene(0.005);
  std::vector<std::uint64_t> flipped;
  const auto cleaned = scene.clean({}, flipped);
  ASSERT_TRUE(cleaned);
  ASSERT_EQ(int(flipped.size()), cleaned->size());
  std::uint64_t before = 0, after = 0;
  for (int i = 0; i < cleaned->size(); ++i)
  {
    before += scene.wrong(scene.prepared, i);
    after += scene.wrong(*cleaned, i);
    const std::uint8_t *was = scene.prepared[i].silhouette(), *is = (*cleaned)[i].silhouette();
    EXPECT_EQ(flipped[i],
      std::inner_product(was, was + Size * Size, is, std::uint64_t(0), std::plus<>(), std::not_equal_to<>())) << i;
  }
  EXPECT_GT(before, 2500u);
  EXPECT_LT(10 * after, before); // those at the contour stay
}

TEST(SilhouetteSpeckles, CleanSilhouettesAndFewSpecklesAreLeftAlone)
{
  std::vector<std::uint64_t> flipped;
  EXPECT_FALSE(Scene(0.0).clean({}, flipped));
  SilhouetteRepairOptions options;
  options.speckleShare = 0.1;
  EXPECT_FALSE(Scene(0.005).clean(options, flipped));
  EXPECT_TRUE(flipped.empty());
}

/** A pixel is always one; more than one only up to the area. */
TEST(SilhouetteSpeckles, ASmallerAreaTakesFewer)
{
  const Scene scene(0.02);
  SilhouetteRepairOptions options;
  std::vector<std::uint64_t> all, some;
  ASSERT_TRUE(scene.clean(options, all));
  options.speckleArea = 0.0;
  ASSERT_TRUE(scene.clean(options, some));
  const auto sum = [](const std::vector<std::uint64_t>& counts)
  { return std::accumulate(counts.begin(), counts.end(), std::uint64_t(0)); };
  EXPECT_GT(sum(some), 0u);
  EXPECT_LT(sum(some), sum(all));
}
