// SPDX-License-Identifier: BSD-3-Clause
#include "RejectedCorners.h"

#include "CarvingTestCaptures.h"
#include "EvaluationTestMeshes.h"
#include "SilhouetteDissent.h"

#include <gtest/gtest.h>

#include <map>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** By asking every view about every corner, from the shell on, one step after another. */
std::map<std::uint64_t, int> rejectedOneByOne(const LatticeViews& views, const CornerShell& shell)
{
  std::map<std::uint64_t, int> rejected, asked;
  std::vector<std::uint64_t> front = shell.corners;
  while (!front.empty())
  {
    std::vector<std::uint64_t> next;
    for (const std::uint64_t corner : front)
    {
      if (!asked.emplace(corner, 0).second)
      {
        continue;
      }
      const int only = dissentAt(views, fromMorton(corner)).only;
      for (int n = 0; n < 6 && only >= 0; ++n)
      {
        const LatticePoint q = neighbourOf(fromMorton(corner), EdgeNeighbours[n]);
        if (isOfLattice(q, views.lattice().cells()))
        {
          next.push_back(mortonCode(q));
        }
      }
      if (only >= 0)
      {
        rejected.emplace(corner, only);
      }
    }
    front = next;
  }
  return rejected;
}

/** Add the points of a cube, none of which is there. Returns how many. */
std::size_t addWithin(const RejectedCube& one, std::map<std::uint64_t, int>& byCorner)
{
  for (std::uint64_t code = one.cube.corner; code < one.cube.end(); ++code)
  {
    EXPECT_TRUE(byCorner.emplace(code, one.view).second);
  }
  return std::size_t(one.cube.size());
}

} // namespace

/** A ball in a ring of views, one of which has lost its right half. */
std::vector<View> withoutRightHalf(int size)
{
  auto captured = viewsOf(sphereMesh(4, 0.9), swayingRing(24, size), size);
  BinaryImage& image = captured[0].silhouette;
  for (int row = 0; row < image.height; ++row)
  {
    std::fill(&image.at(size / 2, row), &image.at(size - 1, row) + 1, std::uint8_t(0));
  }
  return captured;
}

/** Whether views abstain or not, may dissent or not, and whoever carved the octree. */
TEST(RejectedCorners, AreThoseThatOneViewAloneCallsBackground)
{
  for (int kind = 0; kind <= 5; ++kind)
  {
    Random random(30 + kind);
    auto captured = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(8, 120), 120);
    disturb(captured, kind, random);
    for (const OutsidePolicy policy : { OutsidePolicy::Border, OutsidePolicy::Unknown, OutsidePolicy::Background })
    {
      const PreparedViews prepared = prepareViews(captured, policy);
      const Octree octree = carveViews(prepared, unitCube(), 5, kind % 3 == 2);
      const LatticeViews views(prepared, octree.lattice);
      ThreadedExecution execution(1 + kind % 3);
      const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
      const auto expected = rejectedOneByOne(views, shell);
      EXPECT_GT(expected.size(), 50u);
      Octree another = octree;
      another.fingerprint ^= 1;
      for (const Octree* one : { &octree, static_cast<const Octree*>(&another) })
      {
        KnownVotes::Votes votes;
        const auto [words, cubes] = findRejected(*one, views, shell, 0.1 * (kind % 2), votes, execution);
        EXPECT_EQ(votes != nullptr, one == &octree);
        std::map<std::uint64_t, int> byCorner;
        std::size_t found = 0;
        for (std::size_t n = 0; n < words.size(); ++n)
        {
          const auto add = [&, view = words[n].view](std::uint64_t corner) { EXPECT_TRUE(byCorner.emplace(corner, view).second); };
          forCodes(words[n].corners, add);
          found += std::size_t(countBits(words[n].corners.bits));
          EXPECT_TRUE(n == 0 || words[n - 1].view < words[n].view ||
            (words[n - 1].view == words[n].view && words[n - 1].corners.block < words[n].corners.block));
        }
        for (const RejectedCube& cube : cubes)
        {
          found += addWithin(cube, byCorner);
        }
        EXPECT_EQ(byCorner, expected) << "noise " << kind << ", policy " << int(policy);
        EXPECT_EQ(found, expected.size());
      }
    }
  }
}

/** What a view lacks half of is a solid: its corners are eight times as many with each generation, what is kept of them about four times. */
TEST(RejectedCorners, GrowLikeTheSurfaceOfWhatIsRejected)
{
  const PreparedViews prepared = prepareViews(withoutRightHalf(256));
  ThreadedExecution execution(2);
  std::vector<double> kept, all;
  for (int depth = 5; depth <= 8; ++depth)
  {
    const Octree octree = carveViews(prepared, unitCube(), depth);
    const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
    KnownVotes::Votes votes;
    const RejectedCorners found = findRejected(octree, LatticeViews(prepared, octree.lattice), shell, 0.1, votes, execution);
    std::uint64_t corners = 0;
    for (const RejectedWord& word : found.words)
    {
      corners += std::uint64_t(countBits(word.corners.bits));
    }
    kept.push_back(double(found.words.size() + found.cubes.size()));
    all.push_back(double(corners));
    for (const RejectedCube& one : found.cubes)
    {
      EXPECT_EQ(one.view, 0);
      all.back() += double(one.cube.size());
    }
    if (depth >= 7)
    {
      EXPECT_LT(kept.back(), 5.0 * kept.end()[-2]) << depth;
      EXPECT_GT(all.back(), 6.5 * all.end()[-2]) << depth;
    }
  }
  EXPECT_GT(all.back(), 3.0 * kept.back());
}
