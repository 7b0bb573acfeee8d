// SPDX-License-Identifier: BSD-3-Clause
#include "OctantCover.h"

#include "CarvingTestCaptures.h"
#include "SilhouetteRendering.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 200, Depth = 6;

LatticeProjection viewOf(int n)
{
  return LatticeProjection(swayingRing(7, Size)[std::size_t(n)], { unitCube(), Depth });
}

/** For each pixel of a window how often it is held. */
std::vector<std::int32_t> heldOf(const CoverCount& count)
{
  std::vector<std::int32_t> all;
  count.forRows([&](int, const std::int32_t* held) { all.insert(all.end(), held, held + count.window().width()); });
  return all;
}

CoverCount countOf(const ImageWindow& window)
{
  CoverCount count;
  count.begin(window);
  return count;
}

/** Octants of a size, drawn at random. */
std::vector<LatticePoint> someOctants(int number, std::int32_t size, int seed)
{
  Random random(seed);
  const int places = (1 << Depth) / size;
  std::vector<LatticePoint> octants;
  for (int n = 0; n < number; ++n)
  {
    octants.push_back({ random.below(places) * size, random.below(places) * size, random.below(places) * size });
  }
  return octants;
}

/** Where lattice points fall that lie in an octant of a size, many of them. */
template <typename Work>
void forPlacesIn(const LatticeProjection& projection, const LatticePoint& lowest, std::int32_t size, int steps, const Work& work)
{
  const auto& step = projection.step;
  const HomogeneousPixel corner = projection(lowest);
  for (int n = 0; n < (steps + 1) * (steps + 1) * (steps + 1); ++n)
  {
    const double d[3] = { double(n % (steps + 1)) * size / steps, double(n / (steps + 1) % (steps + 1)) * size / steps,
      double(n / (steps + 1) / (steps + 1)) * size / steps };
    double h[3] = { corner.U, corner.V, corner.W };
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int row = 0; row < 3; ++row)
      {
        h[row] += d[axis] * step[axis][row];
      }
    }
    work(h[0] / h[2], h[1] / h[2]);
  }
}

} // namespace

TEST(OctantCover, BoxesAndWhatTheyHold)
{
  CoverCount count = countOf({ 10, 20, 5, 12 });
  count.add(11.0, 13.4, 6.0, 6.0); // columns 11 to 13
  count.add(13.4, 13.4, 4.0, 7.6); // rows 5, where the window begins, to 8
  count.add(19.6, 30.0, 0.0, 90.0); // beyond 19, the last
  std::vector<std::int32_t> expected(10 * 7, 0);
  for (const int column : { 1, 2, 3 })
  {
    ++expected[std::size_t(10 + column)];
  }
  for (const int row : { 0, 1, 2, 3 })
  {
    ++expected[std::size_t(10 * row + 3)];
  }
  EXPECT_EQ(heldOf(count), expected);
}

TEST(OctantCover, LeavesHoldThePixelsOfAllOfTheirPlaces)
{
  const ImageWindow window{ 0, Size, 0, Size };
  for (int view = 0; view < 7; ++view)
  {
    const LatticeProjection projection = viewOf(view);
    CoverCount all = countOf(window);
    std::vector<std::uint8_t> met(Size * Size, 0);
    OctantBlock block;
    for (const LatticePoint& octant : someOctants(200, 1, view))
    {
      block.add(octant);
      forPlacesIn(projection, octant, 1, 3,
        [&](double u, double v)
        {
          if (u >= 0.0 && v >= 0.0 && u < Size && v < Size)
          {
            met[std::size_t(v) * Size + std::size_t(u)] = 1;
          }
        });
    }
    addLeaves(projection, 1.0, block, all); // the middle's camera is not quite the octant's
    EXPECT_EQ(block.count, 0);
    const auto held = heldOf(all);
    for (std::size_t n = 0; n < met.size(); ++n)
    {
      ASSERT_TRUE(held[n] > 0 || met[n] == 0) << view << ", pixel " << n % Size << ", " << n / Size;
    }
  }
}

TEST(OctantCover, AWindowIsAPartOfTheImage)
{
  const ImageWindow part{ 60, 131, 47, 160 };
  for (int view = 0; view < 7; ++view)
  {
    CoverCount whole = countOf({ 0, Size, 0, Size }), window = countOf(part);
    for (CoverCount* count : { &whole, &window })
    {
      for (const std::int32_t size : { 16, 4, 1 })
      {
        OctantBlock block;
        for (const LatticePoint& octant : someOctants(60, size, 100 + view))
        {
          block.add(octant);
        }
        size == 1 ? addLeaves(viewOf(view), 0.3, block, *count) : addOctants(viewOf(view), size, block, *count);
      }
    }
    const auto all = heldOf(whole), some = heldOf(window);
    for (int row = 0; row < part.height(); ++row)
    {
      for (int column = 0; column < part.width(); ++column)
      {
        ASSERT_EQ(some[std::size_t(row * part.width() + column)] > 0, all[std::size_t((row + part.top) * Size + column + part.left)] > 0)
          << view << ": " << column << ", " << row;
      }
    }
  }
}

