// SPDX-License-Identifier: BSD-3-Clause
#include "UncoveredShare.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 400;
constexpr double Scale = 160.0; ///< pixels a unit; leaves of 1/16 are 10 pixels wide

/** A rod of 1.6 x 0.6 x 0.6 from three affine views along the axes; `size` pixels a side of the images. */
std::vector<View> rodViews()
{
  return viewsOf(boxMesh({ -0.8, -0.3, -0.3 }, { 0.8, 0.3, 0.3 }), axisCameras(Scale, Size), Size);
}

/** Background in the columns of a view that show x (for the view along z) from `from` to `to`. */
void cut(View& view, double from, double to)
{
  const double centre = 0.5 * (Size - 1);
  for (int row = 0; row < Size; ++row)
  {
    for (int column = int(std::ceil(centre + Scale * from)); column <= int(centre + Scale * to); ++column)
    {
      view.silhouette.at(column, row) = 0;
    }
  }
}

std::vector<double> measure(
  const std::vector<View>& carved, const std::vector<View>& asked, const UncoveredShareOptions& options = {})
{
  Execution execution;
  return uncoveredShares(carveViews(prepareViews(carved), unitCube(1.0), 5), prepareViews(asked), options, execution);
}

} // namespace

TEST(UncoveredShare, NothingOfAnObjectThatSurvivesWhole)
{
  for (const double share : measure(rodViews(), rodViews()))
  {
    EXPECT_EQ(share, 0.0);
  }
  const auto torus = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 200), 200);
  Execution execution;
  for (const int k : { 0, 1 })
  {
    const PreparedViews views = prepareViews(torus);
    for (const double share : uncoveredShares(carveViews(views, unitCube(), 6, k), views, {}, execution))
    {
      EXPECT_EQ(share, 0.0);
    }
  }
}

TEST(UncoveredShare, IsTheShareThatOneViewCutAway)
{
  // View 2 looks along z and has x along its rows: it cuts the rod from x = 0 to 0.4, a quarter of its
  // length.
  auto views = rodViews();
  cut(views[2], 0.0, 0.4);
  UncoveredShareOptions exact;
  exact.reach = 0.0;
  const auto shares = measure(views, rodViews(), exact);
  EXPECT_EQ(shares[0], 0.0) << "along x the rod's ends hide the gap";
  // The survivors reach into the gap by up to an octant, 1/16, from either side.
  for (const int view : { 1, 2 })
  {
    EXPECT_LT(shares[view], 0.4 / 1.6 + 0.01);
    EXPECT_GT(shares[view], (0.4 - 2.0 / 16.0) / 1.6 - 0.01);
  }
  const auto reached = measure(views, rodViews());
  EXPECT_NEAR(reached[1], shares[1] - 2.0 / 16.0 / 1.6, 0.01) << "an octant more from either side";
  exact.reach = 4.0;
  EXPECT_EQ(measure(views, rodViews(), exact)[1], 0.0);
}

TEST(UncoveredShare, SpecksAreNotTheObject)
{
  auto views = rodViews();
  const double salt = 1.0 / double(prepareViews(views)[1].objectPixels(0, Size, 0, Size));
  for (int n = 0; n < 9; ++n)
  {
    views[1].silhouette.at(10 + 3 * (n % 3), 10 + 3 * (n / 3)) = 1; // far from the rod
  }
  EXPECT_EQ(measure(rodViews(), views)[1], 0.0);
  UncoveredShareOptions all;
  all.speckArea = 0.0;
  EXPECT_EQ(measure(rodViews(), views, all)[1], 0.0) << "four pixels at least";
  views[1].silhouette.at(30, 10) = views[1].silhouette.at(31, 11) = 1; // joined through corners
  views[1].silhouette.at(30, 12) = views[1].silhouette.at(29, 11) = 1;
  EXPECT_EQ(measure(rodViews(), views)[1], 0.0);
  EXPECT_NEAR(measure(rodViews(), views, all)[1], 4 * salt, 0.01 * salt);
  for (int n = 0; n < 121; ++n)
  {
    views[1].silhouette.at(10 + n % 11, 10 + n / 11) = 1; // more than an octant, 10 x 10
  }
  EXPECT_NEAR(measure(rodViews(), views)[1], 121 * salt, 2 * salt);
}

