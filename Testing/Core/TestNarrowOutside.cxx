// SPDX-License-Identifier: BSD-3-Clause
#include "NarrowOutside.h"

#include "CarvingTestCaptures.h"
#include "LabelledSolids.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Does a cube of outside points, `width` + 1 along an edge, begin here? Any does that begins below the lattice. */
bool cubeFits(const LatticeLabels& labels, const LatticePoint& low, int width)
{
  const bool isBelow = std::min({ low.i, low.j, low.k }) < 0;
  for (int n = 0; !isBelow && n < (width + 1) * (width + 1) * (width + 1); ++n)
  {
    if (labels.insideAt(low + LatticePoint{ n % (width + 1), n / (width + 1) % (width + 1), n / (width + 1) / (width + 1) }))
    {
      return false;
    }
  }
  return true;
}

NarrowOutside::Label expectedLabel(const LatticeLabels& labels, const LatticePoint& p, int width)
{
  bool wide = false;
  for (int n = 0; n < (width + 1) * (width + 1) * (width + 1) && !wide; ++n)
  {
    const LatticePoint back{ -(n % (width + 1)), -(n / (width + 1) % (width + 1)), -(n / (width + 1) / (width + 1)) };
    wide = cubeFits(labels, p + back, width);
  }
  return labels.insideAt(p) ? NarrowOutside::Label::Solid : wide ? NarrowOutside::Label::Wide : NarrowOutside::Label::Narrow;
}

void expectAsDefined(const LatticeLabels& labels, int width, Execution& execution)
{
  const NarrowOutside outside(labels, width, execution);
  const NarrowCursor cursor(outside);
  std::vector<std::uint64_t> narrow, blocks((mortonCode({ 16, 16, 16 }) >> 6) + 1);
  std::iota(blocks.begin(), blocks.end(), std::uint64_t(0));
  const std::vector<std::uint64_t> wide = outside.wideOfBlocks(blocks, execution);
  for (std::uint64_t code = 0; code <= mortonCode({ 16, 16, 16 }); ++code)
  {
    const LatticePoint p = fromMorton(code);
    if (std::max({ p.i, p.j, p.k }) > 16)
    {
      continue;
    }
    const NarrowOutside::Label expected = expectedLabel(labels, p, width);
    EXPECT_EQ(cursor.at(p), expected) << p.i << " " << p.j << " " << p.k << ", width " << width;
    EXPECT_EQ(wide[code >> 6] >> (code & 63) & 1, std::uint64_t(expected == NarrowOutside::Label::Wide));
    if (expected == NarrowOutside::Label::Narrow)
    {
      EXPECT_EQ(cursor.find(p), std::ptrdiff_t(narrow.size()));
      narrow.push_back(code);
    }
  }
  EXPECT_EQ(outside.points(), narrow);
  EXPECT_FALSE(narrow.empty());
}

} // namespace

TEST(NarrowOutside, IsWhereNoCubeFits)
{
  for (const int width : { 1, 2, 3, 5 })
  {
    LabelledSolid slots(4,
      [](const LatticePoint& p)
      {
        const double block = boxField(p, { 2, 3, 2 }, { 14, 14, 13 });
        const double slot = std::max(boxField(p, { 5, 0, 4 }, { 5, 9, 20 }), boxField(p, { 8, 8, 0 }, { 12, 12, 20 }));
        return std::min(block, -slot);
      });
    expectAsDefined(*slots.labels, width, slots.execution);
    Random random(11);
    LabelledSolid crumbs(4, [&](const LatticePoint&) { return random.uniform(-1.0, 0.03); });
    expectAsDefined(*crumbs.labels, width, crumbs.execution);
  }
}
