// SPDX-License-Identifier: BSD-3-Clause
#include "SubPixelLabels.h"

#include "CarvingTestCaptures.h"
#include "CornerVotes.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int ViewCount = 10;

/** Octants of about a pixel and a half: many corners lie beside a contour's stairs. */
PreparedViews noisyViews(int kind, std::uint64_t seed = 5)
{
  Random random(seed);
  auto views = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(ViewCount, 120), 120);
  disturb(views, kind, random);
  return prepareViews(views);
}

/** What is known of an octree's corners, their labels by votes and by distances. */
struct Labels
{
  Execution serial;
  LatticeViews views;
  CornerShell shell;
  SubPixelCrossing distances;
  std::vector<std::uint8_t> voted, changed;

  Labels(const PreparedViews& prepared, const Octree& octree)
    : views(prepared, octree.lattice)
    , shell(makeCornerShell(leafCells(octree, OctantState::Intersection), this->serial))
    , distances(this->views, this->serial)
  {
    const int required = prepared.size() - octree.backgroundVotes;
    for (const std::uint64_t corner : this->shell.corners)
    {
      const LatticePoint p = fromMorton(corner);
      this->voted.push_back(this->views.insideVotes(p) >= required && !octree.lattice.onBorder(p));
    }
    this->changed = this->in(octree, this->serial);
  }
  std::vector<std::uint8_t> in(const Octree& octree, Execution& execution) const
  {
    return subPixelLabels(octree, this->shell, this->views, this->distances, this->voted, execution);
  }
};

/** Are all eight octants around a point intersection octants of the last generation? */
bool surrounded(const Octree& octree, const LatticePoint& p)
{
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint o = cornerOffset(c);
    const auto location = octree.locate({ p.i - o.i, p.j - o.j, p.k - o.k });
    if (location.generation != octree.lattice.depth || location.state != OctantState::Intersection)
    {
      return false;
    }
  }
  return true;
}

} // namespace

TEST(SubPixelLabels, FollowTheDistancesAtCornersAmongIntersectionOctantsAlone)
{
  for (const int k : { 0, 2 })
  {
    const PreparedViews views = noisyViews(0);
    const Octree octree = carveViews(views, unitCube(), 6, k);
    const Labels labels(views, octree);
    int outwards = 0, inwards = 0, kept = 0;
    for (std::size_t c = 0; c < labels.voted.size(); ++c)
    {
      const LatticePoint p = fromMorton(labels.shell.corners[c]);
      const bool other = labels.distances.inside(p, k) != (labels.voted[c] != 0);
      const bool changes = other && surrounded(octree, p);
      ASSERT_EQ(labels.changed[c] != labels.voted[c], changes) << k << ", corner " << c;
      outwards += changes && !labels.voted[c];
      inwards += changes && labels.voted[c];
      kept += other && !changes;
    }
    EXPECT_GT(outwards, 20);
    EXPECT_GT(inwards, 10);
    EXPECT_GT(kept, 10) << "some would open the surface";
  }
}

/** What makes the surface closed, whatever the silhouettes: octants with corners of both labels are in the shell. */
TEST(SubPixelLabels, NoOctantBesidesTheShellsHasCornersOfBothLabels)
{
  int changes = 0;
  for (int kind = 0; kind <= 5; ++kind)
  {
    for (const int k : { 1, 3 })
    {
      const PreparedViews views = noisyViews(kind, std::uint64_t(60 + kind));
      const Octree octree = carveViews(views, unitCube(kind == 5 ? 0.6 : 1.3), 5, kind == 4 ? 4 : k);
      const Labels labels(views, octree);
      const int n = octree.lattice.cells();
      for (int cell = 0; cell < n * n * n; ++cell)
      {
        const LatticePoint low{ cell % n, cell / n % n, cell / n / n };
        int inside = 0;
        for (int c = 0; c < 8; ++c)
        {
          const LatticePoint p = low + cornerOffset(c);
          const auto at = labels.shell.find(mortonCode(p));
          inside += at >= 0 ? int(labels.changed[std::size_t(at)])
                            : int(!octree.lattice.onBorder(p) &&
                                labels.views.insideVotes(p) >= ViewCount - octree.backgroundVotes);
        }
        ASSERT_TRUE(inside == 0 || inside == 8 || labels.shell.findCell(low) >= 0) << kind << ", cell " << cell;
      }
      for (std::size_t c = 0; c < labels.voted.size(); ++c)
      {
        changes += labels.changed[c] != labels.voted[c];
      }
    }
  }
  EXPECT_GT(changes, 100);
}

TEST(SubPixelLabels, AreTheSameInEveryPiece)
{
  const PreparedViews views = noisyViews(2);
  for (const int k : { 0, 2 })
  {
    const Octree whole = carveViews(views, unitCube(), 6, k);
    const Labels expected(views, whole);
    int atBorders = 0;
    for (std::uint64_t tree = 0; tree < 512; ++tree)
    {
      CarveOptions options;
      options.backgroundVotes = k;
      options.trees = { tree };
      Execution execution;
      const Octree piece = carve(LatticeViews(views, whole.lattice), options, execution);
      const Labels labels(views, piece);
      for (std::size_t c = 0; c < labels.changed.size(); ++c)
      {
        const auto at = expected.shell.find(labels.shell.corners[c]);
        ASSERT_GE(at, 0);
        ASSERT_EQ(labels.changed[c], expected.changed[std::size_t(at)]) << "tree " << tree << ", corner " << c;
        const LatticePoint p = fromMorton(labels.shell.corners[c]);
        atBorders += labels.changed[c] != labels.voted[c] && (p.i % 8 == 0 || p.j % 8 == 0 || p.k % 8 == 0);
      }
    }
    EXPECT_GT(atBorders, 10) << "where octants of other pieces have to be known";
  }
}

TEST(SubPixelLabels, SameBytesForAnyNumberOfThreads)
{
  const PreparedViews views = noisyViews(1);
  const Octree octree = carveViews(views, unitCube(), 6, 2);
  const Labels labels(views, octree);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    EXPECT_EQ(labels.in(octree, execution), labels.changed);
  }
}
