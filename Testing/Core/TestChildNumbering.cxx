// SPDX-License-Identifier: BSD-3-Clause
#include "ChildNumbering.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

/** One after another, for few octants and for more than one run of them. */
TEST(ChildNumbering, CountsTheIntersectionOctantsBefore)
{
  Random random(3);
  for (const std::size_t count : { 0, 1, 7, 4096, 4097, 30000 })
  {
    Generation generation;
    std::vector<std::uint32_t> expected;
    std::uint32_t before = 0;
    for (std::size_t n = 0; n < count; ++n)
    {
      const double chance = random.uniform();
      generation.code.push_back(n);
      generation.state.push_back(chance < 0.5 ? OctantState::Intersection : chance < 0.8 ? OctantState::Background : OctantState::Inside);
      expected.push_back(before);
      before += generation.state.back() == OctantState::Intersection;
    }
    for (const int threads : { 1, 2, 8 })
    {
      ThreadedExecution execution(threads);
      Generation own = generation;
      own.childBlock.assign(count, 99); // whatever was there
      numberChildren(own, execution);
      EXPECT_EQ(own.childBlock, expected) << count << " octants, " << threads << " threads";
    }
  }
}
