// SPDX-License-Identifier: BSD-3-Clause
#include "CornerVotes.h"

#include "CarvingTestCaptures.h"
#include "SurvivorIslands.h"
#include "EdgeCrossing.h"
#include "LatticeSurface.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A noisy torus, carved so that some views may dissent; views abstain where the policy says so. */
struct Scene
{
  Execution execution;
  PreparedViews prepared;
  Octree octree;
  LatticeViews views;
  CornerShell shell;

  Scene(int backgroundVotes, OutsidePolicy policy, double cube = 1.0)
    : prepared(prepareViews(noisyViews(), policy))
    , octree(carveViews(this->prepared, unitCube(cube), 5, backgroundVotes))
    , views(this->prepared, this->octree.lattice)
    , shell(makeCornerShell(leafCells(this->octree, OctantState::Intersection), this->execution))
  {
  }
  static std::vector<View> noisyViews()
  {
    Random random(5);
    auto views = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(9, 120), 120);
    disturb(views, 1, random);
    return views;
  }
  std::vector<std::uint16_t> votes()
  {
    return cornerVotes(
      this->shell, CellViews(this->octree, this->shell, this->views, this->execution), this->views, this->execution);
  }
  void expectAllVotes()
  {
    const auto votes = this->votes();
    ASSERT_EQ(votes.size(), this->shell.corners.size());
    for (std::size_t c = 0; c < votes.size(); ++c)
    {
      ASSERT_EQ(int(votes[c]), this->views.insideVotes(fromMorton(this->shell.corners[c]))) << "corner " << c;
    }
  }
};

} // namespace

TEST(CornerVotes, AreThoseOfAllViewsWhateverTheVotesAndThePolicy)
{
  for (const auto policy : { OutsidePolicy::Border, OutsidePolicy::Unknown, OutsidePolicy::Background })
  {
    for (const int backgroundVotes : { 0, 1, 3 })
    {
      Scene(backgroundVotes, policy).expectAllVotes();
      Scene(backgroundVotes, policy, 4.0).expectAllVotes(); // much of it in no image
    }
  }
}

TEST(CornerVotes, FewerViewsAreAskedAndTheOthersAreSettled)
{
  Scene scene(0, OutsidePolicy::Border);
  const CellViews cellViews(scene.octree, scene.shell, scene.views, scene.execution);
  std::size_t asked = 0;
  for (std::size_t cell = 0; cell < scene.shell.cells.size(); ++cell)
  {
    const ViewsToAsk ask = cellViews[cell];
    std::vector<bool> isAsked(std::size_t(scene.views.size()), false);
    ask.forEach([&](int view) { isAsked[view] = true; });
    asked += std::size_t(std::count(isAsked.begin(), isAsked.end(), true));
    for (int i = 0; i < scene.views.size(); ++i)
    {
      for (int c = 0; c < 8 && !isAsked[i]; ++c)
      {
        const Vote vote = scene.views.vote(i, fromMorton(scene.shell.corners[scene.shell.cellCorners[cell][c]]));
        ASSERT_NE(vote, Vote::Background) << "view " << i << ", cell " << cell;
      }
    }
  }
  EXPECT_LT(asked, scene.shell.cells.size() * std::size_t(scene.views.size()) * 3 / 4);
}

TEST(CornerVotes, AllViewsAreAskedWhereNothingIsKnown)
{
  Scene scene(1, OutsidePolicy::Border);
  const auto votes = scene.votes();
  scene.octree.undecided = UndecidedViews();
  EXPECT_EQ(scene.votes(), votes);
  EXPECT_EQ(CellViews(scene.octree, scene.shell, scene.views, scene.execution)[0].count,
    std::size_t(scene.views.size()));

  // Views that the octree was not carved from, and cells that are in no intersection octant.
  Scene other(1, OutsidePolicy::Border);
  other.octree.fingerprint += 1;
  other.expectAllVotes();
  Scene wider(0, OutsidePolicy::Border);
  std::vector<std::uint64_t> cells;
  for (std::uint64_t cell = 0; cell < std::uint64_t(1) << 15; cell += 7)
  {
    cells.push_back(cell);
  }
  wider.shell = makeCornerShell(cells, wider.execution);
  wider.expectAllVotes();
}

TEST(CornerVotes, CrossingsAreThoseOfAllViews)
{
  for (const int backgroundVotes : { 0, 2 })
  {
    Scene scene(backgroundVotes, OutsidePolicy::Border);
    const auto votes = scene.votes();
    std::vector<std::uint8_t> inside;
    for (std::size_t c = 0; c < votes.size(); ++c)
    {
      inside.push_back(votes[c] >= scene.views.size() - backgroundVotes &&
        !scene.octree.lattice.onBorder(fromMorton(scene.shell.corners[c])));
    }
    const LatticeSurface surface = contour(scene.shell, inside, scene.execution);
    const CellViews cellViews(scene.octree, scene.shell, scene.views, scene.execution);
    ASSERT_GT(surface.edges.size(), 1000u);
    for (const CrossedEdge& edge : surface.edges)
    {
      const LatticePoint a = fromMorton(scene.shell.corners[edge.inside]);
      const LatticePoint b = fromMorton(scene.shell.corners[edge.outside]);
      ASSERT_EQ(exactCrossing(scene.views, cellViews[edge.cell], a, b, backgroundVotes),
        exactCrossing(scene.views, a, b, backgroundVotes));
    }
  }
}

TEST(CornerVotes, SameBytesForAnyNumberOfThreads)
{
  Scene scene(1, OutsidePolicy::Border);
  const auto one = scene.votes();
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const CellViews cellViews(scene.octree, scene.shell, scene.views, execution);
    EXPECT_EQ(cornerVotes(scene.shell, cellViews, scene.views, execution), one);
  }
}

/** Known votes are those of the octree's own views and of its own corners. */
TEST(CornerVotes, OfAnOctreeAreCountedOnce)
{
  Scene scene(0, OutsidePolicy::Border);
  int counts = 0;
  const auto count = [&]
  {
    ++counts;
    return scene.votes();
  };
  const auto first = octreeVotes(scene.octree, scene.shell, scene.views, count);
  EXPECT_EQ(*first, scene.votes());
  EXPECT_EQ(octreeVotes(scene.octree, scene.shell, scene.views, count), first);
  const Octree copy = scene.octree;
  EXPECT_EQ(octreeVotes(copy, scene.shell, scene.views, count), first);
  EXPECT_EQ(counts, 1);

  const PreparedViews others = prepareViews(Scene::noisyViews(), OutsidePolicy::Background);
  octreeVotes(copy, scene.shell, LatticeViews(others, copy.lattice), count);
  EXPECT_EQ(counts, 2) << "other views";
  EXPECT_EQ(octreeVotes(copy, scene.shell, scene.views, count), first) << "which are not remembered";
  DroppedSurvivors dropped;
  const Octree less = dropLeaves(copy, { scene.shell.cells.front() }, dropped);
  EXPECT_EQ(less.votes.get(), nullptr) << "fewer corners";
  EXPECT_EQ(copy.votes.get(), first);
}
