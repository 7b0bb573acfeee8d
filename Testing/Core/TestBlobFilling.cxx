// SPDX-License-Identifier: BSD-3-Clause
#include "BlobFilling.h"

#include "CarvingTestCaptures.h"
#include "SilhouetteDissent.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Depth = 5;

std::vector<View> viewsOfKind(int kind, int size)
{
  Random random(50 + kind);
  auto captured = viewsOf(torusMesh(48, 24, 0.6, 0.3), swayingRing(8, size), size);
  BinaryImage& image = captured[1].silhouette;
  for (int row = 0; row < image.height; ++row)
  {
    std::fill(&image.at(size / 2, row), &image.at(size - 1, row) + 1, std::uint8_t(0));
  }
  disturb(captured, kind, random);
  return captured;
}

/** Some single corners and cubes of sides 4 and 8. */
Blobs someBlobs(Random& random)
{
  Blobs blobs;
  for (std::uint64_t block = 0; block < 512; ++block)
  {
    if (block % 8 == 0 && random.uniform() < 0.15)
    {
      blobs.cubes.push_back({ 64 * block, 8 });
      block += 7;
    }
    else if (random.uniform() < 0.1)
    {
      blobs.cubes.push_back({ 64 * block, 4 });
    }
    else if (random.uniform() < 0.3)
    {
      blobs.words.push_back({ block, std::uint64_t(1) << random.below(64) });
    }
  }
  return blobs;
}

std::vector<std::uint64_t> cornersOf(const Blobs& blobs)
{
  std::vector<std::uint64_t> corners = codesOf(blobs.words);
  for (const PointCube& cube : blobs.cubes)
  {
    for (std::uint64_t code = cube.corner; code < cube.end(); ++code)
    {
      corners.push_back(code);
    }
  }
  return corners;
}

/** The corners within reach of some. */
std::set<std::uint64_t> within(const std::vector<std::uint64_t>& corners, int steps, std::int32_t n)
{
  std::set<std::uint64_t> near;
  for (const std::uint64_t corner : corners)
  {
    const LatticePoint p = fromMorton(corner);
    for (int s = 0; s < (2 * steps + 1) * (2 * steps + 1) * (2 * steps + 1); ++s)
    {
      const int side = 2 * steps + 1;
      const LatticePoint q{ p.i + s % side - steps, p.j + s / side % side - steps, p.k + s / side / side - steps };
      if (isOfLattice(q, n))
      {
        near.insert(mortonCode(q));
      }
    }
  }
  return near;
}

/** Fill by asking every view about every point. */
std::uint64_t fillOneByOne(const LatticeViews& fine, int view, const std::set<std::uint64_t>& near, int halvings, BinaryImage& mask)
{
  std::uint64_t filled = 0;
  const std::int32_t size = std::int32_t(1) << halvings;
  for (const std::uint64_t corner : near)
  {
    const LatticePoint p = fromMorton(corner);
    for (std::int32_t s = 0; s < size * size * size; ++s)
    {
      const LatticePoint q{ p.i * size + s % size - size / 2, p.j * size + s / size % size - size / 2, p.k * size + s / size / size - size / 2 };
      if (!isOfLattice(q, fine.lattice().cells()) || dissentAt(fine, q).only != view)
      {
        continue;
      }
      const auto h = fine.projection(view)(q);
      const int column = PreparedView::nearestPixel(h.U / h.W, mask.width), row = PreparedView::nearestPixel(h.V / h.W, mask.height);
      if (column >= 0 && row >= 0 && column < mask.width && row < mask.height && mask.at(column, row) == 0)
      {
        mask.at(column, row) = 1;
        ++filled;
      }
    }
  }
  return filled;
}

} // namespace

TEST(BlobFilling, IsThatOfAllPointsOneByOne)
{
  for (const int kind : { 0, 3, 5 })
  {
    for (const BlobReach reach : { BlobReach{ 0, 1 }, BlobReach{ 1, 3 }, BlobReach{ 2, 2 } })
    {
      Random random(60 + kind + reach.steps);
      const PreparedViews views = prepareViews(viewsOfKind(kind, 110), kind == 3 ? OutsidePolicy::Unknown : OutsidePolicy::Border);
      const LatticeViews fine(views, { unitCube(), Depth + reach.halvings });
      std::vector<Blobs> blobs(std::size_t(views.size()));
      blobs[1] = someBlobs(random);
      blobs[4] = someBlobs(random);
      std::vector<View> filled = copyViews(views), expected = filled;
      ThreadedExecution execution(1 + reach.steps);
      const BlobFilling filling = fillBlobs(fine, blobs, reach, filled, execution);
      for (std::size_t i = 0; i < blobs.size(); ++i)
      {
        const auto near = within(cornersOf(blobs[i]), reach.steps, std::int32_t(1) << Depth);
        EXPECT_EQ(filling.pixels[i], fillOneByOne(fine, int(i), near, reach.halvings, expected[i].silhouette));
        EXPECT_TRUE(filled[i].silhouette.pixels == expected[i].silhouette.pixels) << "view " << i << ", noise " << kind;
      }
      EXPECT_GT(filling.pixels[1], 200u);
    }
  }
}

/** Looks go with pixels: twice as fine, a solid has eight times as many points, its surface and its image about four times. */
TEST(BlobFilling, LooksAreInProportionToSurfaceAndImage)
{
  std::vector<double> looks;
  for (int halvings = 1; halvings <= 3; ++halvings)
  {
    const int size = 64 << halvings;
    const PreparedViews views = prepareViews(viewsOfKind(0, size));
    std::vector<Blobs> blobs(std::size_t(views.size()));
    blobs[1].cubes.push_back({ 0, std::int32_t(1) << Depth });
    std::vector<View> filled = copyViews(views);
    Execution execution;
    const LatticeViews fine(views, { unitCube(), Depth + halvings });
    looks.push_back(double(fillBlobs(fine, blobs, { halvings, 1 }, filled, execution).looks));
    if (halvings > 1)
    {
      EXPECT_LT(looks.back(), 5.0 * looks.end()[-2]) << halvings;
    }
  }
}

TEST(BlobFilling, OfNoBlobsAndOnesThatWantToStop)
{
  const PreparedViews views = prepareViews(viewsOfKind(0, 60));
  const LatticeViews fine(views, { unitCube(), Depth });
  std::vector<View> filled = copyViews(views);
  std::vector<Blobs> blobs(std::size_t(views.size()));
  Execution execution;
  const BlobFilling none = fillBlobs(fine, blobs, { 0, 2 }, filled, execution);
  EXPECT_EQ(none.pixels, std::vector<std::uint64_t>(std::size_t(views.size()), 0));
  EXPECT_EQ(none.looks, 0u);
  blobs[0].words = { { 0, 1 << 7 } };
  CancelledExecution cancelled;
  EXPECT_THROW(fillBlobs(fine, blobs, { 0, 2 }, filled, cancelled), Cancelled);
}
