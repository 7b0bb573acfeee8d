// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorCovering.h"

#include "CarvingTestCaptures.h"
#include "LatticeRegions.h"
#include "LostCovering.h"
#include "UnionFind.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

TEST(SurvivorCovering, GivesEverySurvivorAnInsideCornerAndEveryComponentOneSolid)
{
  Execution execution;
  for (int kind = 0; kind <= 5; ++kind)
  {
    Random random(80 + kind);
    auto captured = viewsOf(torusMesh(48, 24, 0.75, kind == 0 ? 0.04 : 0.2), swayingRing(9, 100), 100);
    disturb(captured, kind, random);
    const PreparedViews views = prepareViews(captured);
    const Octree octree = carveViews(views, unitCube(), 5, kind == 4 ? 3 : 0);
    const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
    LatticeLabels labels(octree, shell, views, execution);
    const auto before = labels.inside();
    const CoveringResult result = coverSurvivors(labels, {}, 0, nullptr, execution);
    EXPECT_GT(result.coveredCells.size(), 0u);
    std::set<std::uint32_t> added(result.coveringCorners.begin(), result.coveringCorners.end());
    EXPECT_EQ(added.size(), result.coveringCorners.size());
    for (std::uint32_t c = 0; c < shell.corners.size(); ++c)
    {
      EXPECT_EQ(labels.inside()[c], before[c] || added.count(c)) << "labels only grow, and only by what is told";
      EXPECT_FALSE(added.count(c) && octree.lattice.onBorder(fromMorton(shell.corners[c])));
    }
    // Every survivor's inside corners belong to one component of the whole lattice, flooded point by point.
    UnionFind solid(33 * 33 * 33);
    const auto number = [](const LatticePoint& p) { return std::uint32_t(p.i + 33 * (p.j + 33 * p.k)); };
    for (int n = 0; n < 33 * 33 * 33 * 27; ++n)
    {
      const LatticePoint p{ n / 27 % 33, n / 27 / 33 % 33, n / 27 / 33 / 33 };
      const LatticePoint step{ n % 3 - 1, n / 3 % 3 - 1, n / 9 % 3 - 1 }, q = p + step;
      const bool near = std::abs(step.i) + std::abs(step.j) + std::abs(step.k) <= 2;
      const bool within = q.i >= 0 && q.j >= 0 && q.k >= 0 && q.i < 33 && q.j < 33 && q.k < 33;
      if (near && within && labels.insideAt(p) && labels.insideAt(q))
      {
        solid.unite(number(p), number(q));
      }
    }
    std::set<std::uint32_t> components;
    for (const auto& corners : shell.cellCorners)
    {
      std::set<std::uint32_t> own;
      for (const std::uint32_t corner : corners)
      {
        if (labels.inside()[corner])
        {
          own.insert(solid.find(number(fromMorton(shell.corners[corner]))));
        }
      }
      EXPECT_EQ(own.size(), 1u);
      components.insert(own.begin(), own.end());
    }
    EXPECT_LE(components.size(), countSurvivorComponents(octree, execution)) << "noise " << kind;
  }
}

TEST(SurvivorCovering, SaysWhetherItMayHaveEnclosedACavity)
{
  Execution execution;
  int enclosing = 0, others = 0;
  for (int scene = 0; scene < 40; ++scene)
  {
    Random random(scene);
    auto captured = viewsOf(torusMesh(48, 24, 0.75, random.uniform(0.1, 0.4)), swayingRing(7 + scene % 3, 100), 100);
    disturb(captured, scene % 4, random);
    const PreparedViews views = prepareViews(captured);
    const Octree octree = carveViews(views, unitCube(), 4);
    LatticeLabels labels(
      octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), views, execution);
    fillCavities(labels, execution);
    const CoveringResult result = coverSurvivors(labels, {}, 0, nullptr, execution);
    others += !result.coveringCorners.empty() && !result.mayEnclose;
    enclosing += result.mayEnclose;
    const std::uint64_t cavities = fillCavities(labels, execution);
    EXPECT_TRUE(result.mayEnclose || cavities == 0) << scene << ": " << cavities;
  }
  EXPECT_GT(others, 5);
  EXPECT_GT(enclosing, 5);
}

TEST(SurvivorCovering, CanBeCancelledAtAnyTime)
{
  Execution execution;
  const PreparedViews views = disturbedTorus(4);
  const Octree octree = carveViews(views, unitCube(), 5);
  const LatticeLabels labels(octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), views, execution);
  LatticeLabels covered = labels;
  const auto lost = coverSurvivors(covered, {}, 0, nullptr, execution).coveredCells;
  covered = labels;
  StoppedAt covering(1 << 30), never(1 << 30);
  coverLost(covered, lost, nullptr, covering);
  covered = labels;
  coverSurvivors(covered, {}, 0, nullptr, never);
  EXPECT_GE(never.asked(), covering.asked() + 4) << "what joins them asks, too";
  for (int last = 0; last < never.asked(); last += 1 + never.asked() / 8)
  {
    LatticeLabels own = labels;
    StoppedAt stopped(last);
    EXPECT_THROW(coverSurvivors(own, {}, 0, nullptr, stopped), Cancelled) << last;
  }
}
