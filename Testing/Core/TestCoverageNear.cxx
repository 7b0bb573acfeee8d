// SPDX-License-Identifier: BSD-3-Clause
#include "CoverageNear.h"

#include "CellBoxes.h"
#include "CarvingTestCaptures.h"
#include "SurvivorCoverage.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** An octree whose last generation alone is there: the octants that a surface covers, and some of no account. */
Octree coveredOctants(const Lattice& lattice, const Mesh& mesh)
{
  Execution execution;
  Octree all;
  all.lattice = lattice;
  all.generations.resize(std::size_t(lattice.depth) + 1);
  Generation& last = all.generations.back();
  for (std::uint64_t code = 0; code < std::uint64_t(1) << 3 * lattice.depth; ++code)
  {
    last.code.push_back(code);
    last.state.push_back(OctantState::Intersection);
  }
  const auto coverage = survivorCoverage(all, mesh, execution);
  for (std::size_t o = 0; o < coverage.size(); ++o)
  {
    last.state[o] = coverage[o] == Coverage::Lost ? OctantState::Background
      : coverage[o] == Coverage::Enclosed         ? OctantState::Inside
                                                  : OctantState::Intersection;
  }
  return all;
}

std::vector<std::uint64_t> allLost(const Octree& octree, const Mesh& mesh)
{
  Execution execution;
  std::vector<std::uint64_t> lost;
  const auto coverage = survivorCoverage(octree, mesh, execution);
  for (std::size_t o = 0; o < coverage.size(); ++o)
  {
    if (coverage[o] == Coverage::Lost && octree.last().state[o] != OctantState::Background)
    {
      lost.push_back(octree.last().code[o]);
    }
  }
  return lost;
}

/** The boxes that the triangles that differ sweep. */
std::vector<Box> sweptBy(const Mesh& before, const Mesh& after)
{
  std::vector<Box> swept;
  for (const Triangle& t : before.triangles)
  {
    Box box = triangleBox(before.points, t);
    const Box now = triangleBox(after.points, t);
    const bool moves = before.points[t[0]] != after.points[t[0]] || before.points[t[1]] != after.points[t[1]] ||
      before.points[t[2]] != after.points[t[2]];
    if (moves)
    {
      swept.push_back(box.extend(now));
    }
  }
  return swept;
}

} // namespace

/** For a few points that move, for all, and for a surface that shrinks. */
TEST(CoverageNear, LosesWhatTheWholeSurfaceLoses)
{
  Execution execution;
  const Lattice lattice{ unitCube(1.1), 4 };
  int runs = 0, fewer = 0;
  std::size_t most = 0;
  for (const Mesh& before : { torusMesh(40, 20, 0.6, 0.25), sphereMesh(3, 0.7) })
  {
    const Octree octree = coveredOctants(lattice, before);
    ASSERT_TRUE(allLost(octree, before).empty());
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
      Random random(seed);
      Mesh after = before;
      const double share = seed % 3 == 0 ? 1.0 : 0.03, length = seed % 2 == 0 ? 0.15 : 0.4;
      for (auto& p : after.points)
      {
        p *= seed == 12 ? 0.8 : 1.0;
        if (random.uniform(0, 1) < share)
        {
          p += length * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        }
      }
      const std::vector<Box> swept = sweptBy(before, after);
      const CoverageNear near(octree, before, swept, cellsMet(octree.lattice, swept), execution);
      const auto expected = allLost(octree, after);
      EXPECT_EQ(near.lost(after, execution), expected) << seed;
      EXPECT_TRUE(near.lost(before, execution).empty()) << seed;
      most = std::max(most, expected.size());
      runs += !expected.empty();
      // A few points go back: what they sweep, and what was lost, is all that can be lost now.
      Mesh later = after;
      for (std::size_t p = 0; p < later.points.size(); ++p)
      {
        later.points[p] = random.uniform(0, 1) < 0.1 ? before.points[p] : later.points[p];
      }
      std::vector<Box> changed = sweptBy(after, later);
      fewer += changed.size() < before.triangles.size() / 2;
      for (const std::uint64_t code : expected)
      {
        const Vector3 corner = lattice.root.origin + toVector(fromMorton(code)) * lattice.leafEdge();
        changed.emplace_back(corner, corner + Vector3::Constant(lattice.leafEdge()));
      }
      EXPECT_EQ(near.lostWithin(changed, later, execution), near.lost(later, execution)) << seed;
      EXPECT_TRUE(near.lostWithin({}, later, execution).empty());
    }
  }
  EXPECT_GT(runs, 10);
  EXPECT_GT(most, 50u);
  EXPECT_GT(fewer, 10);
}

TEST(CoverageNear, NothingThatMovesLosesNothing)
{
  Execution execution;
  const Mesh sphere = sphereMesh(3, 0.7);
  const Octree octree = coveredOctants({ unitCube(1.1), 4 }, sphere);
  EXPECT_TRUE(CoverageNear(octree, sphere, {}, {}, execution).lost(sphere, execution).empty());
}
