// SPDX-License-Identifier: BSD-3-Clause
#include "ViewingCones.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

TEST(ViewingCones, TheNearestPointToRaysIsTheirCommonPoint)
{
  const Vector3 point(0.3, -0.2, 0.1);
  std::vector<Projection> projections = swayingRing(7, 100);
  std::vector<Vector2> pixels;
  double factor = -3.0;
  for (auto& P : projections)
  {
    const Vector3 h = P * point.homogeneous();
    pixels.emplace_back(h.x() / h.z(), h.y() / h.z());
    P *= factor; // neither scale nor sign counts
    factor *= -1.7;
  }
  EXPECT_LT((nearestPointToRays(projections, pixels) - point).norm(), 1e-9);
  EXPECT_THROW(nearestPointToRays(projections, {}), InvalidInput);
}

TEST(ViewingCones, HoldTheObjectAndLittleMore)
{
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(4, 0.9), swayingRing(12, 200), 200));
  const Box box = intersectViewingCones(views, 0);
  EXPECT_TRUE(box.contains(Box(Vector3::Constant(-0.9), Vector3::Constant(0.9))));
  EXPECT_LT(box.sizes().maxCoeff(), 4.0);
}

TEST(ViewingCones, ConesThatDoNotMeetNameTheViewAtFault)
{
  auto views = viewsOf(sphereMesh(4, 0.9), swayingRing(12, 200), 200);
  views[3].projection.row(0) += 1000.0 * views[3].projection.row(2);
  try
  {
    intersectViewingCones(prepareViews(views), 0);
    FAIL();
  }
  catch (const NothingSurvives& error)
  {
    EXPECT_NE(std::string(error.what()).find("something would be left without view 3 (v3)."), std::string::npos)
      << error.what();
  }
  EXPECT_FALSE(intersectViewingCones(prepareViews(views), 1).isEmpty());
  std::fill(views[5].silhouette.pixels.begin(), views[5].silhouette.pixels.end(), std::uint8_t(0));
  try
  {
    intersectViewingCones(prepareViews(views), 0);
    FAIL();
  }
  catch (const NothingSurvives& error)
  {
    EXPECT_NE(std::string(error.what()).find("silhouette of view 5 (v5) is empty"), std::string::npos);
  }
}

/** Specks at every side open every side; then the images' frames bound the object. */
TEST(ViewingCones, FramesBoundWhatAbstainsOnEverySide)
{
  auto views = viewsOf(sphereMesh(4, 0.9), swayingRing(12, 200), 200);
  Random random(1);
  disturb(views, 1, random);
  const Box box = intersectViewingCones(prepareViews(views), 0);
  EXPECT_TRUE(box.contains(Box(Vector3::Constant(-0.9), Vector3::Constant(0.9))));
  EXPECT_LT(box.sizes().maxCoeff(), 8.0);
}

TEST(ViewingCones, CentroidIsTheMeanOfTheObjectsPixels)
{
  EXPECT_EQ(silhouetteCentroid({ 3, 2, { 0, 1, 1, 0, 0, 1 } }), Vector2(5.0 / 3.0, 1.0 / 3.0));
  EXPECT_EQ(silhouetteCentroid({ 3, 2, { 0, 0, 0, 0, 0, 0 } }), Vector2(1.0, 0.5));
}