TEST(OctantCover, OctantsBehindOthersChangeNothing)
{
  const ImageWindow window{ 0, Size, 0, Size };
  for (int view = 0; view < 7; ++view)
  {
    // Together, the large ones first, and each alone, so that none is behind another.
    CoverCount together = countOf(window);
    std::vector<std::uint8_t> alone(Size * Size, 0);
    std::size_t pixels = 0;
    for (const std::int32_t size : { 32, 8, 4, 2 })
    {
      OctantBlock block;
      for (const LatticePoint& octant : someOctants(50, size, 10 * view + size))
      {
        block.add(octant);
        CoverCount one = countOf(window);
        OctantBlock single;
        single.add(octant);
        addOctants(viewOf(view), size, single, one);
        const auto held = heldOf(one);
        for (std::size_t n = 0; n < held.size(); ++n)
        {
          alone[n] |= held[n] > 0;
          pixels += std::size_t(held[n]);
        }
      }
      addOctants(viewOf(view), size, block, together);
    }
    const auto held = heldOf(together);
    std::size_t sum = 0;
    for (std::size_t n = 0; n < held.size(); ++n)
    {
      ASSERT_EQ(held[n] > 0, alone[n] != 0) << view << ", pixel " << n % Size << ", " << n / Size;
      sum += std::size_t(held[n]);
    }
    EXPECT_LT(sum, pixels) << "some were left out";
  }
}

TEST(OctantCover, AnOctantIsItsSilhouetteButForItsBorder)
{
  const Lattice lattice{ unitCube(), Depth };
  for (int view = 0; view < 7; ++view)
  {
    const LatticePoint lowest{ 16, 24, 32 };
    const Mesh box = boxMesh(lattice.position(lowest), lattice.position(lowest + LatticePoint{ 16, 16, 16 }));
    const BinaryImage exact = renderSilhouette(box, swayingRing(7, Size)[std::size_t(view)], Size, Size);
    CoverCount count = countOf({ 0, Size, 0, Size });
    OctantBlock block;
    block.add(lowest);
    addOctants(viewOf(view), 16, block, count);
    const auto held = heldOf(count);
    int more = 0, object = 0;
    for (std::size_t n = 0; n < held.size(); ++n)
    {
      ASSERT_TRUE(held[n] > 0 || exact.pixels[n] == 0);
      more += held[n] > 0 && exact.pixels[n] == 0;
      object += exact.pixels[n];
    }
    EXPECT_GT(object, 500);
    EXPECT_LT(more, 0.1 * object) << "columns are held where their pixels' squares are met";
  }
}

TEST(OctantCover, NothingBehindTheCamera)
{
  LatticeProjection behind = viewOf(0);
  for (int row = 0; row < 3; ++row)
  {
    behind.constant[std::size_t(row)] *= -1.0;
    for (auto& step : behind.step)
    {
      step[std::size_t(row)] *= -1.0;
    }
  }
  CoverCount count = countOf({ 0, Size, 0, Size });
  OctantBlock block;
  block.add({ 30, 30, 30 });
  addLeaves(behind, 1.0, block, count);
  block.add({ 16, 16, 16 });
  addOctants(behind, 16, block, count);
  EXPECT_EQ(heldOf(count), std::vector<std::int32_t>(Size * Size, 0));
  Vector2 corners[8];
  EXPECT_FALSE(projectOctant(behind, { 30, 30, 30 }, 1, corners));
}

/** Where an octant is held, its leaves bare nothing that was not: all pixels that they would add are held already. */
TEST(OctantCover, WhatLiesInAHeldOctantAddsNothing)
{
  std::size_t held = 0, free = 0;
  for (int view = 0; view < 7; ++view)
  {
    const LatticeProjection projection = viewOf(view);
    for (const double reach : { 0.0, 1.7 })
    {
      CoverCount count = countOf({ 30, 170, 20, 180 });
      OctantBlock block;
      for (const LatticePoint& octant : someOctants(5, 16, 300 + view))
      {
        block.add(octant);
      }
      addOctants(projection, 16, block, count);
      std::vector<std::int32_t> before = heldOf(count);
      for (const LatticePoint& octant : someOctants(400, 4, 400 + view))
      {
        const bool isHeld = isOctantHeld(projection, octant, 4, reach, count);
        (isHeld ? held : free) += 1;
        if (!isHeld)
        {
          continue;
        }
        for (int n = 0; n < 64; ++n)
        {
          block.add({ octant.i + n % 4, octant.j + n / 4 % 4, octant.k + n / 16 });
        }
        CoverCount own = count;
        addLeaves(projection, reach, block, own);
        const auto after = heldOf(own);
        for (std::size_t n = 0; n < after.size(); ++n)
        {
          ASSERT_EQ(after[n] > 0, before[n] > 0) << view << ", pixel " << n;
        }
      }
    }
  }
  EXPECT_GT(held, 200u);
  EXPECT_GT(free, 200u);
}
