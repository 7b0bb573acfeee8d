// SPDX-License-Identifier: BSD-3-Clause
#include "HandleJoining.h"

#include "LabelledSolids.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A ring around the lattice's middle with a cut of `gap` corners, whose field is `depth` below 0 there. */
double cutRing(const LatticePoint& p, int gap, double depth)
{
  const double x = p.i - 16, y = p.j - 16, z = p.k - 16;
  const double ring = 1.6 - std::hypot(std::hypot(x, y) - 10.0, z);
  return x > 0 && p.j >= 16 && p.j < 16 + gap ? std::min(ring, -depth) : ring;
}

std::int64_t genusAfter(LabelledSolid& solid, double deficit, const HandleJoiningOptions& options)
{
  solid.fill(handleJoints(*solid.labels, deficit, options, solid.execution));
  const MeshSoundness surface = solid.surface();
  EXPECT_EQ(surface.components, 1u);
  return surface.genus.value_or(-1);
}

} // namespace

TEST(HandleJoining, JoinsTheEndsOfACutRing)
{
  for (const int gap : { 1, 2, 3 })
  {
    LabelledSolid solid(5, [&](const LatticePoint& p) { return cutRing(p, gap, 0.3); });
    solid.labels->setSurvivors({}); // the field alone tells
    ASSERT_EQ(solid.surface().genus, 0);
    EXPECT_EQ(genusAfter(solid, 0.5, {}), 1) << gap << " corners";
  }
}

TEST(HandleJoining, LeavesApartWhatTheFieldPartsClearly)
{
  LabelledSolid solid(5, [](const LatticePoint& p) { return cutRing(p, 2, 0.8); });
  solid.labels->setSurvivors({});
  EXPECT_EQ(genusAfter(solid, 0.5, {}), 0);
  EXPECT_EQ(genusAfter(solid, 1.0, {}), 1) << "a larger deficit reaches further";
}

/** Deep outside by the field, but the octants on both sides survived and touch. */
TEST(HandleJoining, JoinsSurvivorsThatTouch)
{
  LabelledSolid solid(5, [](const LatticePoint& p) { return cutRing(p, 1, 3.0); });
  EXPECT_EQ(genusAfter(solid, 0.1, {}), 1);
}

TEST(HandleJoining, MakesNoShortLoopAndCanBeSwitchedOff)
{
  LabelledSolid solid(5, [](const LatticePoint& p) { return cutRing(p, 1, 0.3); });
  HandleJoiningOptions options;
  options.loop = 3.0; // longer than the way around the ring
  EXPECT_EQ(genusAfter(solid, 0.5, options), 0);
  options = {};
  options.joinHandles = false;
  EXPECT_EQ(genusAfter(solid, 0.5, options), 0);
  options.joinHandles = true;
  options.reach = -1.0;
  EXPECT_THROW(handleJoints(*solid.labels, 0.5, options, solid.execution), InvalidInput);
  options.reach = 1.0;
  options.loop = -1.0;
  EXPECT_THROW(handleJoints(*solid.labels, 0.5, options, solid.execution), InvalidInput);
}
