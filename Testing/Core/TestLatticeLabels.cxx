// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeLabels.h"
#include "LabelCache.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

struct Scene
{
  explicit Scene(int noise)
  {
    Random random(77);
    auto captured = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 120), 120);
    disturb(captured, noise, random);
    this->views = prepareViews(captured);
    this->octree = carveViews(this->views, unitCube(), 5);
    this->surface = votingMarchingCubes(this->octree, this->views, VotingOptions(), this->execution);
    this->shell = makeCornerShell(leafCells(this->octree, OctantState::Intersection), this->execution);
  }
  Execution execution;
  PreparedViews views;
  Octree octree;
  VotingSurface surface;
  CornerShell shell;
};

} // namespace

TEST(LatticeLabels, EveryPointOfAMarchingCubesSurfaceIsFoundOnItsEdge)
{
  Scene scene(0);
  const SurfaceCrossings crossings = locateCrossings(scene.surface.mesh, scene.octree.lattice, CrossingSides::Located, scene.execution);
  EXPECT_EQ(crossings.ignoredPoints, 0u);
  EXPECT_EQ(crossings.crossings.size(), scene.surface.mesh.points.size());
  Mesh moved = scene.surface.mesh;
  for (auto& p : moved.points)
  {
    p += Eigen::Vector3d::Constant(0.2 * scene.octree.lattice.leafEdge());
  }
  EXPECT_EQ(locateCrossings(moved, scene.octree.lattice, CrossingSides::Located, scene.execution).ignoredPoints, moved.points.size());
}

/** Without views the surface has to give the labels back that it was made from. */
TEST(LatticeLabels, LabelsFromTheSurfaceAreThoseOfTheVotes)
{
  for (const int noise : { 0, 2 })
  {
    Scene scene(noise);
    const LatticeLabels voted(scene.octree, scene.shell, scene.views, scene.execution);
    const LatticeLabels read(
      scene.octree, scene.shell, locateCrossings(scene.surface.mesh, scene.octree.lattice, CrossingSides::Located, scene.execution));
    std::size_t differing = 0;
    for (std::size_t c = 0; c < voted.inside().size(); ++c)
    {
      differing += voted.inside()[c] != read.inside()[c];
    }
    // A sliver's averaged normal may point along its edge; a corner that no crossing reaches is a guess.
    EXPECT_LE(differing, voted.inside().size() / 200) << "noise " << noise;
  }
}

TEST(LatticeLabels, OfAnyPointAgreeWithTheVotesWithinAndBeyondTheShell)
{
  Scene scene(1);
  const LatticeLabels labels(scene.octree, scene.shell, scene.views, scene.execution);
  const LatticeViews lattice(scene.views, scene.octree.lattice);
  for (int n = 0; n < 33 * 33 * 33; ++n)
  {
    const LatticePoint p{ n % 33, n / 33 % 33, n / 33 / 33 };
    const bool expected = !scene.octree.lattice.onBorder(p) && lattice.insideVotes(p) == scene.views.size();
    EXPECT_EQ(labels.insideAt(p), expected);
  }
}

TEST(LatticeLabels, OfManyPointsAtOnceAreThoseOfEach)
{
  Scene scene(1);
  LatticeLabels voted(scene.octree, scene.shell, scene.views, scene.execution);
  for (int generation = 1; generation < 5; ++generation) // as if cavities had been filled
  {
    const Generation& octants = voted.octree().generations[generation];
    for (std::size_t i = 0; i < octants.size(); i += 7)
    {
      if (octants.state[i] == OctantState::Background)
      {
        voted.fillOctant(generation, i);
      }
    }
  }
  BrickField field(scene.octree.lattice, { mortonCode({ 9, 17, 15 }), mortonCode({ 20, 3, 30 }) }, 5, scene.execution);
  Random random(8);
  for (float& value : field.values())
  {
    value = float(random.uniform(-1.0, 1.0));
  }
  const LatticeLabels byField(scene.octree, scene.shell, field, scene.execution);
  const LatticeLabels blocksVoted = voted, blocksByField = byField;
  blocksVoted.blocks(scene.execution);
  blocksByField.blocks(scene.execution);
  for (const LatticeLabels* labels : { &std::as_const(voted), &byField, &blocksVoted, &blocksByField })
  {
    std::size_t inside = 0;
    for (std::uint64_t block = 0; block <= mortonCode({ 33, 33, 33 }) / 64; ++block)
    {
      const std::uint64_t bits = labels->insideOfBlock(block);
      for (std::uint64_t n = 0; n < 64; ++n)
      {
        const LatticePoint p = fromMorton(64 * block + n);
        const bool ofLattice = std::max({ p.i, p.j, p.k }) <= labels->octree().lattice.cells();
        EXPECT_EQ(bits >> n & 1, std::uint64_t(ofLattice && labels->insideAt(p))) << p.i << " " << p.j << " " << p.k;
        inside += bits >> n & 1;
      }
    }
    EXPECT_GT(inside, 1000u);
  }
}

TEST(LatticeLabels, ByVotesThatAreKnownAreTheSame)
{
  Scene scene(2);
  const LatticeLabels counted(scene.octree, scene.shell, scene.views, scene.execution);
  const auto votes = shellVotes(scene.octree, scene.shell, LatticeViews(scene.views, scene.octree.lattice), scene.execution);
  const LatticeLabels known(scene.octree, scene.shell, votes, scene.execution);
  EXPECT_EQ(counted.inside(), known.inside());
  EXPECT_EQ(counted.support(), known.support());
}

TEST(LatticeLabels, RememberedOnesFollowAChangeThatIsTold)
{
  Scene scene(1);
  LatticeLabels labels(scene.octree, scene.shell, scene.views, scene.execution);
  LabelCache cache(labels);
  std::size_t changed = 0;
  for (int round = 0; round < 2; ++round)
  {
    for (std::size_t c = 0; c < scene.shell.corners.size(); ++c)
    {
      const LatticePoint p = fromMorton(scene.shell.corners[c]);
      EXPECT_EQ(cache.insideAt(p), labels.insideAt(p));
      if (round == 0 && c % 3 == 0 && !labels.inside()[c] && !scene.octree.lattice.onBorder(p))
      {
        labels.setInside(c);
        cache.setInside(scene.shell.corners[c]);
        ++changed;
      }
    }
  }
  EXPECT_GT(changed, 100u);
}

TEST(LatticeLabels, FilledOctantsAreInside)
{
  Scene scene(0);
  LatticeLabels labels(scene.octree, scene.shell, scene.views, scene.execution);
  const auto& octree = labels.octree();
  for (std::size_t i = 0; i < octree.generations[3].size(); ++i)
  {
    const LatticePoint p = fromMorton(octree.generations[3].code[i]);
    const bool middle = p.i > 0 && p.j > 0 && p.k > 0 && p.i < 7 && p.j < 7 && p.k < 7;
    if (middle && octree.generations[3].state[i] == OctantState::Background)
    {
      const LatticePoint within{ 4 * p.i + 2, 4 * p.j + 2, 4 * p.k + 2 };
      EXPECT_FALSE(labels.insideAt(within));
      labels.fillOctant(3, i);
      EXPECT_TRUE(labels.insideAt(within));
      return;
    }
  }
  FAIL() << "no background octant of generation 3";
}
