// SPDX-License-Identifier: BSD-3-Clause
#include "AutomaticBounds.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

RootCube boundsOf(const std::vector<View>& views, int depth, int backgroundVotes = 0)
{
  Execution execution;
  const PreparedViews prepared = prepareViews(views);
  return automaticBounds(prepared, { depth, backgroundVotes }, execution);
}

/** The views of an object moved and scaled. */
std::vector<View> moved(std::vector<View> views, const Vector3& by, double scale)
{
  Eigen::Matrix4d back = Eigen::Matrix4d::Identity();
  back.topLeftCorner<3, 3>() /= scale;
  back.topRightCorner<3, 1>() = -by / scale;
  for (auto& view : views)
  {
    view.projection = Projection(view.projection * back);
  }
  return views;
}

} // namespace

TEST(AutomaticBounds, KeepOneLeafFreeAndAreAtMostATenthLargerThanTheHull)
{
  Execution execution;
  const auto views = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(12, 300), 300);
  for (const int depth : { 5, 6, 7, 8 })
  {
    for (const double scale : { 1.0, 1e-3, 1e4 })
    {
      const Vector3 by = scale * Vector3(3, -20, 7);
      const PreparedViews prepared = prepareViews(moved(views, by, scale));
      const RootCube cube = automaticBounds(prepared, { depth, 0 }, execution);
      const Octree octree = carveViews(prepared, cube, depth);
      const auto surface = votingMarchingCubes(octree, prepared, VotingOptions(), execution);
      Box hull;
      for (const auto& p : surface.mesh.points)
      {
        hull.extend(p);
      }
      const double leaf = octree.lattice.leafEdge();
      EXPECT_LE(cube.edge, 1.1 * hull.sizes().maxCoeff()) << "depth " << depth << " scale " << scale;
      EXPECT_GE((hull.min() - cube.origin).minCoeff(), leaf);
      EXPECT_GE((cube.origin + Vector3::Constant(cube.edge) - hull.max()).minCoeff(), leaf);
    }
  }
}

TEST(AutomaticBounds, HoldTheHullThatSomeViewsDissentFrom)
{
  auto views = viewsOf(sphereMesh(4, 0.9), swayingRing(12, 200), 200);
  std::fill(views[4].silhouette.pixels.begin(), views[4].silhouette.pixels.end(), std::uint8_t(0));
  EXPECT_THROW(boundsOf(views, 6), NothingSurvives);
  const RootCube cube = boundsOf(views, 6, 1);
  EXPECT_LT(cube.origin.maxCoeff(), -0.85);
  EXPECT_GT(cube.origin.minCoeff() + cube.edge, 0.85);
  EXPECT_LT(cube.edge, 4.0);
}

TEST(AutomaticBounds, OneViewDoesNotBoundAnything)
{
  auto views = viewsOf(sphereMesh(4, 0.9), swayingRing(12, 200), 200);
  views.resize(1);
  try
  {
    boundsOf(views, 6);
    FAIL();
  }
  catch (const UnboundedObject& error)
  {
    EXPECT_NE(std::string(error.what()).find("of the 1 view do not close"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("background votes"), std::string::npos);
  }
}

TEST(AutomaticBounds, VotesThatLeaveTooFewViewsAreNamed)
{
  const auto views = viewsOf(sphereMesh(4, 0.9), swayingRing(12, 200), 200);
  try
  {
    boundsOf(views, 6, 11);
    FAIL();
  }
  catch (const UnboundedObject& error)
  {
    EXPECT_STREQ(error.what(), "automatic bounds: the viewing cones of the 12 views, of which 11 may dissent (background votes), do not "
                               "close around the object; give the bounds, fewer background votes, or more views from other directions");
  }
}

TEST(AutomaticBounds, ABoxIsEnclosedInACubeOfTheSameCentre)
{
  const RootCube cube = enclosingCube({ 0, -1, 2 }, { 1, 3, 4 });
  EXPECT_EQ(cube.edge, 4.0);
  EXPECT_EQ(cube.origin, Vector3(-1.5, -1, 1));
  EXPECT_THROW(enclosingCube({ 0, 0, 0 }, { 1, 0, 1 }), InvalidInput);
  EXPECT_THROW(enclosingCube({ 0, 0, 0 }, { 1, std::nan(""), 1 }), InvalidInput);
}
