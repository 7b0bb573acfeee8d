// SPDX-License-Identifier: BSD-3-Clause
#include "ThinHulls.h"

#include "ThinHullScene.h"

#include <limits>

using namespace silhouette;
using namespace silhouette::test;

TEST(ThinHulls, ABallsDistanceIsThatOfTheNearestBetweenTheTwo)
{
  Random random(1);
  const auto anywhere = [&] { return Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
  for (int run = 0; run < 300; ++run)
  {
    ThinHull hull{ { anywhere(), anywhere() }, { random.uniform(0.1, 1.5), random.uniform(0.1, 0.5) } };
    if (run % 10 == 0)
    {
      hull.centre[1] = hull.centre[0];
      hull.radius[1] = hull.radius[0];
    }
    const Vector3 p = 2.0 * anywhere();
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n <= 2000; ++n)
    {
      const double t = n / 2000.0;
      const Vector3 centre = (1 - t) * hull.centre[0] + t * hull.centre[1];
      least = std::min(least, (p - centre).norm() - ((1 - t) * hull.radius[0] + t * hull.radius[1]));
    }
    EXPECT_NEAR(nearestBall(hull, p).distance, least, 1e-3);
    EXPECT_LE(nearestBall(hull, p).distance, least + 1e-12);
  }
}

TEST(ThinHulls, DepthIsTheDistanceFromASpheresSurface)
{
  Execution execution;
  const PreparedViews prepared = look(sphereMesh(5, 0.9), 0, 0, 40, 400);
  const LatticeViews views(prepared, { unitCube(), 6 });
  const double edge = views.lattice().leafEdge();
  const SilhouetteDepth depth(views, 0, 2.0, execution), tolerant(views, 3, 2.0, execution);
  Random random(2);
  for (int run = 0; run < 200; ++run)
  {
    const Vector3 way = Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const double d = random.uniform(-1.0, 1.9);
    const Vector3 p = ((0.9 - d * edge) * way - views.lattice().root.origin) / edge;
    const double found = depth(p);
    // Outside, views that do not see the point on their contour call it less far away than it is.
    EXPECT_GE(found, d - 0.15);
    EXPECT_LE(found, (d > 0.0 ? d : 0.0) + 0.35);
    EXPECT_GE(tolerant(p), found);
    EXPECT_LE(depth(p, found), found);
  }
  EXPECT_THROW(SilhouetteDepth(views, 40, 2.0, execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, 0, 0.0, execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, 0, 1.0, execution, { Vector2::Zero() }), InvalidInput);
}

TEST(ThinHulls, SameForAnyNumberOfThreads)
{
  Execution serial;
  Covered covered(look(tube(0.02), 2, 5, 12, 200), unitCube(), 5, 3);
  const SilhouetteDepth depth(covered.views, 3, 1.0, serial);
  const auto one = thinHulls(covered.labels, covered.cells, depth, {}, serial);
  EXPECT_GT(one.size(), 10u);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = thinHulls(covered.labels, covered.cells, depth, {}, execution);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t h = 0; h < one.size(); ++h)
    {
      EXPECT_EQ(one[h].centre[1], many[h].centre[1]);
      EXPECT_EQ(one[h].radius[1], many[h].radius[1]);
    }
  }
}

TEST(ThinHulls, OptionsOutOfRangeAreErrorsAndItCanBeCancelled)
{
  Execution execution;
  Covered covered(look(tube(0.02), 0, 5, 8, 150), unitCube(), 5, 0);
  const SilhouetteDepth depth(covered.views, 0, 1.0, execution);
  for (const ThinHullOptions& wrong : { ThinHullOptions{ 0.0, 0.5, 0.9 }, ThinHullOptions{ 0.3, 0.2, 0.9 },
         ThinHullOptions{ 0.1, 1.5, 0.9 }, ThinHullOptions{ 0.1, 0.5, -0.1 }, ThinHullOptions{ 0.1, 0.5, 1.1 },
         ThinHullOptions{ 0.1, std::numeric_limits<double>::quiet_NaN(), 0.5 } })
  {
    EXPECT_THROW(checkThinHullOptions(wrong), InvalidInput);
    EXPECT_THROW(thinHulls(covered.labels, covered.cells, depth, wrong, execution), InvalidInput);
  }
  CancelledExecution cancelled;
  EXPECT_THROW(SilhouetteDepth(covered.views, 0, 1.0, cancelled), Cancelled);
  EXPECT_THROW(thinHulls(covered.labels, covered.cells, depth, {}, cancelled), Cancelled);
}
