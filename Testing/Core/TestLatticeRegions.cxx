// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeRegions.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Components of the given cells or corners of a cube of n, by flooding; neighbours differ in at most `reach` coordinates. */
template <typename Member>
int floodComponents(int n, int reach, const Member& member)
{
  std::vector<int> done(std::size_t(n) * n * n, 0);
  int count = 0;
  for (int seed = 0; seed < n * n * n; ++seed)
  {
    if (done[seed] || !member(LatticePoint{ seed % n, seed / n % n, seed / n / n }))
    {
      continue;
    }
    ++count;
    std::vector<int> stack = { seed };
    done[seed] = 1;
    while (!stack.empty())
    {
      const int at = stack.back();
      stack.pop_back();
      for (int d = 0; d < 27; ++d)
      {
        const int dx = d % 3 - 1, dy = d / 3 % 3 - 1, dz = d / 9 - 1;
        const LatticePoint q{ at % n + dx, at / n % n + dy, at / n / n + dz };
        const bool within = q.i >= 0 && q.j >= 0 && q.k >= 0 && q.i < n && q.j < n && q.k < n;
        const int index = q.i + n * (q.j + n * q.k);
        if (within && std::abs(dx) + std::abs(dy) + std::abs(dz) <= reach && !done[index] && member(q))
        {
          done[index] = 1;
          stack.push_back(index);
        }
      }
    }
  }
  return count;
}

/** Two rings of views see the gap between two shells: with a vote allowed, a cavity stays. */
std::vector<View> annulusViews()
{
  std::vector<View> views;
  const int size = 100;
  for (const auto& camera : axisCameras(38.0, size))
  {
    View view{ "annulus", camera, { size, size, {} } };
    for (int i = 0; i < size * size; ++i)
    {
      const double r = std::hypot(i % size - 0.5 * (size - 1), i / size - 0.5 * (size - 1)) / 38.0;
      view.silhouette.pixels.push_back(r < 1.0 && r > 0.45);
    }
    views.push_back(view);
  }
  views.resize(2);
  View disc = views[0];
  disc.projection = axisCameras(38.0, size)[2];
  for (int i = 0; i < size * size; ++i)
  {
    disc.silhouette.pixels[i] = std::hypot(i % size - 49.5, i / size - 49.5) / 38.0 < 1.0;
  }
  views.push_back(disc);
  return views;
}

} // namespace

TEST(LatticeRegions, SolidSurvivorsAndCavitiesAgreeWithFlooding)
{
  Execution execution;
  for (int kind = 0; kind <= 5; ++kind)
  {
    Random random(60 + kind);
    auto captured = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 120), 120);
    disturb(captured, kind, random);
    const PreparedViews views = prepareViews(captured);
    const Octree octree = carveViews(views, unitCube(), 5, kind == 4 ? 3 : kind % 2);
    const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
    LatticeLabels labels(octree, shell, views, execution);
    EXPECT_EQ(countSurvivorComponents(octree, execution),
      std::uint64_t(floodComponents(
        32, 3, [&](const LatticePoint& p) { return octree.locate(p).state != OctantState::Background; })));
    BlockRegions solid = connectRegions(labels, true, execution);
    SolidComponents components(labels, execution);
    std::set<std::uint32_t> ofCorners;
    std::set<std::uint32_t> roots;
    for (std::uint32_t c = 0; c < shell.corners.size(); ++c)
    {
      if (labels.inside()[c])
      {
        roots.insert(solid.find(solid.at(shell.corners[c])));
        ofCorners.insert(components.of(c));
      }
    }
    const auto inside = [&](const LatticePoint& p) { return labels.insideAt(p); };
    const auto outside = [&](const LatticePoint& p) { return !labels.insideAt(p); };
    EXPECT_EQ(int(roots.size()), floodComponents(33, 2, inside));
    EXPECT_EQ(ofCorners.size(), roots.size());
    const int cavities = floodComponents(33, 1, outside) - 1;
    EXPECT_EQ(fillCavities(labels, execution), std::uint64_t(cavities)) << "noise " << kind;
    EXPECT_EQ(floodComponents(33, 1, outside), 1);
    EXPECT_EQ(fillCavities(labels, execution), 0u);
  }
}

