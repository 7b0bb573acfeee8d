// SPDX-License-Identifier: BSD-3-Clause
#include "NearOctants.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace silhouette;
using namespace silhouette::test;

TEST(NearOctants, AreThoseOfLookingAtEach)
{
  constexpr int Cells = 16;
  Random random(11);
  int near = 0, far = 0;
  for (int trial = 0; trial < 4000; ++trial)
  {
    std::vector<std::uint64_t> octants;
    for (int n = 0; n < trial % 7; ++n)
    {
      octants.push_back(mortonCode({ int(random.uniform(0.0, Cells)), int(random.uniform(0.0, Cells)), int(random.uniform(0.0, Cells)) }));
    }
    std::sort(octants.begin(), octants.end());
    const int ring = trial % 4;
    // Beyond the lattice, too; and every other time about where it is decided.
    Vector3 p(random.uniform(-2.0, Cells + 2.0), random.uniform(-2.0, Cells + 2.0), random.uniform(-2.0, Cells + 2.0));
    if (trial % 2 == 0 && !octants.empty())
    {
      p = toVector(fromMorton(octants.front())) + Vector3(random.uniform(), random.uniform(), random.uniform());
      const int axis = trial % 3;
      p[axis] = std::floor(p[axis]) + (random.uniform() < 0.5 ? 1.0 + ring : -ring) + random.uniform(-0.003, 0.003);
    }
    const bool expected = std::any_of(octants.begin(), octants.end(),
      [&](std::uint64_t code) { return (p - toVector(fromMorton(code)) - Vector3::Constant(0.5)).cwiseAbs().maxCoeff() <= 0.5 + ring + 1e-3; });
    EXPECT_EQ(isNearOctant(octants, p, ring, Cells), expected) << trial;
    (expected ? near : far) += 1;
  }
  EXPECT_GT(near, 500);
  EXPECT_GT(far, 500);
}
