// SPDX-License-Identifier: BSD-3-Clause
#include "LoneCarvers.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

bool leavesNothing(const std::vector<View>& views, int depth, int backgroundVotes)
{
  try
  {
    carveViews(prepareViews(views), unitCube(), depth, backgroundVotes);
  }
  catch (const NothingSurvives&)
  {
    return true;
  }
  return false;
}

/** A torus, which a few cameras have slid away from. */
std::vector<View> slidViews(int count, double share, Random& random)
{
  auto views = viewsOf(torusMesh(48, 24, 0.7, 0.28), swayingRing(count, 120), 120);
  for (auto& view : views)
  {
    if (random.uniform() < share)
    {
      view.projection.row(0) += random.uniform(-160.0, 160.0) * view.projection.row(2);
    }
  }
  return views;
}

} // namespace

TEST(LoneCarvers, AreThoseWithoutWhichSomethingIsLeft)
{
  int found = 0, tolerated = 0, empty = 0;
  for (int trial = 0; trial < 40; ++trial)
  {
    Random random(90 + trial);
    const int depth = 3 + trial % 3, votes = trial % 4 == 0 ? 1 : 0;
    const auto views = slidViews(5 + trial % 2, votes > 0 ? 0.6 : 0.4, random);
    if (!leavesNothing(views, depth, votes))
    {
      continue;
    }
    ++empty;
    Execution execution;
    const auto lone = loneCarvers(prepareViews(views), { unitCube(), depth }, votes, execution);
    for (std::size_t n = 0; n < views.size(); ++n)
    {
      auto others = views;
      others.erase(others.begin() + std::ptrdiff_t(n));
      EXPECT_EQ(lone[n], !leavesNothing(others, depth, votes)) << trial << ", view " << n;
      found += lone[n];
      tolerated += lone[n] && votes > 0;
    }
  }
  EXPECT_GT(empty, 15);
  EXPECT_GT(found, 10);
  EXPECT_GT(tolerated, 0);
}

TEST(LoneCarvers, OfFewViewsAndOnesThatWantToStop)
{
  Random random(5);
  auto views = slidViews(2, 0.0, random);
  std::fill(views[0].silhouette.pixels.begin(), views[0].silhouette.pixels.end(), std::uint8_t(0));
  const PreparedViews prepared = prepareViews(views);
  const Lattice lattice{ unitCube(), 4 };
  Execution execution;
  EXPECT_EQ(loneCarvers(prepared, lattice, 0, execution), (std::vector<bool>{ true, false }));
  EXPECT_EQ(loneCarvers(prepared, lattice, 1, execution), (std::vector<bool>{ false, false }));
  CancelledExecution cancelled;
  EXPECT_THROW(loneCarvers(prepared, lattice, 0, cancelled), Cancelled);
}
