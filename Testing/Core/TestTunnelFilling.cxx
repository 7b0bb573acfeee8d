// SPDX-License-Identifier: BSD-3-Clause
#include "TunnelFilling.h"

#include "CarvingTestCaptures.h"
#include "LabelledSolids.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A slab with a hole of the given size, in corners, through it. */
double drilledSlab(const LatticePoint& p, int width, int length)
{
  const double slab = boxField(p, { 4, 4, 12 }, { 28, 28, 18 });
  return std::min(slab, -boxField(p, { 14, 6, 0 }, { 13 + width, 5 + length, 32 }));
}

std::int64_t genusAfter(LabelledSolid& solid, const TunnelFillingOptions& options)
{
  solid.fill(tunnelWalls(*solid.labels, options, solid.execution));
  const MeshSoundness surface = solid.surface();
  EXPECT_TRUE(surface.genus.has_value());
  EXPECT_EQ(surface.components, 1u);
  return surface.genus.value_or(-1);
}

} // namespace

TEST(TunnelFilling, FillsNarrowTunnelsAndNoOthers)
{
  for (const int width : { 1, 2, 3, 4, 6 })
  {
    LabelledSolid solid(5, [&](const LatticePoint& p) { return drilledSlab(p, width, width); });
    ASSERT_EQ(solid.surface().genus, 1);
    EXPECT_EQ(genusAfter(solid, { true, 3, 1.0 }), width > 3 ? 1 : 0) << width << " corners wide";
  }
  LabelledSolid solid(5, [](const LatticePoint& p) { return drilledSlab(p, 2, 2); });
  EXPECT_TRUE(tunnelWalls(*solid.labels, { false, 3, 1.0 }, solid.execution).empty()) << "off";
  EXPECT_TRUE(tunnelWalls(*solid.labels, { true, 3, 0.0 }, solid.execution).empty()) << "no loop is short";
}

TEST(TunnelFilling, LeavesANarrowHoleWithALongOutline)
{
  for (const int length : { 3, 18 })
  {
    LabelledSolid solid(5, [&](const LatticePoint& p) { return drilledSlab(p, 2, length); });
    EXPECT_EQ(genusAfter(solid, { true, 3, 0.5 }), length > 10 ? 1 : 0) << length << " corners long";
  }
}

/** A ring keeps its own hole and loses those that are drilled through its tube. */
TEST(TunnelFilling, GivesARingItsGenusBack)
{
  for (const int drills : { 1, 2, 3 })
  {
    LabelledSolid solid(5,
      [&](const LatticePoint& p)
      {
        const double x = p.i - 16, y = p.j - 16, z = p.k - 16;
        double value = 4.2 - std::hypot(std::hypot(x, y) - 9.0, z);
        value = std::min(value, std::max(std::abs(y) - 0.5, std::abs(x - 9.0) - 0.6));
        value = drills > 1 ? std::min(value, std::max(std::abs(x) - 0.5, std::abs(y - 9.0) - 1.1)) : value;
        return drills > 2 ? std::min(value, std::max(std::abs(y) - 0.5, std::abs(z) - (x < 0 ? 0.6 : -1.0))) : value;
      });
    ASSERT_EQ(solid.surface().genus, drills + 1);
    EXPECT_EQ(genusAfter(solid, { true, 3, 1.0 }), 1);
  }
}

/** Two bumps that face each other across a gap: narrow there, but no passage. */
TEST(TunnelFilling, LeavesAGapThatIsNarrowInItsMiddle)
{
  LabelledSolid solid(5,
    [](const LatticePoint& p)
    {
      const double plates = std::max({ boxField(p, { 6, 6, 4 }, { 26, 26, 9 }), boxField(p, { 6, 6, 20 }, { 26, 26, 26 }),
        boxField(p, { 6, 6, 4 }, { 9, 26, 26 }) });
      return std::max(plates, boxField(p, { 17, 15, 9 }, { 20, 18, 17 }));
    });
  EXPECT_TRUE(tunnelWalls(*solid.labels, { true, 3, 10.0 }, solid.execution).empty());
  EXPECT_EQ(solid.surface().genus, 0);
}

/** Whatever the labels: only outside corners, never more tunnels, and no survivor is touched since labels only grow. */
TEST(TunnelFilling, NeverMakesATunnel)
{
  Random random(5);
  int filled = 0;
  for (int trial = 0; trial < 12; ++trial)
  {
    const double share = 0.15 + 0.7 * random.uniform();
    std::vector<double> noise(4096);
    for (double& value : noise)
    {
      value = random.uniform();
    }
    LabelledSolid solid(4,
      [&](const LatticePoint& p)
      { return p.i < 16 && p.j < 16 && p.k < 16 ? share - noise[p.i + 16 * (p.j + 16 * p.k)] : -1.0; });
    const MeshSoundness before = solid.surface();
    const auto walls = tunnelWalls(*solid.labels, { true, 2, 2.0 }, solid.execution);
    for (const std::uint64_t point : walls)
    {
      EXPECT_FALSE(solid.labels->insideAt(fromMorton(point)));
      EXPECT_FALSE(solid.octree.lattice.onBorder(fromMorton(point)));
    }
    solid.fill(walls);
    const MeshSoundness after = solid.surface();
    EXPECT_LE(std::int64_t(*after.genus), *before.genus) << "trial " << trial;
    filled += !walls.empty();
  }
  EXPECT_GT(filled, 0);
}

TEST(TunnelFilling, RejectsOptionsOutOfRange)
{
  LabelledSolid solid(3, [](const LatticePoint& p) { return boxField(p, { 2, 2, 2 }, { 5, 5, 5 }); });
  EXPECT_THROW(tunnelWalls(*solid.labels, { true, 0, 1.0 }, solid.execution), InvalidInput);
  EXPECT_THROW(tunnelWalls(*solid.labels, { true, 9, 1.0 }, solid.execution), InvalidInput);
  EXPECT_THROW(tunnelWalls(*solid.labels, { true, 3, -1.0 }, solid.execution), InvalidInput);
}
