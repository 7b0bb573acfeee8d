// SPDX-License-Identifier: BSD-3-Clause
#include "PreparedViews.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <limits>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

View randomView(Random& random, int width, int height)
{
  View view;
  view.name = "a.png";
  view.projection = lookAtOrigin({ 5, 1, 1 }, 20, 20);
  view.silhouette = { width, height, {} };
  for (int i = 0; i < width * height; ++i)
  {
    view.silhouette.pixels.push_back(std::uint8_t(random.below(2)));
  }
  return view;
}

std::string messageOf(const std::vector<View>& views)
{
  try
  {
    prepareViews(views);
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(PreparedViews, ContentAgreesWithEveryPixelUnderEveryPolicy)
{
  Random random(3);
  for (const auto policy : { OutsidePolicy::Border, OutsidePolicy::Unknown, OutsidePolicy::Background })
  {
    for (int run = 0; run < 12; ++run)
    {
      View view = randomView(random, 1 + random.below(9), 1 + random.below(9));
      const PreparedViews views = prepareViews({ view }, policy);
      const auto& v = views[0];
      for (int trial = 0; trial < 400; ++trial)
      {
        const int c0 = random.below(14) - 3, c1 = c0 + random.below(6) - 1;
        const int r0 = random.below(14) - 3, r1 = r0 + random.below(6) - 1;
        PixelContent expected;
        for (int c = c0; c <= c1; ++c)
        {
          for (int r = r0; r <= r1; ++r)
          {
            const Vote vote = v.pixelVote(c, r);
            expected.object |= vote == Vote::Object;
            expected.background |= vote == Vote::Background;
            expected.abstain |= vote == Vote::Abstain;
          }
        }
        const PixelContent content = v.content(c0, c1, r0, r1);
        EXPECT_EQ(content.object, expected.object);
        EXPECT_EQ(content.background, expected.background);
        EXPECT_EQ(content.abstain, expected.abstain);
      }
    }
  }
}

TEST(PreparedViews, AbstainsSideBySide)
{
  View view;
  view.projection = lookAtOrigin({ 5, 1, 1 }, 20, 20);
  view.silhouette = { 3, 3, { 0, 1, 0, 0, 1, 0, 0, 0, 0 } }; // touches the top only
  const PreparedViews views = prepareViews({ view });
  EXPECT_EQ(views[0].pixelVote(1, -1), Vote::Abstain);
  EXPECT_EQ(views[0].pixelVote(-1, 1), Vote::Background);
  EXPECT_EQ(views[0].pixelVote(1, 3), Vote::Background);
  EXPECT_EQ(views[0].pixelVote(-1, -1), Vote::Abstain) << "beyond two sides either one opens it";
  EXPECT_EQ(views[0].pixelVote(3, 3), Vote::Background);
  EXPECT_EQ(prepareViews({ view }, OutsidePolicy::Unknown)[0].pixelVote(3, 3), Vote::Abstain);
  EXPECT_EQ(prepareViews({ view }, OutsidePolicy::Background)[0].pixelVote(1, -1), Vote::Background);
}

TEST(PreparedViews, ErrorsNameTheViewAndTheValue)
{
  Random random(5);
  const View good = randomView(random, 4, 4);
  EXPECT_NE(messageOf({}).find("no views"), std::string::npos);
  View bad = good;
  bad.projection(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf({ good, bad }), "view 1 (a.png): the projection matrix holds a value that is not finite");
  bad = good;
  bad.projection.row(1) = 2.0 * bad.projection.row(0);
  EXPECT_EQ(messageOf({ bad }), "view 0 (a.png): the projection matrix has rank 2, 3 is needed");
  bad = good;
  bad.silhouette.pixels.pop_back();
  EXPECT_EQ(messageOf({ bad }), "view 0 (a.png): 15 pixel values for 4 x 4 pixels");
  bad.silhouette = {};
  EXPECT_EQ(messageOf({ bad }), "view 0 (a.png): the silhouette is empty, 0 x 0 pixels");
}

TEST(PreparedViews, RankIsThatInAnyUnitOfLength)
{
  Random random(6);
  const Projection camera = randomView(random, 4, 4).projection;
  Projection flat = camera;
  flat.row(2) = flat.row(0) - 3.0 * flat.row(1);
  for (const double unit : { 1e-30, 1e-12, 1.0, 1e12, 1e30 })
  {
    const Eigen::Vector4d scale(1.0 / unit, 1.0 / unit, 1.0 / unit, 1.0);
    EXPECT_EQ(projectionRank(camera * scale.asDiagonal()), 3) << unit;
    EXPECT_EQ(projectionRank(flat * scale.asDiagonal()), 2) << unit;
  }
}

TEST(PreparedViews, FingerprintTellsViewsAndPoliciesApartButNotNames)
{
  Random random(5);
  const View view = randomView(random, 40, 30);
  const auto fingerprint = prepareViews({ view }).fingerprint();
  View other = view;
  other.name = "b";
  EXPECT_EQ(prepareViews({ other }).fingerprint(), fingerprint);
  other.silhouette.pixels[77] ^= 1;
  EXPECT_NE(prepareViews({ other }).fingerprint(), fingerprint);
  other = view;
  other.projection(0, 0) = std::nextafter(other.projection(0, 0), 100.0);
  EXPECT_NE(prepareViews({ other }).fingerprint(), fingerprint);
  EXPECT_NE(prepareViews({ view }, OutsidePolicy::Unknown).fingerprint(), fingerprint);
}

TEST(PreparedViews, LatticePointsProjectAsTheMatrixSays)
{
  const Projection P = lookAtOrigin({ 4, -3, 2 }, 300, 200);
  const Lattice lattice{ unitCube(), 9 };
  const LatticeProjection projection(P, lattice);
  Random random(11);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const LatticePoint p{ random.below(513), random.below(513), random.below(513) };
    const Vector3 expected = P * lattice.position(p).homogeneous();
    const auto h = projection(p);
    EXPECT_NEAR(h.U / h.W, expected.x() / expected.z(), 1e-9);
    EXPECT_NEAR(h.V / h.W, expected.y() / expected.z(), 1e-9);
  }
}

TEST(PreparedViews, AViewAbstainsBehindItsCameraAndAPointThatNoneSeesHasNoVotes)
{
  View view;
  view.projection = lookAtOrigin({ 0.2, 0, 0 }, 20, 21); // looks along -x from within the cube
  view.silhouette = { 21, 21, std::vector<std::uint8_t>(441, 1) };
  const PreparedViews views = prepareViews({ view }, OutsidePolicy::Background);
  const LatticeViews lattice(views, { unitCube(1.0), 4 });
  EXPECT_EQ(lattice.vote(0, { 16, 8, 8 }), Vote::Abstain);
  EXPECT_EQ(lattice.insideVotes({ 16, 8, 8 }), 0);
  EXPECT_EQ(lattice.vote(0, { 2, 8, 8 }), Vote::Object);
  EXPECT_EQ(lattice.insideVotes({ 2, 8, 8 }), 1);
}

TEST(PreparedViews, RankIgnoresTheScaleOfRows)
{
  Projection p;
  p << 1e3, 0, 0, 0, 0, 1e-6, 0, 0, 0, 0, 1e9, 0;
  EXPECT_EQ(projectionRank(p), 3);
  EXPECT_EQ(projectionRank(1e-200 * p), 3);
  p.row(2) = 3.0 * p.row(0) + 2e9 * p.row(1);
  EXPECT_EQ(projectionRank(p), 2);
  p.row(1) = 2.0 * p.row(0);
  p.row(2).setZero();
  EXPECT_EQ(projectionRank(p), 1);
  EXPECT_EQ(projectionRank(Projection::Zero()), 0);
}
