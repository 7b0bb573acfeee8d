// SPDX-License-Identifier: BSD-3-Clause
#include "FieldViews.h"

#include "CarvingTestCaptures.h"
#include "OutlineRendering.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 320;
constexpr double Radius = 0.7;
constexpr double Distance = 6.0;     // of the cameras, as swayingRing() has it
constexpr double Focal = 2.2 * Size; // likewise

std::vector<int> allOf(const FieldViews& views)
{
  std::vector<int> all(views.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

PreparedViews sphereViews(int count)
{
  return prepareViews(viewsOf(sphereMesh(5, Radius), swayingRing(count, Size), Size));
}

std::vector<LatticePoint> somePoints(const Lattice& lattice, int count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<LatticePoint> points;
  for (int n = 0; n < count; ++n)
  {
    const int side = lattice.cells() + 1;
    points.push_back({ random.below(side), random.below(side), random.below(side) });
  }
  return points;
}

Vector2 projected(const Projection& projection, const Vector3& p)
{
  const Vector3 h = projection * p.homogeneous();
  return { h[0] / h[2], h[1] / h[2] };
}

} // namespace

/** A point at angle a off the axis lies depth * (tan b - tan a) inside the cone of half angle b, across the view. */
TEST(FieldViews, InsideOfASphereIsItsConesDistance)
{
  Execution execution;
  const PreparedViews views = sphereViews(9);
  const Lattice lattice{ unitCube(), 5 };
  const double reach = 6.0;
  FieldViews fieldViews(views, lattice, reach);
  fieldViews.observe(allOf(fieldViews), execution);
  EXPECT_EQ(fieldViews.size(), 9);
  EXPECT_EQ(fieldViews.reach(), reach);
  const double leaf = lattice.leafEdge();
  const double pixel = Distance / Focal / leaf; // in octants: 0.1
  const double tangent = Radius / std::sqrt(Distance * Distance - Radius * Radius);
  int cutOff = 0, near = 0;
  for (int view = 0; view < views.size(); ++view)
  {
    EXPECT_NEAR(fieldViews.pixelsPerOctant(view) * pixel, 1.0, 1e-9);
    for (const LatticePoint& p : somePoints(lattice, 1500, std::uint64_t(view)))
    {
      const Vector3 h = views[view].projection * lattice.position(p).homogeneous();
      const double middle = 0.5 * (Size - 1);
      const double aside = std::max(std::abs(h[0] / h[2] - middle), std::abs(h[1] / h[2] - middle));
      if (h[2] < Distance / 1.2 || aside > middle)
      {
        continue; // beyond the image it is estimated; nearer to the camera it is cut off earlier
      }
      const double offAxis = std::hypot(h[0] / h[2] - middle, h[1] / h[2] - middle) / Focal;
      const double expected = std::clamp(h[2] / leaf * (tangent - offAxis), -reach, reach);
      const float found = fieldViews.inside(fieldViews.observed(view), fieldViews.place(view, p));
      EXPECT_NEAR(found, expected, 1.2 * pixel) << view << ": " << p.i << " " << p.j << " " << p.k;
      EXPECT_LE(std::abs(found), reach);
      near += std::abs(expected) < 0.9 * reach;
      cutOff += std::abs(expected) == reach;
    }
  }
  EXPECT_GT(near, 3000);
  EXPECT_GT(cutOff, 300);
}

TEST(FieldViews, AShiftMovesEveryPlaceByItsPixels)
{
  const PreparedViews views = sphereViews(4);
  const Lattice lattice{ unitCube(), 5 };
  FieldViews fieldViews(views, lattice, 5.0);
  const FieldViews still = fieldViews;
  fieldViews.addShift(1, Vector2(1.25, -3.5));
  fieldViews.addShift(1, Vector2(0.5, 0.5));
  fieldViews.addShift(3, Vector2(-20.0, 7.0));
  EXPECT_EQ(fieldViews.shift(1), Vector2(1.75, -3.0));
  EXPECT_EQ(fieldViews.shift(2), Vector2(0.0, 0.0));
  for (int view = 0; view < 4; ++view)
  {
    for (const LatticePoint& p : somePoints(lattice, 300, 7))
    {
      const auto before = still.place(view, p), after = fieldViews.place(view, p);
      const Vector2 expected = projected(views[view].projection, lattice.position(p));
      EXPECT_NEAR(before.u, expected[0], 1e-8);
      EXPECT_NEAR(before.v, expected[1], 1e-8);
      EXPECT_NEAR(after.u - before.u, fieldViews.shift(view)[0], 1e-8);
      EXPECT_NEAR(after.v - before.v, fieldViews.shift(view)[1], 1e-8);
      EXPECT_NEAR(after.octantsPerPixel, before.octantsPerPixel, 1e-12);
    }
  }
}

TEST(FieldViews, RenderIsTheSilhouetteOfTheShiftedProjection)
{
  Execution execution;
  const PreparedViews views = sphereViews(5);
  FieldViews fieldViews(views, { unitCube(), 5 }, 5.0);
  fieldViews.observe(allOf(fieldViews), execution);
  fieldViews.addShift(2, Vector2(4.6, -2.3));
  fieldViews.addShift(4, Vector2(-1.5, 0.25));
  const Mesh mesh = torusMesh(40, 20, 0.6, 0.2);
  const OutlineRenderer renderer(mesh, fieldViews.cameras({ 4, 0, 2 }), execution);
  const auto maps = fieldViews.distances(mesh, execution);
  ASSERT_EQ(maps.size(), 5u);
  std::size_t n = 0;
  for (const int view : { 4, 0, 2 })
  {
    Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
    shift.col(2).head<2>() = fieldViews.shift(view);
    const Projection shifted = shift * views[view].projection;
    const BinaryImage image = imageOf(renderer.render(n++));
    EXPECT_EQ(image.pixels, renderSilhouette(mesh, shifted, Size, Size).pixels) << view;
    EXPECT_EQ(image.pixels == renderSilhouette(mesh, views[view].projection, Size, Size).pixels, view == 0);
    EXPECT_GE(maps[view].reach, 5.0 * fieldViews.pixelsPerOctant(view));
    const DistanceMap expected = distanceMap(image.pixels.data(), Size, Size, maps[view].reach);
    EXPECT_EQ(maps[view].pieces, expected.pieces);
    EXPECT_EQ(maps[view].values, expected.values);
  }
}

/** Distances are straight but for corners and middles, so that few samples tell them. */
TEST(FieldViews, FewSamplesAnOctantSayNearlyTheSame)
{
  Execution execution;
  const PreparedViews views = sphereViews(3);
  const Lattice lattice{ unitCube(), 4 }; // 20 pixels an octant
  FieldViews every(views, lattice, 4.0), some(views, lattice, 4.0, 2.0), none(views, lattice, 4.0, 1000.0);
  for (FieldViews* fieldViews : { &every, &some, &none })
  {
    fieldViews->observe(allOf(*fieldViews), execution);
  }
  EXPECT_EQ(every.observed(0).spacing, 1);
  EXPECT_EQ(none.observed(0).spacing, 1);
  EXPECT_EQ(some.observed(0).spacing, int(some.pixelsPerOctant(0) / 2.0));
  EXPECT_LT(50 * some.observed(0).columns * some.observed(0).rows, every.observed(0).columns * every.observed(0).rows);
  int near = 0;
  for (int view = 0; view < 3; ++view)
  {
    for (const LatticePoint& p : somePoints(lattice, 1000, std::uint64_t(view)))
    {
      const auto place = every.place(view, p);
      const float one = every.inside(every.observed(view), place), two = some.inside(some.observed(view), place);
      EXPECT_NEAR(one, two, std::abs(one) < 3.0f ? 0.06 : 0.3);
      near += std::abs(one) < 3.0f;
    }
  }
  EXPECT_GT(near, 500);
}

TEST(FieldViews, AViewThatAbstainsLeavesTheWholeReach)
{
  Execution execution;
  auto captured = viewsOf(sphereMesh(4, Radius), swayingRing(4, Size), Size);
  Projection behind = captured[0].projection; // looks away
  behind.row(2) *= -1.0;
  behind.topRows<2>() *= -1.0;
  captured.push_back({ "behind", behind, captured[0].silhouette });
  const Lattice lattice{ unitCube(3.0), 5 };
  for (const OutsidePolicy policy : { OutsidePolicy::Unknown, OutsidePolicy::Background })
  {
    const PreparedViews views = prepareViews(captured, policy);
    FieldViews fieldViews(views, lattice, 4.0);
    fieldViews.observe(allOf(fieldViews), execution);
    const LatticeViews votes(views, lattice);
    int abstained = 0, beyond = 0;
    for (int view = 0; view < views.size(); ++view)
    {
      for (const LatticePoint& p : somePoints(lattice, 800, 11))
      {
        const auto place = fieldViews.place(view, p);
        const bool abstains = votes.vote(view, p) == Vote::Abstain;
        EXPECT_EQ(place.octantsPerPixel == 0.0, abstains) << view;
        const float inside = fieldViews.inside(fieldViews.observed(view), place);
        EXPECT_TRUE(!abstains || inside == 4.0f) << inside;
        const bool outside = place.u < -0.5 || place.v < -0.5 || place.u > Size - 0.5 || place.v > Size - 0.5;
        EXPECT_TRUE(abstains || !outside || inside < 0.0f) << inside;
        abstained += abstains && view < 4;
        beyond += !abstains && outside;
      }
      EXPECT_TRUE(view < 4 || fieldViews.place(view, { 16, 16, 16 }).octantsPerPixel == 0.0);
    }
    EXPECT_EQ(abstained > 100, policy == OutsidePolicy::Unknown) << abstained;
    EXPECT_EQ(beyond > 100, policy == OutsidePolicy::Background) << beyond;
  }
}

TEST(FieldViews, OfABlockItIsThatOfEachPoint)
{
  Execution execution;
  auto captured = viewsOf(torusMesh(48, 24, 0.75, 0.2), swayingRing(4, Size), Size);
  captured.push_back({ "empty", captured[0].projection, captured[0].silhouette });
  std::fill(captured.back().silhouette.pixels.begin(), captured.back().silhouette.pixels.end(), std::uint8_t(0));
  for (const OutsidePolicy policy : { OutsidePolicy::Unknown, OutsidePolicy::Background })
  {
    const PreparedViews views = prepareViews(captured, policy);
    FieldViews fieldViews(views, { unitCube(2.5), 5 }, 4.0);
    fieldViews.addShift(1, Vector2(3.3, -2.1));
    fieldViews.observe(allOf(fieldViews), execution);
    int between = 0;
    for (int block = 0; block < 512; ++block)
    {
      const LatticePoint lowest = fromMorton(std::uint64_t(block) * FieldViews::BlockPoints);
      for (int view = 0; view < views.size(); ++view)
      {
        float inside[FieldViews::BlockPoints];
        const auto region = fieldViews.region(view, lowest, FieldViews::BlockSize);
        const BlockGroups groups(std::uint8_t(37 * block + 11 * view + 1)); // of any kind, none among them
        fieldViews.insideBlock(view, lowest, region, groups, fieldViews.observed(view), inside);
        for (std::size_t n = 0; n < groups.points(); ++n)
        {
          const auto place = fieldViews.place(view, lowest + fromMorton(groups.point(n)));
          ASSERT_NEAR(inside[n], fieldViews.inside(fieldViews.observed(view), place), 1e-4) << block << " " << view << " " << n;
          between += std::abs(inside[n]) < 4.0f;
        }
      }
    }
    EXPECT_GT(between, 5000);
  }
}

/** A camera among the points: some of a block are many times nearer to it than others, and much further apart in its image. */
TEST(FieldViews, OfABlockBesideTheCamera)
{
  Execution execution;
  BinaryImage stripes{ Size, Size, std::vector<std::uint8_t>(std::size_t(Size) * Size, 0) };
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    stripes.pixels[std::size_t(pixel)] = (pixel % Size + pixel / Size) / 6 % 2 == 0;
  }
  const Lattice lattice{ unitCube(2.5), 3 };
  std::vector<View> captured;
  Eigen::Matrix3d axes; // it looks back along the cube's diagonal, from just beyond the last corner of one of these blocks
  axes.row(0) = Vector3(1, -1, 0).normalized();
  axes.row(2) = -Vector3(1, 1, 1).normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  Eigen::Matrix3d inner;
  inner << 15, 0, 0.5 * Size, 0, 15, 0.5 * Size, 0, 0, 1; // px, a wide angle
  for (const double away : { 1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5 }) // octants
  {
    for (const int corner : { 3, 7 })
    {
      const Vector3 centre = lattice.root.origin + (Vector3::Constant(corner) - away * axes.row(2).transpose()) * lattice.leafEdge();
      Projection projection;
      projection << inner * axes, -inner * axes * centre;
      captured.push_back({ "", projection, stripes });
    }
  }
  const PreparedViews views = prepareViews(captured);
  int between = 0;
  for (const int depth : { 3, 5 })
  {
    FieldViews fieldViews(views, { lattice.root, depth }, 4.0);
    fieldViews.observe(allOf(fieldViews), execution);
    for (std::uint64_t block = 0; block < std::uint64_t(1) << 3 * (depth - 2); ++block)
    {
      const LatticePoint lowest = fromMorton(block * FieldViews::BlockPoints);
      for (int view = 0; view < views.size(); ++view)
      {
        float inside[FieldViews::BlockPoints];
        fieldViews.insideBlock(
          view, lowest, fieldViews.region(view, lowest, FieldViews::BlockSize), BlockGroups::all(), fieldViews.observed(view), inside);
        for (std::size_t n = 0; n < FieldViews::BlockPoints; ++n)
        {
          const float expected = fieldViews.inside(fieldViews.observed(view), fieldViews.place(view, lowest + fromMorton(n)));
          ASSERT_NEAR(inside[n], expected, 1e-4) << depth << " " << block << " " << view << " " << n;
          between += std::abs(inside[n]) < 4.0f;
        }
      }
    }
  }
  EXPECT_GT(between, 2000);
}

