// SPDX-License-Identifier: BSD-3-Clause
#include "CornerDepth.h"

#include "CarvingTestCaptures.h"
#include "SilhouetteDissent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** By looking at every pixel of the silhouette. */
double distanceByBruteForce(const PreparedView& view, double u, double v)
{
  double least = 1e300;
  for (int row = 0; row < view.height; ++row)
  {
    for (int column = 0; column < view.width; ++column)
    {
      if (view.pixelVote(column, row) == Vote::Object)
      {
        least = std::min(
          least, std::hypot(std::max(std::abs(column - u) - 0.5, 0.0), std::max(std::abs(row - v) - 0.5, 0.0)));
      }
    }
  }
  return least;
}

double depthByBruteForce(const LatticeViews& views, const LatticePoint& p, int backgroundVotes, double reach)
{
  std::vector<double> depths;
  for (int view = 0; view < views.size(); ++view)
  {
    double depth = 0.0;
    if (views.vote(view, p) == Vote::Background)
    {
      const auto h = views.projection(view)(p);
      depth = -distanceByBruteForce(views.view(view), h.U / h.W, h.V / h.W) / pixelsPerOctant(views.projection(view), p);
    }
    depths.push_back(std::max(depth, -reach));
  }
  std::sort(depths.begin(), depths.end());
  return depths[std::size_t(backgroundVotes)];
}

} // namespace

TEST(CornerDepth, IsTheDistanceToTheNearestObjectPixelInTheFarthestView)
{
  Random random(5);
  for (int kind = 0; kind <= 5; ++kind)
  {
    auto captured = viewsOf(torusMesh(48, 24, 0.75, 0.2), swayingRing(7, 60), 60);
    disturb(captured, kind, random);
    const PreparedViews prepared = prepareViews(captured);
    const LatticeViews views(prepared, Lattice{ unitCube(), 4 });
    int between = 0, fewer = 0;
    for (const int votes : { 0, 1, 3 })
    {
      const Octree octree = carveViews(prepared, unitCube(), 4, votes);
      const double reach = votes == 1 ? 3.0 : 1.5; // beyond what four windows of pixels show, and within
      const CornerDepth depth(octree, views, reach);
      OctantCursor octants(octree);
      const auto leaves = leafCells(octree, OctantState::Intersection);
      for (int n = 0; n < 240; ++n)
      {
        const LatticePoint of = fromMorton(leaves[std::size_t(random.below(int(leaves.size())))]) + cornerOffset(random.below(8));
        const LatticePoint p = n % 2 ? of : LatticePoint{ int(random.below(17)), int(random.below(17)), int(random.below(17)) };
        const double expected = depthByBruteForce(views, p, votes, reach);
        EXPECT_NEAR(depth(p, octants), expected, 1e-12) << kind << " " << votes << " " << p.i << " " << p.j << " " << p.k;
        between += expected < 0.0 && expected > -reach;
        const double exact = depth(p, octants), least = random.uniform(-1.1 * reach, 0.1 * reach), told = depth(p, octants, least);
        EXPECT_TRUE(exact >= least ? told == exact : told >= exact && told < least) << exact << ", asked for " << least << ", told " << told;
        fewer += told != exact;
      }
    }
    EXPECT_GT(between, 60) << kind;
    EXPECT_GT(fewer, 0) << kind;
  }
}

TEST(CornerDepth, RefusesWhatIsOutOfRange)
{
  const PreparedViews prepared = prepareViews(viewsOf(torusMesh(12, 6, 0.75, 0.2), swayingRing(3, 20), 20));
  const LatticeViews views(prepared, Lattice{ unitCube(), 3 });
  Octree octree = carveViews(prepared, unitCube(), 3, 0);
  EXPECT_THROW(CornerDepth(octree, views, 0.0), InvalidInput);
  EXPECT_THROW(CornerDepth(octree, views, std::nan("")), InvalidInput);
  for (const int votes : { 3, -1 })
  {
    octree.backgroundVotes = votes;
    EXPECT_THROW(CornerDepth(octree, views, 1.0), InvalidInput);
  }
}
