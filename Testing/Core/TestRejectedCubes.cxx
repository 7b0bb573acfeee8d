// SPDX-License-Identifier: BSD-3-Clause
#include "RejectedCubes.h"

#include "CarvingTestCaptures.h"
#include "SilhouetteDissent.h"

#include <gtest/gtest.h>

#include <map>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A ball in a ring of views; the first has lost what is right of its middle, and every view is disturbed. */
std::vector<View> halfMissing(int kind, int size)
{
  Random random(40 + kind);
  auto captured = viewsOf(sphereMesh(3, 0.9), swayingRing(12, size), size);
  BinaryImage& image = captured[0].silhouette;
  for (int row = 0; row < image.height; ++row)
  {
    std::fill(&image.at(size / 2, row), &image.at(size - 1, row) + 1, std::uint8_t(0));
  }
  disturb(captured, kind, random);
  return captured;
}

/** Is there no object within `depth` octants of a point, in a view? */
bool isFreeAround(const LatticeViews& views, int i, const LatticePoint& p, double depth)
{
  const LatticeProjection& projection = views.projection(i);
  const auto h = projection(p);
  const PreparedView& view = views.view(i);
  const double radius = depth * pixelsPerOctant(projection, p);
  for (int row = 0; row < view.height; ++row)
  {
    for (int column = 0; column < view.width; ++column)
    {
      if (view.objectInImage(column, row) && std::hypot(column - h.U / h.W, row - h.V / h.W) <= radius)
      {
        return false;
      }
    }
  }
  return true;
}

} // namespace

TEST(RejectedCubes, HoldOnlyWhatOneViewAloneRejects)
{
  std::size_t found = 0, large = 0;
  for (const int kind : { 0, 1, 3, 5 })
  {
    for (const OutsidePolicy policy : { OutsidePolicy::Border, OutsidePolicy::Unknown, OutsidePolicy::Background })
    {
      const PreparedViews prepared = prepareViews(halfMissing(kind, 90), policy);
      const LatticeViews views(prepared, { unitCube(), 6 });
      const double depth = 0.5;
      RejectedCubes cubes(views, depth);
      std::map<std::uint64_t, std::int32_t> known;
      for (std::uint64_t corner = 0; corner < 64 * 64 * 64; corner += 7)
      {
        const int view = dissentAt(views, fromMorton(corner)).only;
        const PointCube cube = view < 0 ? PointCube{} : cubes.around(corner, view);
        if (cube.side == 0 || !known.emplace(cube.corner, cube.side).second)
        {
          EXPECT_TRUE(cube.side == 0 || known[cube.corner] == cube.side);
          continue;
        }
        EXPECT_TRUE(cube.side >= 4 && corner >= cube.corner && corner < cube.end() && cube.corner % cube.size() == 0);
        for (std::uint64_t code = cube.corner; code < cube.end(); ++code)
        {
          ASSERT_EQ(dissentAt(views, fromMorton(code)).only, view) << kind;
        }
        EXPECT_TRUE(isFreeAround(views, view, fromMorton(cube.corner), depth) && isFreeAround(views, view, fromMorton(cube.end() - 1), depth));
        ++found;
        large += cube.side > 4;
      }
      std::uint64_t end = 0;
      for (const auto& [corner, side] : known) // none overlap
      {
        EXPECT_GE(corner, end);
        end = PointCube{ corner, side }.end();
      }
    }
  }
  EXPECT_GT(found, 100u);
  EXPECT_GT(large, 5u);
}
