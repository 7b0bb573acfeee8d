// SPDX-License-Identifier: BSD-3-Clause
#include "PointComponents.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

bool areNeighbours(std::uint64_t a, std::uint64_t b, Steps steps)
{
  const LatticePoint p = fromMorton(a), q = fromMorton(b);
  const int i = std::abs(p.i - q.i), j = std::abs(p.j - q.j), k = std::abs(p.k - q.k);
  return std::max({ i, j, k }) == 1 && i + j + k <= int(steps);
}

/** By looking at all pairs until nothing is added. */
std::vector<std::vector<std::uint64_t>> expectedComponents(const std::vector<std::uint64_t>& points, Steps steps, std::size_t least)
{
  std::vector<std::vector<std::uint64_t>> components;
  std::set<std::uint64_t> left(points.begin(), points.end());
  while (!left.empty())
  {
    std::vector<std::uint64_t> component{ *left.begin() };
    left.erase(left.begin());
    for (std::size_t n = 0; n < component.size(); ++n)
    {
      for (auto other = left.begin(); other != left.end();)
      {
        const bool joins = areNeighbours(component[n], *other, steps);
        if (joins)
        {
          component.push_back(*other);
        }
        other = joins ? left.erase(other) : std::next(other);
      }
    }
    std::sort(component.begin(), component.end());
    if (component.size() >= least)
    {
      components.push_back(component);
    }
  }
  return components;
}

/** The points of each component, those of cubes among them; in the order of the first ones. */
std::vector<std::vector<std::uint64_t>> pointsOf(const std::vector<PointComponent>& components)
{
  std::vector<std::vector<std::uint64_t>> all;
  for (const PointComponent& component : components)
  {
    std::vector<std::uint64_t> points = codesOf(component.words);
    for (const PointCube& cube : component.cubes)
    {
      for (std::uint64_t code = cube.corner; code < cube.end(); ++code)
      {
        points.push_back(code);
      }
    }
    std::sort(points.begin(), points.end());
    EXPECT_EQ(points.size(), component.size);
    EXPECT_EQ(points.front(), component.first());
    all.push_back(points);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/** Cubes of sides 4 and 8, some by chance, in 32 x 32 x 32 points. */
std::vector<PointCube> someCubes(Random& random, double share)
{
  std::vector<PointCube> cubes;
  for (std::uint64_t eight = 0; eight < 64; ++eight)
  {
    const bool isWhole = random.uniform() < share;
    for (std::uint64_t four = 0; four < 8; ++four)
    {
      const std::uint64_t corner = 512 * eight + 64 * four;
      if (!isWhole && random.uniform() < share)
      {
        cubes.push_back({ corner, 4 });
      }
    }
    if (isWhole)
    {
      cubes.push_back({ 512 * eight, 8 });
    }
  }
  return cubes;
}

} // namespace

TEST(PointComponents, AreThoseOfAllPairs)
{
  Random random(7);
  std::size_t found = 0, largest = 0;
  for (int trial = 0; trial < 30; ++trial)
  {
    // About where the points of one kind of neighbours begin to be all together.
    const double share = 0.03 + 0.32 * random.uniform();
    std::vector<std::uint64_t> points;
    for (std::uint64_t code = 0; code < 16 * 16 * 16; ++code)
    {
      if (random.uniform() < share)
      {
        points.push_back(code);
      }
    }
    for (const Steps steps : { Steps::Faces, Steps::Edges, Steps::Corners })
    {
      for (const std::size_t least : { 1, 5 })
      {
        const auto components = pointsOf(pointComponents(wordsOf(points), {}, steps, least));
        EXPECT_TRUE(components == expectedComponents(points, steps, least)) << trial << ", " << int(steps) << " steps, " << least;
        found += components.size();
        for (const auto& component : components)
        {
          largest = std::max(largest, component.size());
        }
      }
    }
  }
  EXPECT_GT(found, 10000u);
  EXPECT_GT(largest, 1000u);
}

TEST(PointComponents, OfCubesAreThoseOfTheirPoints)
{
  Random random(11);
  std::size_t found = 0;
  for (int trial = 0; trial < 12; ++trial)
  {
    const std::vector<PointCube> cubes = someCubes(random, 0.05 + 0.1 * random.uniform());
    std::vector<std::uint64_t> points, all;
    for (std::uint64_t code = 0; code < 32 * 32 * 32; ++code)
    {
      const bool isInCube = cubeOf(cubes, code) != nullptr;
      const bool isPoint = !isInCube && random.uniform() < 0.01;
      points.insert(points.end(), isPoint ? 1 : 0, code);
      all.insert(all.end(), isPoint || isInCube ? 1 : 0, code);
    }
    for (const Steps steps : { Steps::Faces, Steps::Edges, Steps::Corners })
    {
      for (const std::size_t least : { 1, 100 })
      {
        const auto components = pointsOf(pointComponents(wordsOf(points), cubes, steps, least));
        EXPECT_TRUE(components == pointsOf(pointComponents(wordsOf(all), {}, steps, least))) << trial << ", " << int(steps) << " steps, " << least;
        found += components.size();
      }
    }
  }
  EXPECT_GT(found, 1000u);
}

TEST(PointComponents, OfNoPointsThereAreNone)
{
  EXPECT_TRUE(pointComponents({}, {}, Steps::Corners, 1).empty());
  EXPECT_TRUE(pointComponents({ { 0, 1 << 9 } }, {}, Steps::Corners, 2).empty());
  EXPECT_EQ(pointsOf(pointComponents({ { 0, 1 << 9 } }, {}, Steps::Corners, 1)), std::vector<std::vector<std::uint64_t>>{ { 9 } });
}