TEST(FieldViews, SameForAnyNumberOfThreads)
{
  const PreparedViews views = sphereViews(7);
  const auto make = [&](Execution& execution)
  {
    FieldViews fieldViews(views, { unitCube(), 5 }, 5.0);
    fieldViews.observe({ 0, 1, 2, 4, 5, 6 }, execution);
    auto maps = fieldViews.distances(sphereMesh(3, 0.5), execution);
    for (const int view : { 0, 1, 2, 4, 5, 6 })
    {
      maps.push_back(fieldViews.observed(view));
    }
    return maps;
  };
  Execution serial;
  const auto one = make(serial);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = make(execution);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i)
    {
      EXPECT_EQ(many[i].pieces, one[i].pieces);
      EXPECT_EQ(many[i].values, one[i].values);
      EXPECT_FALSE(one[i].empty());
    }
  }
}

/** What has been observed for one lattice, views shifted, serves another, from where the cameras are. */
TEST(FieldViews, LooksAtAnotherLattice)
{
  Execution execution;
  const PreparedViews views = sphereViews(5);
  const Lattice coarse{ unitCube(), 4 }, fine{ unitCube(), 5 };
  FieldViews moved(views, coarse, 2.0, 2.0), made(views, fine, 4.0, 1.0); // the same samples
  moved.observe(allOf(moved), execution);
  made.observe(allOf(made), execution);
  moved.addShift(2, Vector2(3.0, -1.0));
  moved.look(fine, 4.0);
  EXPECT_EQ(moved.reach(), 4.0);
  EXPECT_EQ(moved.lattice().depth, 5);
  for (int view = 0; view < views.size(); ++view)
  {
    EXPECT_TRUE(moved.shift(view).isZero());
    EXPECT_EQ(moved.pixelsPerOctant(view), made.pixelsPerOctant(view));
    for (const LatticePoint& p : somePoints(fine, 500, std::uint64_t(view)))
    {
      EXPECT_EQ(moved.inside(moved.observed(view), moved.place(view, p)), made.inside(made.observed(view), made.place(view, p)));
    }
  }
}
