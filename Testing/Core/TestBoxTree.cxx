// SPDX-License-Identifier: BSD-3-Clause
#include "BoxTree.h"

#include "EvaluationTestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

std::vector<Box> randomBoxes(int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> place(0, 40), size(0, 4); // whole numbers: many touch, many coincide
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Vector3d low(place(random), place(random), place(random));
    boxes.emplace_back(low, low + Eigen::Vector3d(size(random), size(random), size(random)));
  }
  return boxes;
}

} // namespace

TEST(BoxTree, OverlappingEqualsAll)
{
  const std::vector<Box> boxes = randomBoxes(700, 1);
  const BoxTree tree(boxes);
  for (const Box& query : randomBoxes(100, 2))
  {
    std::multiset<int> expected, found;
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      if (boxes[i].intersects(query))
      {
        expected.insert(int(i));
      }
    }
    tree.overlapping(query, [&](std::int32_t i) { found.insert(i); });
    ASSERT_EQ(found, expected);
  }
}

/** Where nodes and leaves are is told by the number of boxes: whatever that is, each box is found once, from the root and among the pairs of the leaves. */
TEST(BoxTree, HoldsEachBoxOnceForAnyNumberOfThem)
{
  for (int count = 1; count <= 200; ++count)
  {
    const BoxTree tree(randomBoxes(count, unsigned(count)));
    std::vector<int> visits(std::size_t(count), 0);
    tree.overlapping(Box(Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(50.0)), [&](std::int32_t i) { ++visits[std::size_t(i)]; });
    ASSERT_EQ(std::count(visits.begin(), visits.end(), 1), count);
    const BoxTree same(std::vector<Box>(std::size_t(count), Box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones())));
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    std::size_t visited = 0;
    for (std::size_t leaf = 0; leaf < same.leafCount(); ++leaf)
    {
      same.overlappingPairs(leaf, [&](std::int32_t i, std::int32_t j) { pairs.emplace(std::min(i, j), std::max(i, j)), ++visited; });
    }
    ASSERT_EQ(pairs.size(), std::size_t(count) * std::size_t(count - 1) / 2) << count;
    ASSERT_EQ(visited, pairs.size()) << count;
  }
}

/** Built by parts: what is found, and in which order, is the same as of all pairs, and for any number of threads. */
TEST(BoxTree, SameForAnyNumberOfThreads)
{
  for (const int count : { 7, 384, 385, 6000, 30000 })
  {
    const std::vector<Box> boxes = randomBoxes(count, 5);
    const BoxTree alone(boxes);
    for (const int threads : { 1, 2, 8 })
    {
      ThreadedExecution execution(threads);
      const BoxTree tree(boxes, execution);
      ASSERT_EQ(tree.leafCount(), alone.leafCount());
      for (const Box& query : randomBoxes(20, 6))
      {
        std::vector<std::int32_t> expected, found;
        alone.overlapping(query, [&](std::int32_t i) { expected.push_back(i); });
        tree.overlapping(query, [&](std::int32_t i) { found.push_back(i); });
        EXPECT_TRUE(found == expected) << count << " boxes, " << threads << " threads";
        std::sort(found.begin(), found.end());
        std::vector<std::int32_t> all;
        for (std::int32_t i = 0; i < count; ++i)
        {
          if (boxes[std::size_t(i)].intersects(query))
          {
            all.push_back(i);
          }
        }
        EXPECT_TRUE(found == all) << count << " boxes";
      }
      std::size_t pairs = 0, expectedPairs = 0;
      for (std::size_t leaf = 0; leaf < tree.leafCount() && count <= 6000; ++leaf)
      {
        tree.overlappingPairs(leaf, [&](std::int32_t i, std::int32_t j) { pairs += std::size_t(i) * 7 + std::size_t(j); });
        alone.overlappingPairs(leaf, [&](std::int32_t i, std::int32_t j) { expectedPairs += std::size_t(i) * 7 + std::size_t(j); });
      }
      EXPECT_EQ(pairs, expectedPairs);
    }
  }
}

TEST(BoxTree, PairsEqualAllPairs)
{
  const std::vector<Box> boxes = randomBoxes(700, 3);
  const BoxTree tree(boxes);
  std::multiset<std::pair<int, int>> expected, found;
  for (int i = 0; i < 700; ++i)
  {
    for (int j = i + 1; j < 700; ++j)
    {
      if (boxes[i].intersects(boxes[j]))
      {
        expected.insert({ i, j });
      }
    }
  }
  for (std::size_t leaf = 0; leaf < tree.leafCount(); ++leaf)
  {
    tree.overlappingPairs(leaf, [&](std::int32_t i, std::int32_t j) { found.insert(std::minmax(i, j)); });
  }
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 100u);
}

TEST(BoxTree, NearestEqualsLeast)
{
  const std::vector<Box> boxes = randomBoxes(700, 4);
  const BoxTree tree(boxes);
  std::size_t asked = 0;
  for (const Box& query : randomBoxes(100, 5))
  {
    const Eigen::Vector3d point = 1.5 * query.min() - Eigen::Vector3d(10, 10, 10);
    double expected = std::numeric_limits<double>::infinity();
    for (const Box& box : boxes)
    {
      expected = std::min(expected, (box.center() - point).squaredNorm());
    }
    const double found = tree.nearest(point,
      [&](std::int32_t i)
      {
        ++asked;
        return (boxes[i].center() - point).squaredNorm();
      });
    ASSERT_EQ(found, expected);
  }
  EXPECT_LT(asked, 100u * 700u / 4);
}

TEST(BoxTree, Empty)
{
  const BoxTree tree({});
  EXPECT_EQ(tree.leafCount(), 0u);
  tree.overlapping(Box(Eigen::Vector3d(0, 0, 0)), [](std::int32_t) { FAIL(); });
  EXPECT_EQ(
    tree.nearest({ 0, 0, 0 }, [](std::int32_t) { return 0.0; }), std::numeric_limits<double>::infinity());
}

TEST(BoxTree, AThousandBoxesInOnePlace)
{
  const BoxTree tree(std::vector<Box>(1000, Box(Eigen::Vector3d(1, 2, 3))));
  int found = 0;
  tree.overlapping(Box(Eigen::Vector3d(1, 2, 3)), [&](std::int32_t) { ++found; });
  EXPECT_EQ(found, 1000);
}
