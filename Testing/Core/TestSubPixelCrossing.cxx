// SPDX-License-Identifier: BSD-3-Clause
#include "SubPixelCrossing.h"

#include "CarvingTestCaptures.h"
#include "EdgeCrossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 128;
constexpr double Scale = 32.0; ///< px a unit; of the lattice below 3 an octant

/** Half a plane seen along z: object where nx u + ny v <= c, from the image's middle. */
struct HalfPlane
{
  double angle;
  double offset; ///< px

  double operator()(double u, double v) const
  {
    return this->offset - std::cos(this->angle) * u - std::sin(this->angle) * v;
  }
};

View viewOf(const HalfPlane& plane, int number)
{
  View view{ "v" + std::to_string(number), axisCameras(Scale, Size)[2], {} };
  view.silhouette = { Size, Size, std::vector<std::uint8_t>(std::size_t(Size) * Size, 0) };
  const double middle = 0.5 * (Size - 1);
  for (int n = 0; n < Size * Size; ++n)
  {
    view.silhouette.pixels[n] = plane(n % Size - middle, n / Size - middle) >= 0.0;
  }
  return view;
}

/** 0 inside to 1 outside along x, at which the plane is crossed; the nearest end where it is not. */
double crossingOf(const HalfPlane& plane, const Lattice& lattice, const LatticePoint& inside, int direction)
{
  const double x = Scale * (lattice.root.origin[0] + lattice.leafEdge() * inside.i);
  const double y = Scale * (lattice.root.origin[1] + lattice.leafEdge() * inside.j);
  const double from = plane(x, y), to = plane(x + direction * Scale * lattice.leafEdge(), y);
  return std::clamp(from / (from - to), 0.0, 1.0);
}

const Lattice TheLattice{ unitCube(1.5), 5 };

/** All of up to 16 views. */
ViewsToAsk allOf(const LatticeViews& views)
{
  static const std::array<std::uint16_t, 16> numbers{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
  ViewsToAsk all;
  all.views = numbers.data();
  all.count = std::size_t(views.size());
  return all;
}

/** All edges along x in the middle slice of which one end is called background and the other is not. */
template <typename Work>
void forEachCrossedEdge(const LatticeViews& views, int backgroundVotes, const Work& work)
{
  const int least = views.size() - backgroundVotes;
  for (int j = 4; j <= 28; ++j)
  {
    for (int i = 4; i < 28; ++i)
    {
      const LatticePoint a{ i, j, 16 }, b{ i + 1, j, 16 };
      const bool insideA = views.insideVotes(a) >= least, insideB = views.insideVotes(b) >= least;
      if (insideA != insideB)
      {
        work(insideA ? a : b, insideA ? b : a, insideA ? 1 : -1);
      }
    }
  }
}

} // namespace

/** The line crosses the rows slowly: its pixels' stairs put exactCrossing() wrong by half a pixel, not this. */
TEST(SubPixelCrossing, IsNearerToASlantedLineThanThePixels)
{
  Execution execution;
  const double pixel = 1.0 / (Scale * TheLattice.leafEdge()); // in octants
  for (const HalfPlane& plane : { HalfPlane{ 0.13, 3.3 }, HalfPlane{ 0.4, -5.7 }, HalfPlane{ 2.9, 8.1 } })
  {
    const PreparedViews prepared = prepareViews({ viewOf(plane, 0) });
    const LatticeViews views(prepared, TheLattice);
    const SubPixelCrossing crossing(views, execution);
    const ViewsToAsk all = allOf(views);
    double error = 0.0, exactError = 0.0;
    int edges = 0;
    forEachCrossedEdge(views, 0,
      [&](const LatticePoint& inside, const LatticePoint& outside, int direction)
      {
        const double truth = crossingOf(plane, TheLattice, inside, direction);
        const double t = crossing(all, inside, outside, 0);
        EXPECT_NEAR(t, truth, 0.6 * pixel);
        EXPECT_NEAR(crossing(inside, outside, 0), truth, 0.6 * pixel);
        error += std::abs(t - truth);
        exactError += std::abs(exactCrossing(views, inside, outside, 0) - truth);
        ++edges;
      });
    ASSERT_GT(edges, 15);
    EXPECT_LT(error, 0.75 * exactError) << plane.angle << ": " << error / edges / pixel << " px";
    EXPECT_LT(error / edges, 0.2 * pixel) << plane.angle;
  }
}

