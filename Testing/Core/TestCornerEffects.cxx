// SPDX-License-Identifier: BSD-3-Clause
#include "CornerEffects.h"

#include "LabelledSolids.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Two boxes with a layer of points between them, and a ring beside. */
double boxesAndRing(const LatticePoint& p)
{
  const double boxes = std::max(boxField(p, { 4, 4, 4 }, { 8, 8, 8 }), boxField(p, { 10, 4, 4 }, { 14, 8, 8 }));
  const double ring = std::min(boxField(p, { 4, 14, 14 }, { 14, 24, 16 }), -boxField(p, { 8, 18, 10 }, { 8, 18, 20 }));
  return std::max(boxes, ring);
}

struct Scene
{
  LabelledSolid solid{ 5, boxesAndRing };
  SolidComponents components{ *solid.labels, solid.execution };

  std::uint32_t corner(const LatticePoint& p) const { return std::uint32_t(solid.labels->shell().find(mortonCode(p))); }
};

} // namespace

TEST(CornerEffects, AreWhatLabellingTheCornerDoes)
{
  Scene scene;
  CornerEffects effects(*scene.solid.labels, nullptr);
  const std::pair<LatticePoint, CornerEffect> cases[] = { { { 6, 6, 9 }, CornerEffect::Nothing }, { { 9, 6, 6 }, CornerEffect::Joins },
    { { 20, 6, 6 }, CornerEffect::Founds }, { { 8, 18, 15 }, CornerEffect::Otherwise } };
  for (const auto& [p, expected] : cases)
  {
    EXPECT_EQ(effects.of(scene.corner(p), scene.components), expected) << p.i;
    EXPECT_EQ(effects.of(scene.corner(p), scene.components), expected) << "asked again";
    EXPECT_EQ(effects.support(scene.corner(p)), scene.solid.labels->support()[scene.corner(p)]);
  }
}

/** Beside a corner that was labelled, effects are others; and once components have met, joining them makes a tunnel. */
TEST(CornerEffects, FollowTheLabelsAndTheComponents)
{
  Scene scene;
  CornerEffects effects(*scene.solid.labels, nullptr);
  const std::uint32_t lone = scene.corner({ 20, 6, 6 }), beside = scene.corner({ 21, 6, 6 });
  ASSERT_EQ(effects.of(beside, scene.components), CornerEffect::Founds);
  scene.solid.labels->setInside(lone);
  const auto around = effects.setInside(lone);
  EXPECT_EQ(around[14], std::ptrdiff_t(beside));
  EXPECT_EQ(around[13], -1);
  EXPECT_EQ(effects.of(beside, scene.components), CornerEffect::Nothing);
  const std::uint32_t between = scene.corner({ 9, 6, 6 });
  ASSERT_EQ(effects.of(between, scene.components), CornerEffect::Joins);
  std::array<std::ptrdiff_t, 27> sides;
  sides.fill(-1);
  sides[12] = scene.corner({ 8, 6, 6 });
  sides[14] = scene.corner({ 10, 6, 6 });
  scene.components.add(between, sides);
  EXPECT_EQ(effects.of(between, scene.components), CornerEffect::Otherwise);
}

/** Support is asked for among several, and what they cover only where that is equal. */
TEST(CornerEffects, OfEqualsTheBestHasMostSupportThenCoversMostThenComesFirst)
{
  const std::uint32_t equals[] = { 4, 1, 3, 2 };
  const auto best = [&](std::vector<float> supports, std::vector<int> covers, std::size_t count = 4)
  { return bestOfEquals(equals, count, [&](std::uint32_t c, float) { return supports.at(c); }, [&](std::uint32_t c) { return covers.at(c); }); };
  EXPECT_EQ(best({}, {}, 1), 4u) << "nothing is asked";
  EXPECT_EQ(best({ 0.0f, -1.0f, -0.5f, -2.0f, -3.0f }, {}), 2u) << "no cover is asked for";
  EXPECT_EQ(best({ 0.0f, -1.0f, -1.0f, -1.0f, -3.0f }, { 0, 5, 5, 7, 9 }), 3u);
  EXPECT_EQ(best({ 0.0f, -1.0f, -1.0f, -1.0f, -1.0f }, { 0, 6, 6, 6, 6 }), 1u);
}
