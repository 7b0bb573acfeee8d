// SPDX-License-Identifier: BSD-3-Clause
#include "LabelBlocks.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

/** Point by point: the shell's corners by their labels, others by the field, where it has values, or by the octants around them. */
TEST(LabelBlocks, SayOfEachPointWhatItsCornerFieldOrOctantsSay)
{
  Execution execution;
  for (const bool byField : { false, true })
  {
    Random random(3 + byField);
    const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.25), swayingRing(9, 100), 100));
    const Octree octree = carveViews(views, unitCube(), 5);
    const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
    std::vector<std::uint8_t> corners(shell.corners.size());
    std::generate(corners.begin(), corners.end(), [&] { return std::uint8_t(random.below(2)); });
    std::optional<BrickField> field;
    if (byField)
    {
      field.emplace(octree.lattice, std::vector<std::uint64_t>{ mortonCode({ 9, 17, 15 }), mortonCode({ 20, 3, 30 }) }, 5, execution);
      std::generate(field->values().begin(), field->values().end(), [&] { return float(random.uniform(-1.0, 1.0)); });
    }
    FarLabels far(octree, field ? &*field : nullptr);
    std::set<std::pair<int, std::size_t>> filled; // as if they were cavities
    for (int generation = 1; generation < 5 && !byField; ++generation)
    {
      for (std::size_t i = 0; i < octree.generations[std::size_t(generation)].size(); i += 5)
      {
        if (octree.generations[std::size_t(generation)].state[i] == OctantState::Background)
        {
          far.fillOctant(generation, i);
          filled.emplace(generation, i);
        }
      }
    }
    const LabelBlocks blocks(shell, far, execution);
    std::size_t known = 0, inside = 0;
    for (std::uint64_t block = 0; block <= mortonCode({ 35, 35, 35 }) / 64; ++block)
    {
      const std::ptrdiff_t place = blocks.blocks().find(block);
      OctantCursor octants(octree);
      const std::uint64_t word = place >= 0 ? blocks.inside(std::size_t(place), corners) : 0;
      for (std::uint64_t n = 0; n < 64; ++n)
      {
        const std::uint64_t code = 64 * block + n;
        const LatticePoint p = fromMorton(code);
        if (std::max({ p.i, p.j, p.k }) > octree.lattice.cells())
        {
          continue;
        }
        const std::ptrdiff_t corner = shell.find(code), point = field ? field->find(code) : -1;
        const auto octant = octree.locate(p);
        const bool other = point >= 0 ? field->values()[std::size_t(point)] > 0.0f
          : field                     ? octree.touchesInside(p)
                                      : octant.state == OctantState::Inside || filled.count({ octant.generation, octant.index }) != 0;
        const bool expected = !octree.lattice.onBorder(p) && (corner >= 0 ? corners[std::size_t(corner)] != 0 : other);
        EXPECT_TRUE(place >= 0 || corner < 0);
        if (corner < 0)
        {
          EXPECT_EQ(far.insideAt(p), expected) << p.i << " " << p.j << " " << p.k;
        }
        if (place >= 0)
        {
          EXPECT_EQ((word >> n & 1) != 0, expected) << p.i << " " << p.j << " " << p.k;
          EXPECT_EQ(blocks.inside(std::size_t(place), int(n), corners), expected);
          ++known;
          inside += expected;
        }
      }
    }
    EXPECT_GT(known, 5000u);
    EXPECT_GT(inside, 1000u);
  }
}
