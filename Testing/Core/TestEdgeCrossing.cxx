// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeCrossing.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Background votes at fraction t of an edge, by projecting the very point. */
int backgroundVotesAt(const LatticeViews& views, const LatticePoint& a, const LatticePoint& b, double t)
{
  int count = 0;
  for (int i = 0; i < views.size(); ++i)
  {
    const auto hA = views.projection(i)(a), hB = views.projection(i)(b);
    const double U = hA.U + t * (hB.U - hA.U), V = hA.V + t * (hB.V - hA.V), W = hA.W + t * (hB.W - hA.W);
    const auto& v = views.view(i);
    count += v.pixelVote(PreparedView::nearestPixel(U / W, v.width), PreparedView::nearestPixel(V / W, v.height)) ==
      Vote::Background;
  }
  return count;
}

} // namespace

TEST(EdgeCrossing, IsTheFirstPointAtWhichTheVotesFail)
{
  Random random(31);
  auto views = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(9, 200), 200);
  disturb(views, 1, random);
  for (auto& view : views)
  {
    // No lattice edge may run along a pixel boundary, where the samples' rounding would decide.
    view.projection.row(0) += 0.1234 * view.projection.row(2);
    view.projection.row(1) += 0.0567 * view.projection.row(2);
  }
  const PreparedViews prepared = prepareViews(views);
  const LatticeViews lattice(prepared, { unitCube(), 5 });
  int found = 0;
  for (int trial = 0; trial < 60000 && found < 600; ++trial)
  {
    const LatticePoint a{ 1 + random.below(31), 1 + random.below(31), 1 + random.below(31) };
    const int axis = random.below(3), step = random.below(2) ? 1 : -1, allowed = random.below(3);
    LatticePoint b = a;
    (axis == 0 ? b.i : axis == 1 ? b.j : b.k) += step;
    if (9 - lattice.insideVotes(a) > allowed || 9 - lattice.insideVotes(b) <= allowed)
    {
      continue;
    }
    ++found;
    const double t = exactCrossing(lattice, a, b, allowed);
    double expected = 1.0;
    const int samples = 4000;
    for (int s = 0; s <= samples; ++s)
    {
      if (backgroundVotesAt(lattice, a, b, double(s) / samples) > allowed)
      {
        expected = double(s) / samples;
        break;
      }
    }
    // A sliver of a pixel between two samples may be missed by the samples, never by the walk.
    EXPECT_LE(t, expected + 1e-9);
    if (t < expected - 1.0 / samples)
    {
      EXPECT_GT(backgroundVotesAt(lattice, a, b, t + 1e-9), allowed) << t << " " << expected;
    }
  }
  EXPECT_EQ(found, 600);
}