TEST(SubPixelCrossing, WithBackgroundVotesTheNextViewCounts)
{
  Execution execution;
  const double pixel = 1.0 / (Scale * TheLattice.leafEdge());
  // Parallel lines less than an octant apart: the second and third rejection come later along the same edge.
  const std::vector<HalfPlane> planes{ { 0.2, 2.0 }, { 0.2, 2.6 }, { 0.2, 3.4 } };
  std::vector<View> captured;
  for (const auto& plane : planes)
  {
    captured.push_back(viewOf(plane, int(captured.size())));
  }
  const PreparedViews prepared = prepareViews(captured);
  const LatticeViews views(prepared, TheLattice);
  const SubPixelCrossing crossing(views, execution);
  const ViewsToAsk all = allOf(views);
  for (int votes = 0; votes < 3; ++votes)
  {
    int edges = 0;
    forEachCrossedEdge(views, votes,
      [&](const LatticePoint& inside, const LatticePoint& outside, int direction)
      {
        const double truth = crossingOf(planes[votes], TheLattice, inside, direction);
        EXPECT_NEAR(crossing(all, inside, outside, votes), truth, 0.6 * pixel) << votes;
        EXPECT_NEAR(crossing(inside, outside, votes), truth, 0.6 * pixel) << votes;
        ++edges;
      });
    EXPECT_GT(edges, 15) << votes;
  }
}

/** By brute force: the distances of all views at any place, without what is asked first. */
TEST(SubPixelCrossing, APointIsInsideWhereFewViewsAreAtADistanceOfNoneOrLess)
{
  Execution execution;
  Random random(7);
  auto captured = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(6, 120), 120);
  disturb(captured, 3, random);
  for (const OutsidePolicy policy : { OutsidePolicy::Border, OutsidePolicy::Unknown })
  {
    const PreparedViews prepared = prepareViews(captured, policy);
    const LatticeViews views(prepared, { unitCube(2.0), 6 }); // its corners are in no image
    const SubPixelCrossing crossing(views, execution);
    std::vector<DistanceMap> maps;
    for (const View& view : captured)
    {
      maps.push_back(distanceMap(view.silhouette.pixels.data(), 120, 120, 10.0));
    }
    int unseen = 0, changed = 0;
    for (std::uint64_t n = 0; n < std::uint64_t(1) << 18; n += 3)
    {
      const LatticePoint p = fromMorton(n);
      int outside = 0, seen = 0;
      for (int view = 0; view < views.size(); ++view)
      {
        const Vector3 h = captured[std::size_t(view)].projection * views.lattice().position(p).homogeneous();
        const bool sees = views.vote(view, p) != Vote::Abstain;
        seen += sees;
        outside += sees && maps[std::size_t(view)].at(h[0] / h[2], h[1] / h[2]) <= 0.0f;
      }
      for (const int k : { 0, 2 })
      {
        ASSERT_EQ(crossing.inside(p, k), seen > 0 && outside <= k) << "point " << n;
      }
      unseen += seen == 0;
      changed += (outside == 0) != (views.insideVotes(p) == views.size());
    }
    EXPECT_EQ(unseen > 0, policy == OutsidePolicy::Unknown);
    EXPECT_GT(changed, 20);
  }
}

/** A view that calls both ends background counts from the start, whether it is asked or known to. */
TEST(SubPixelCrossing, IsTheSameWhicheverOctantsViewsAreAsked)
{
  Execution execution;
  const std::vector<HalfPlane> planes{ { 0.2, 2.0 }, { 0.2, 0.0 }, { 0.2, 3.4 } };
  std::vector<View> captured;
  for (const auto& plane : planes)
  {
    captured.push_back(viewOf(plane, int(captured.size())));
  }
  const PreparedViews prepared = prepareViews(captured);
  const LatticeViews views(prepared, { unitCube(1.5), 6 });
  const SubPixelCrossing crossing(views, execution);
  const std::array<std::uint16_t, 2> others{ 0, 2 };
  ViewsToAsk settled;
  settled.views = others.data();
  settled.count = others.size();
  settled.backgroundVotes = 1;
  int edges = 0;
  for (int n = 8 * 8; n < 56 * 55; ++n)
  {
    const LatticePoint a{ n % 56, n / 56, 32 }, b{ n % 56 + 1, n / 56, 32 };
    const auto is = [&](int view, const LatticePoint& p) { return views.vote(view, p) == Vote::Object; };
    if (views.insideVotes(a) >= 2 && views.insideVotes(b) < 2 && !is(1, a) && !is(1, b))
    {
      ASSERT_EQ(crossing(allOf(views), a, b, 1), crossing(settled, a, b, 1));
      ++edges;
    }
  }
  EXPECT_GT(edges, 20);
}
