// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceNesting.h"

#include "CarvingTestCaptures.h"
#include "CellSafety.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** The surface of labels on a whole lattice. */
struct Labelled
{
  template <typename Inside>
  Labelled(int depth, const Inside& isInside)
    : lattice{ { Vector3::Zero(), std::ldexp(1.0, depth) }, depth }
  {
    std::vector<std::uint64_t> cells(std::size_t(1) << 3 * depth);
    for (std::size_t c = 0; c < cells.size(); ++c)
    {
      cells[c] = c;
    }
    shell = makeCornerShell(std::move(cells), execution);
    for (const auto code : shell.corners)
    {
      const LatticePoint p = fromMorton(code);
      inside.push_back(!lattice.onBorder(p) && isInside(p));
    }
    surface = contour(shell, inside, execution);
    fractions.assign(surface.edges.size(), 0.5);
  }
  MeshSoundness soundness() { return assessMesh(placePoints(lattice, shell, surface, fractions, false, execution), execution); }

  Execution execution;
  Lattice lattice;
  CornerShell shell;
  std::vector<std::uint8_t> inside;
  LatticeSurface surface;
  std::vector<double> fractions;
};

int distanceFrom(const LatticePoint& p, int centre)
{
  return std::max({ std::abs(p.i - centre), std::abs(p.j - centre), std::abs(p.k - centre) });
}

} // namespace

TEST(SurfaceNesting, ShellsWithinShellsAndASolidBeside)
{
  // Cubes about (13, 13, 13): solid to 1, empty to 3, solid to 5, empty to 7, solid to 9; and a corner far away.
  Labelled labelled(5,
    [](const LatticePoint& p)
    {
      const int d = distanceFrom(p, 13);
      return d <= 1 || (d >= 4 && d <= 5) || (d >= 8 && d <= 9) || p == LatticePoint{ 29, 13, 13 };
    });
  const auto nesting = nestSurface(labelled.shell, labelled.surface);
  ASSERT_EQ(nesting.parent.size(), 6u);
  std::vector<int> depths;
  for (std::uint32_t c = 0; c < 6; ++c)
  {
    int depth = 0;
    for (std::uint32_t at = c; nesting.parent[at] != NoComponent; at = nesting.parent[at])
    {
      ++depth;
    }
    EXPECT_EQ(nesting.cavity[c], depth % 2) << "walls of solids and of cavities in turn";
    depths.push_back(depth);
  }
  std::sort(depths.begin(), depths.end());
  EXPECT_EQ(depths, (std::vector<int>{ 0, 0, 1, 2, 3, 4 }));
  EXPECT_NE(nesting.solidAt({ 13, 13, 13 }), nesting.solidAt({ 13, 13, 9 }));
  EXPECT_EQ(nesting.solidAt({ 8, 13, 13 }), nesting.solidAt({ 13, 18, 13 }));
  EXPECT_NE(nesting.solidAt({ 29, 13, 13 }), nesting.solidAt({ 22, 13, 13 }));
  EXPECT_EQ(nesting.solidAt({ 13, 13, 30 }), NoComponent);

  std::vector<std::uint8_t> keep(6);
  for (std::uint32_t c = 0; c < 6; ++c)
  {
    keep[c] = nesting.parent[c] == NoComponent;
  }
  EXPECT_EQ(labelled.soundness().components, 6u);
  keepComponents(nesting, keep, labelled.surface, labelled.fractions);
  const MeshSoundness filled = labelled.soundness();
  EXPECT_EQ(filled.components, 2u);
  EXPECT_EQ(filled.unusedPoints, 0u);
  EXPECT_EQ(labelled.surface.cellEnd.back(), labelled.surface.triangles.size());
  EXPECT_GT(filled.volume, 18.0 * 18.0 * 18.0) << "the outer cube is full";
}

/** Against flood filling: any labels have as many outer walls as solids not in a cavity, and their volume is that of the filled ones. */
TEST(SurfaceNesting, RandomLabels)
{
  Random random(99);
  for (int run = 0; run < 60; ++run)
  {
    const double share = random.uniform(0.2, 0.97);
    Labelled labelled(3, [&](const LatticePoint&) { return random.uniform() < share; });
    // Outside corners that the border reaches through lattice edges; the others are in cavities.
    std::vector<std::uint8_t> open(labelled.inside.size(), 0);
    for (bool changed = true; changed;)
    {
      changed = false;
      for (std::size_t c = 0; c < open.size(); ++c)
      {
        const LatticePoint p = fromMorton(labelled.shell.corners[c]);
        bool reached = labelled.lattice.onBorder(p);
        for (int n = 0; n < 6 && !reached; ++n)
        {
          const int step = n % 2 ? 1 : -1;
          const auto other = labelled.shell.find(
            mortonCode({ p.i + (n / 2 == 0) * step, p.j + (n / 2 == 1) * step, p.k + (n / 2 == 2) * step }));
          reached = open[std::size_t(other)] != 0;
        }
        if (!labelled.inside[c] && reached && !open[c])
        {
          open[c] = 1;
          changed = true;
        }
      }
    }
    std::vector<std::uint8_t> filled(open.size());
    std::transform(open.begin(), open.end(), filled.begin(), [](std::uint8_t o) { return std::uint8_t(!o); });
    const LatticeSurface expected = contour(labelled.shell, filled, labelled.execution);
    const auto nesting = nestSurface(labelled.shell, labelled.surface);
    std::vector<std::uint8_t> keep(nesting.parent.size());
    for (std::size_t c = 0; c < keep.size(); ++c)
    {
      keep[c] = nesting.parent[c] == NoComponent;
      EXPECT_FALSE(keep[c] && nesting.cavity[c]);
    }
    keepComponents(nesting, keep, labelled.surface, labelled.fractions);
    ASSERT_EQ(labelled.surface.edges.size(), expected.edges.size());
    for (std::size_t e = 0; e < expected.edges.size(); ++e)
    {
      EXPECT_EQ(labelled.surface.edges[e].inside, expected.edges[e].inside);
      EXPECT_EQ(labelled.surface.edges[e].outside, expected.edges[e].outside);
    }
  }
}