TEST(UncoveredShare, CoarseOctantsCoverToo)
{
  // Leaves alone would leave the middle of a large silhouette open.
  const auto views = viewsOf(boxMesh(-0.9, 0.9), axisCameras(Scale, Size), Size);
  Execution execution;
  const PreparedViews prepared = prepareViews(views);
  const Octree octree = carveViews(prepared, unitCube(1.0), 6);
  ASSERT_GT(octree.count(OctantState::Inside, 3), 0u);
  UncoveredShareOptions exact;
  exact.reach = 0.0;
  exact.speckArea = 0.0;
  for (const double share : uncoveredShares(octree, prepared, exact, execution))
  {
    EXPECT_EQ(share, 0.0);
  }
  Octree hollow = octree;
  for (int g = 0; g < 6; ++g)
  {
    for (auto& state : hollow.generations[g].state)
    {
      state = state == OctantState::Inside ? OctantState::Background : state;
    }
  }
  for (auto& state : hollow.generations[6].state)
  {
    state = OctantState::Background;
  }
  for (const double share : uncoveredShares(hollow, prepared, exact, execution))
  {
    EXPECT_EQ(share, 1.0);
  }
}

TEST(UncoveredShare, ViewsThatSeeNothingSayNothing)
{
  auto views = rodViews();
  View behind = views[0];
  behind.projection = lookAtOrigin({ 5.0, 0.0, 0.0 }, 300.0, Size);
  behind.projection.row(2) *= -1.0;
  behind.projection.topRows<2>() *= -1.0;
  View empty = views[0];
  std::fill(empty.silhouette.pixels.begin(), empty.silhouette.pixels.end(), std::uint8_t(0));
  views.push_back(behind);
  views.push_back(empty);
  Execution execution;
  const PreparedViews prepared = prepareViews(views);
  const auto shares = uncoveredShares(carveViews(prepared, unitCube(1.0), 5, 1), prepared, {}, execution);
  EXPECT_EQ(shares[3], 0.0);
  EXPECT_EQ(shares[4], 0.0);
}

TEST(UncoveredShare, PixelsPerOctantAreThoseOfTheScale)
{
  auto views = rodViews();
  EXPECT_NEAR(pixelsPerOctant(prepareViews(views), { unitCube(1.0), 5 }), Scale / 16.0, 1e-9);
  for (View& view : views)
  {
    view.projection.row(2) *= -1.0; // behind the camera
  }
  EXPECT_EQ(pixelsPerOctant(prepareViews(views), { unitCube(1.0), 5 }), 0.0);
}

TEST(UncoveredShare, RefusesWhatDoesNotFit)
{
  Execution execution;
  const PreparedViews views = prepareViews(rodViews());
  const Octree octree = carveViews(views, unitCube(1.0), 4);
  const auto refused = [&](const PreparedViews& of, const UncoveredShareOptions& options, const std::string& text)
  {
    try
    {
      uncoveredShares(octree, of, options, execution);
      FAIL() << text;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  UncoveredShareOptions options;
  options.reach = -1.0;
  refused(views, options, "reach -1 is outside 0 to 1000000000");
  options = {};
  options.speckArea = std::nan("");
  refused(views, options, "speck area");
  auto fewer = rodViews();
  fewer.pop_back();
  refused(prepareViews(fewer), {}, "carved from 3 views, not from 2");
  EXPECT_EQ(uncoveredShares(Octree{ {}, 0, 3, 0, OutsidePolicy::Border, 0, {}, {}, {}, {} }, views, {}, execution),
    std::vector<double>(3, 0.0));
}
