// SPDX-License-Identifier: BSD-3-Clause
#include "WideOutside.h"

#include "LabelledSolids.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A hollow box; with `open`, a narrow shaft leads into it. */
double hollowBox(const LatticePoint& p, bool open)
{
  double value = std::min(boxField(p, { 4, 4, 4 }, { 28, 28, 28 }), -boxField(p, { 9, 9, 9 }, { 20, 20, 20 }));
  return open ? std::min(value, -boxField(p, { 14, 14, 15 }, { 15, 15, 32 })) : value;
}

} // namespace

TEST(WideOutside, MeetsAroundTheSolidAndNotThroughIt)
{
  for (const bool open : { false, true })
  {
    LabelledSolid solid(5, [&](const LatticePoint& p) { return hollowBox(p, open); });
    const NarrowOutside narrow(*solid.labels, 3, solid.execution);
    const NarrowCursor cursor(narrow);
    WideOutside wide(*solid.labels, narrow, solid.execution);
    const std::uint32_t within = wide.setOf(LatticePoint{ 10, 10, 10 });
    EXPECT_NE(within, WideOutside::Nowhere);
    EXPECT_EQ(wide.setOf(LatticePoint{ 19, 12, 15 }), within);
    const std::uint32_t without = wide.setOf(LatticePoint{ 2, 15, 15 });
    EXPECT_EQ(wide.setOf(LatticePoint{ 30, 15, 15 }), without);
    EXPECT_EQ(wide.setOf(LatticePoint{ 0, 0, 0 }), without);
    EXPECT_NE(within, without) << "the shaft is narrow";
    EXPECT_EQ(wide.setOf(LatticePoint{ -1, 5, 5 }), without) << "the world beyond";
    EXPECT_EQ(wide.setOf(LatticePoint{ 6, 15, 15 }), WideOutside::Nowhere) << "the solid";
    ASSERT_EQ(narrow.points().empty(), !open);
    // A shaft that is taken from end to end joins what lies within and without.
    for (std::size_t n = 0; n < narrow.points().size(); ++n)
    {
      for (const int a : EdgeNeighbours)
      {
        const LatticePoint q = neighbourOf(fromMorton(narrow.points()[n]), a);
        const auto label = cursor.at(q);
        if (label == NarrowOutside::Label::Wide)
        {
          wide.join(n, q);
        }
        else if (label == NarrowOutside::Label::Narrow)
        {
          wide.join(n, std::size_t(cursor.find(q)));
        }
      }
    }
    EXPECT_EQ(wide.setOf(LatticePoint{ 10, 10, 10 }) == wide.setOf(LatticePoint{ 2, 15, 15 }), open);
    EXPECT_TRUE(!open || wide.setOf(std::size_t(0)) == wide.setOf(LatticePoint{ 2, 15, 15 }));
  }
}
