// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteDepth.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr double Radius = 0.8;
constexpr double Scale = 160.0; ///< px a unit
constexpr int Size = 400;

/** A disc seen along each axis: the hull is that of three cylinders. */
struct ThreeCylinders
{
  ThreeCylinders()
  {
    std::vector<View> captured;
    for (const Projection& camera : axisCameras(Scale, Size))
    {
      View view{ "v" + std::to_string(captured.size()), camera, {} };
      view.silhouette = { Size, Size, std::vector<std::uint8_t>(std::size_t(Size) * Size, 0) };
      const double middle = 0.5 * (Size - 1);
      for (int n = 0; n < Size * Size; ++n)
      {
        view.silhouette.pixels[n] = std::hypot(n % Size - middle, n / Size - middle) <= Radius * Scale;
      }
      captured.push_back(view);
    }
    this->prepared = prepareViews(captured);
  }

  Lattice lattice{ unitCube(1.2), 5 };
  PreparedViews prepared;
};

/** Octants inside each cylinder, the least first. */
std::array<double, 3> depthsOf(const Lattice& lattice, const Vector3& p, double reach, const std::vector<Vector2>& shifts = {})
{
  const Vector3 x = lattice.root.origin + lattice.leafEdge() * p;
  std::array<double, 3> depths;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector2 shift = shifts.empty() ? Vector2(0.0, 0.0) : Vector2(shifts[axis] / Scale);
    const double away = std::hypot(x[(axis + 1) % 3] + shift[0], x[(axis + 2) % 3] + shift[1]);
    depths[axis] = std::clamp((Radius - away) / lattice.leafEdge(), -reach, reach);
  }
  std::sort(depths.begin(), depths.end());
  return depths;
}

} // namespace

TEST(SilhouetteDepth, OfThreeCylindersIsTheirDistance)
{
  const ThreeCylinders scene;
  const LatticeViews views(scene.prepared, scene.lattice);
  const double pixel = 1.0 / (Scale * scene.lattice.leafEdge()); // in octants
  const std::vector<Vector2> shifts{ Vector2(9.0, 0.0), Vector2(0.0, -7.0), Vector2(4.0, 5.0) };
  Execution execution;
  Random random(3);
  for (const bool shifted : { false, true })
  {
    for (const int votes : { 0, 1, 2 })
    {
      const double reach = 3.0;
      const SilhouetteDepth depth(views, votes, reach, execution, shifted ? shifts : std::vector<Vector2>());
      int between = 0;
      for (int n = 0; n < 2000; ++n)
      {
        const Vector3 p(random.uniform(0, 32), random.uniform(0, 32), random.uniform(0, 32));
        const double expected = depthsOf(scene.lattice, p, reach, shifted ? shifts : std::vector<Vector2>())[votes];
        EXPECT_NEAR(depth(p), expected, pixel) << votes << " at " << p.transpose();
        between += std::abs(expected) < reach;
      }
      EXPECT_GT(between, 300) << votes;
    }
  }
}

TEST(SilhouetteDepth, MayStopAtEnough)
{
  const ThreeCylinders scene;
  const LatticeViews views(scene.prepared, scene.lattice);
  Execution execution;
  Random random(4);
  for (const int votes : { 0, 1 })
  {
    const SilhouetteDepth depth(views, votes, 3.0, execution);
    int stopped = 0, first = 0;
    for (int n = 0; n < 500; ++n)
    {
      const Vector3 p(random.uniform(0, 32), random.uniform(0, 32), random.uniform(0, 32));
      const double whole = depth(p), some = depth(p, -0.5);
      EXPECT_GE(some, whole);
      EXPECT_EQ(some <= -0.5, whole <= -0.5) << p.transpose();
      EXPECT_TRUE(whole <= -0.5 || some == whole) << p.transpose();
      for (const int before : { 0, 1, 2 }) // whichever is asked first
      {
        first = before;
        const double other = depth(p, -0.5, first);
        EXPECT_EQ(other <= -0.5, whole <= -0.5) << p.transpose();
        EXPECT_TRUE(whole <= -0.5 || other == whole) << p.transpose();
        ASSERT_TRUE(first >= 0 && first < views.size());
        int again = first;
        EXPECT_LE(depth(p, -1e300, again), other);
      }
      stopped += some != whole;
    }
    EXPECT_GT(stopped, 10) << votes;
  }
}

TEST(SilhouetteDepth, RefusesWhatIsOutOfRange)
{
  const ThreeCylinders scene;
  const LatticeViews views(scene.prepared, scene.lattice);
  Execution execution;
  EXPECT_THROW(SilhouetteDepth(views, 3, 1.0, execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, -1, 1.0, execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, 0, 0.0, execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, 0, std::nan(""), execution), InvalidInput);
  EXPECT_THROW(SilhouetteDepth(views, 0, 1.0, execution, { Vector2(0, 0), Vector2(0, 0) }), InvalidInput);
}