TEST(LatticeRegions, CavitiesOfAFieldThatReachesIntoBackgroundOctantsAgreeWithFlooding)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(3, 0.4), axisCameras(100.0, 240), 240));
  const Octree octree = carveViews(views, unitCube(), 5);
  const int n = octree.lattice.cells();
  Random random(77);
  int found = 0, entered = 0;
  for (int round = 0; round < 8; ++round)
  {
    // A ball, larger than what was carved, whose rind has holes: some are cavities, some reach the world beyond.
    const std::vector<std::uint64_t> leaves = leafCells(octree, OctantState::Intersection);
    BrickField field(octree.lattice, leaves, 8, execution);
    for (std::size_t at = 0; at < field.size(); ++at)
    {
      const LatticePoint p = fromMorton(field.code(at));
      const double radius = (Vector3(p.i, p.j, p.k) - Vector3::Constant(n / 2)).norm();
      const bool hole = radius > 8.0 && random.below(12) == 0;
      field.values()[at] = float(hole ? -0.5 : 11.0 - radius);
    }
    std::vector<std::uint64_t> cells = leaves;
    for (std::uint64_t cell = 0; cell < std::uint64_t(n) * n * n; ++cell)
    {
      // Where field and octree tell different things, as correctedLabels() has it: here, all that the field reaches.
      const LatticePoint p = fromMorton(cell);
      bool any = false;
      for (int c = 0; c < 8; ++c)
      {
        const std::ptrdiff_t at = field.find(mortonCode(p + cornerOffset(c)));
        any = any || (at >= 0 && field.values()[at] > 0.0f);
      }
      if (any)
      {
        cells.push_back(cell);
      }
      const auto location = octree.locate(p);
      entered += any && location.state == OctantState::Background && location.generation < octree.lattice.depth;
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    LatticeLabels labels(octree, makeCornerShell(cells, execution), field, execution);
    const auto outside = [&](const LatticePoint& p) { return !labels.insideAt(p); };
    const int cavities = floodComponents(n + 1, 1, outside) - 1;
    found += cavities;
    EXPECT_EQ(fillCavities(labels, execution), std::uint64_t(cavities)) << round;
    EXPECT_EQ(floodComponents(n + 1, 1, outside), 1) << round;
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(entered, 1000) << "no octant of several cells holds a part of the solid";
}

TEST(LatticeRegions, WhatHoldsNeitherACellsCornerNorAnInsideOctantIsUnsupported)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(sphereMesh(3, 0.3), axisCameras(100.0, 240), 240));
  const Octree octree = carveViews(views, unitCube(), 5);
  const int n = octree.lattice.cells() + 1;
  std::vector<std::uint64_t> everywhere;
  for (std::uint64_t cell = 0; cell < std::uint64_t(n - 1) * (n - 1) * (n - 1); ++cell)
  {
    everywhere.push_back(cell);
  }
  Random random(78);
  std::size_t unsupported = 0, supported = 0;
  for (int round = 0; round < 6; ++round)
  {
    // The object, and crumbs around it.
    BrickField field(octree.lattice, everywhere, 0, execution);
    const int crumbs = 20 + 40 * round;
    std::vector<Vector3> centres;
    for (int crumb = 0; crumb < crumbs; ++crumb)
    {
      centres.push_back({ random.uniform(1.0, n - 2.0), random.uniform(1.0, n - 2.0), random.uniform(1.0, n - 2.0) });
    }
    for (std::size_t at = 0; at < field.size(); ++at)
    {
      const LatticePoint p = fromMorton(field.code(at));
      double deepest = 0.31 / octree.lattice.leafEdge() - (toVector(p) - Vector3::Constant((n - 1) / 2)).norm();
      for (const Vector3& centre : centres)
      {
        deepest = std::max(deepest, 1.3 - (toVector(p) - centre).norm());
      }
      field.values()[at] = float(deepest);
    }
    std::vector<std::uint64_t> cells; // some of them hold a crumb's corner
    for (int cell = 0; cell < 150; ++cell)
    {
      cells.push_back(std::uint64_t(random.below(int(everywhere.size()))));
    }
    sortUnique(cells);
    const LatticeLabels labels(octree, CornerShell(), field, execution);
    const std::vector<std::uint64_t> found = unsupportedPoints(labels, cells, execution);
    // By flooding from all that supports.
    const auto index = [n](const LatticePoint& p) { return std::size_t(p.i + n * (p.j + n * p.k)); };
    std::vector<std::uint8_t> isReached(std::size_t(n * n * n), 0);
    std::vector<LatticePoint> stack;
    const auto reach = [&](const LatticePoint& p)
    {
      if (std::min({ p.i, p.j, p.k }) >= 0 && std::max({ p.i, p.j, p.k }) < n && isReached[index(p)] == 0 && labels.insideAt(p))
      {
        isReached[index(p)] = 1;
        stack.push_back(p);
      }
    };
    const auto reachCorners = [&](const LatticePoint& cell)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        reach(cell + cornerOffset(corner));
      }
    };
    for (const std::uint64_t cell : cells)
    {
      reachCorners(fromMorton(cell));
    }
    for (const std::uint64_t cell : everywhere)
    {
      if (octree.locate(fromMorton(cell)).state == OctantState::Inside)
      {
        reachCorners(fromMorton(cell));
      }
    }
    while (!stack.empty())
    {
      const LatticePoint p = stack.back();
      stack.pop_back();
      for (int d = 0; d < 27; ++d)
      {
        const LatticePoint step = neighbourOf({ 0, 0, 0 }, d);
        if (std::abs(step.i) + std::abs(step.j) + std::abs(step.k) <= 2)
        {
          reach(p + step);
        }
      }
    }
    std::vector<std::uint64_t> expected;
    for (int p = 0; p < n * n * n; ++p)
    {
      const LatticePoint at{ p % n, p / n % n, p / n / n };
      if (labels.insideAt(at) && isReached[index(at)] == 0)
      {
        expected.push_back(mortonCode(at));
      }
      supported += isReached[index(at)];
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(found, expected) << round;
    unsupported += found.size();
  }
  EXPECT_GT(unsupported, 500u);
  EXPECT_GT(supported, 500u);
}

TEST(LatticeRegions, AStrictHullOfTheAnnuliHasNoCavityOneVoteLeavesOne)
{
  Execution execution;
  const PreparedViews views = prepareViews(annulusViews(), OutsidePolicy::Background);
  for (const int k : { 0, 1 })
  {
    const Octree octree = carveViews(views, unitCube(), 6, k);
    LatticeLabels labels(
      octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), views, execution);
    EXPECT_EQ(fillCavities(labels, execution) > 0, k == 1);
  }
}
