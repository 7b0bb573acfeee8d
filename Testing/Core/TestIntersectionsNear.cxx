// SPDX-License-Identifier: BSD-3-Clause
#include "IntersectionsNear.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

/** Points of a sphere are moved at random, again and again: each time the pairs are those of all triangles of the part. */
TEST(IntersectionsNear, AreThoseOfTheWholePart)
{
  Execution execution;
  Random random(9);
  Mesh mesh = sphereMesh(3, 0.7);
  const Mesh round = mesh;
  std::vector<std::int32_t> part;
  for (std::int32_t t = 0; t < std::int32_t(mesh.triangles.size()); ++t)
  {
    if (mesh.points[std::size_t(mesh.triangles[std::size_t(t)][0])].z() > -0.3)
    {
      part.push_back(t);
    }
  }
  ASSERT_LT(part.size(), mesh.triangles.size());
  IntersectionsNear near(mesh, part);
  std::set<std::int32_t> moved;
  std::size_t most = 0, stayed = 0;
  std::vector<TrianglePair> before;
  for (int step = 0; step < 12; ++step)
  {
    const auto hasChanged = [&](std::size_t t)
    { return std::any_of(mesh.triangles[t].begin(), mesh.triangles[t].end(), [&](std::int32_t p) { return moved.count(p) > 0; }); };
    std::vector<TrianglePair> pairs = near.pairs(mesh, hasChanged, execution);
    std::sort(pairs.begin(), pairs.end());
    EXPECT_EQ(pairs, selfIntersectionsAmong(mesh, part, execution)) << step;
    most = std::max(most, pairs.size());
    const auto isAsBefore = [&](const TrianglePair& pair)
    {
      return std::binary_search(before.begin(), before.end(), pair) &&
        std::none_of(pair.begin(), pair.end(), [&](std::int32_t t) { return hasChanged(std::size_t(t)); });
    };
    stayed += std::size_t(std::count_if(pairs.begin(), pairs.end(), isAsBefore));
    before = pairs;
    moved.clear();
    for (std::int32_t p = 0; p < std::int32_t(mesh.points.size()); ++p)
    {
      if (random.uniform() < 0.02)
      {
        // Every third time back to where it was.
        const Vector3 away(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        mesh.points[std::size_t(p)] = round.points[std::size_t(p)] + (step % 3 == 2 ? 0.0 : 0.4) * away;
        moved.insert(p);
      }
    }
  }
  EXPECT_GT(most, 50u);
  EXPECT_GT(stayed, 50u) << "pairs that were not looked for again";
}
