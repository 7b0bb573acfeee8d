// SPDX-License-Identifier: BSD-3-Clause
#include "TreePieces.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

PreparedViews torusViews()
{
  auto views = viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(12, 160), 160);
  Random random(5);
  disturb(views, 2, random);
  return prepareViews(views);
}

Octree carvePiece(const LatticeViews& views, const std::vector<std::uint64_t>& trees, int k = 0)
{
  Execution execution;
  CarveOptions options;
  options.backgroundVotes = k;
  options.trees = trees;
  return carve(views, options, execution);
}

using Corner = std::array<double, 3>;

/** The triangles' corners, in order: what is left of surfaces when coincident points are one. */
std::vector<Corner> cornersOf(const std::vector<Mesh>& meshes)
{
  std::vector<Corner> corners;
  for (const Mesh& mesh : meshes)
  {
    for (const Triangle& t : mesh.triangles)
    {
      for (const auto p : t)
      {
        corners.push_back({ mesh.points[p].x(), mesh.points[p].y(), mesh.points[p].z() });
      }
    }
  }
  return corners;
}

} // namespace

TEST(TreePieces, HaveEveryTreeOnceAndInOrder)
{
  Execution execution;
  const PreparedViews views = torusViews();
  for (const int depth : { 1, 2, 3, 5, 8 })
  {
    const auto weights = weighTrees({ views, { unitCube(), depth } }, 0, execution);
    for (const int count : { 1, 2, 3, 8, 20 })
    {
      std::vector<std::uint64_t> all;
      for (int number = 0; number < count; ++number)
      {
        const auto trees = treesOfPiece(weights, { number, count });
        all.insert(all.end(), trees.begin(), trees.end());
      }
      std::vector<std::uint64_t> expected(std::size_t(1) << 3 * treeGeneration(depth));
      std::iota(expected.begin(), expected.end(), std::uint64_t(0));
      EXPECT_EQ(all, expected) << "depth " << depth << ", " << count << " pieces";
    }
  }
}

TEST(TreePieces, AreOfLikeCost)
{
  Execution execution;
  const PreparedViews prepared = torusViews();
  const LatticeViews latticeViews(prepared, { unitCube(), 7 });
  const std::size_t whole = carveViews(prepared, unitCube(), 7).count(OctantState::Intersection, 7);
  const auto weights = weighTrees(latticeViews, 0, execution);
  for (const int count : { 2, 3, 8 })
  {
    for (int number = 0; number < count; ++number)
    {
      const auto part = carvePiece(latticeViews, treesOfPiece(weights, { number, count }));
      const double share = double(count) * double(part.count(OctantState::Intersection, 7)) / double(whole);
      EXPECT_GT(share, 0.6) << number << " of " << count;
      EXPECT_LT(share, 1.4) << number << " of " << count;
    }
  }
}

TEST(TreePieces, AddUpToTheWholeOctreeAndItsSurface)
{
  Execution execution;
  const PreparedViews views = torusViews();
  for (const auto& [k, edges] : { std::pair(0, EdgePlacement::Exact), std::pair(2, EdgePlacement::Exact),
         std::pair(0, EdgePlacement::SubPixel), std::pair(2, EdgePlacement::SubPixel) })
  {
    const LatticeViews latticeViews(views, { unitCube(), 6 });
    const Octree whole = carveViews(views, unitCube(), 6, k);
    VotingOptions options;
    options.share = 1.0 - k / 12.0;
    options.edges = edges;
    const VotingSurface surface = votingMarchingCubes(whole, views, options, execution);
    const auto weights = weighTrees(latticeViews, k, execution);
    for (const int count : { 1, 2, 3, 8 })
    {
      std::vector<Octree> parts;
      std::vector<Mesh> meshes;
      std::vector<std::array<std::uint16_t, 2>> votes;
      std::uint64_t lost = 0;
      for (int number = 0; number < count; ++number)
      {
        const auto trees = treesOfPiece(weights, { number, count });
        parts.push_back(carvePiece(latticeViews, trees, k));
        EXPECT_TRUE(sameOctants(parts.back(), selectTrees(whole, trees)));
        auto part = votingMarchingCubes(parts.back(), views, options, execution);
        lost += part.lostNoCorner;
        votes.insert(votes.end(), part.insideVotes.begin(), part.insideVotes.end());
        meshes.push_back(std::move(part.mesh));
      }
      EXPECT_TRUE(sameOctants(whole, mergeTrees(parts))) << count;
      EXPECT_EQ(cornersOf(meshes), cornersOf({ surface.mesh })) << count;
      EXPECT_EQ(lost, surface.lostNoCorner);
      std::map<Corner, std::array<std::uint16_t, 2>> voted;
      std::size_t point = 0;
      for (const Mesh& mesh : meshes)
      {
        for (const auto& p : mesh.points)
        {
          voted[{ p.x(), p.y(), p.z() }] = votes[point++];
        }
      }
      EXPECT_EQ(voted.size(), surface.mesh.points.size());
      for (std::size_t p = 0; p < surface.mesh.points.size(); ++p)
      {
        const auto& at = surface.mesh.points[p];
        EXPECT_EQ((voted[{ at.x(), at.y(), at.z() }]), surface.insideVotes[p]);
      }
    }
  }
}

TEST(TreePieces, SelectedTrianglesKeepTheirOrderAndTheirPoints)
{
  const Mesh whole = torusMesh(20, 10, 0.7, 0.3);
  std::vector<Mesh> parts;
  std::size_t points = 0;
  for (int number = 0; number < 3; ++number)
  {
    parts.push_back(selectTriangles(whole, rangeOfPiece(whole.triangles.size(), { number, 3 })));
    points += parts.back().points.size();
    Execution execution;
    EXPECT_EQ(assessMesh(parts.back(), execution).unusedPoints, 0u);
  }
  EXPECT_EQ(cornersOf(parts), cornersOf({ whole }));
  EXPECT_LT(points, 2 * whole.points.size()) << "points are shared within a part";
}

TEST(TreePieces, RangesCoverEverythingOnce)
{
  for (const std::size_t items : { 0u, 1u, 7u, 1000u })
  {
    for (const int count : { 1, 2, 3, 8, 11 })
    {
      std::size_t next = 0;
      for (int number = 0; number < count; ++number)
      {
        const PieceRange range = rangeOfPiece(items, { number, count });
        EXPECT_EQ(range.first, next);
        next = range.last;
      }
      EXPECT_EQ(next, items);
    }
  }
}

TEST(TreePieces, RefuseWhatIsOutOfRangeAndCanBeCancelled)
{
  Execution execution;
  const PreparedViews views = torusViews();
  const LatticeViews latticeViews(views, { unitCube(), 5 });
  for (const Piece piece : { Piece{ -1, 2 }, Piece{ 2, 2 }, Piece{ 0, 0 } })
  {
    EXPECT_THROW(treesOfPiece(weighTrees(latticeViews, 0, execution), piece), InvalidInput);
    EXPECT_THROW(rangeOfPiece(5, piece), InvalidInput);
  }
  CancelledExecution cancelled;
  EXPECT_THROW(weighTrees(latticeViews, 0, cancelled), Cancelled);
}
