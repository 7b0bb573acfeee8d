// SPDX-License-Identifier: BSD-3-Clause
#include "BrickField.h"

#include "BrickTestFields.h"
#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

std::vector<std::uint64_t> randomCells(const Lattice& lattice, int count, Random& random)
{
  std::set<std::uint64_t> cells;
  const int n = lattice.cells();
  while (int(cells.size()) < count)
  {
    cells.insert(mortonCode({ random.below(n), random.below(n), random.below(n) }));
  }
  return { cells.begin(), cells.end() };
}

/** Cells around a sphere's surface, `centre` and `radius` in octants. */
std::vector<std::uint64_t> sphereCells(const Lattice& lattice, const Vector3& centre, double radius)
{
  std::vector<std::uint64_t> cells;
  for (const std::uint64_t cell : allCells(lattice))
  {
    const LatticePoint p = fromMorton(cell);
    if (std::abs((Vector3(p.i + 0.5, p.j + 0.5, p.k + 0.5) - centre).norm() - radius) < 1.0)
    {
      cells.push_back(cell);
    }
  }
  return cells;
}

BrickField sphereField(int depth, const Vector3& centre, double radius, int margin = 3)
{
  Execution execution;
  const Lattice lattice = latticeOf(depth);
  BrickField field(lattice, sphereCells(lattice, centre, radius), margin, execution);
  fill(field, [&](const LatticePoint& p) { return radius - (Vector3(p.i, p.j, p.k) - centre).norm(); });
  return field;
}

} // namespace

TEST(BrickField, HoldsEveryPointNearItsCellsAndNoOtherBrick)
{
  Execution execution;
  Random random(1);
  for (const int depth : { 1, 2, 3, 4, 6 })
  {
    const Lattice lattice = latticeOf(depth);
    for (const int margin : { 0, 1, 3, 4, 9, 20 })
    {
      const auto cells = randomCells(lattice, std::min(5, 1 << 3 * depth), random);
      const BrickField field(lattice, cells, margin, execution);
      std::set<std::uint64_t> needed;
      const int n = lattice.cells();
      for (const std::uint64_t cell : cells)
      {
        const LatticePoint c = fromMorton(cell);
        const auto each = [&](int x, const std::function<void(int)>& call)
        {
          for (int at = std::max(x - margin, 0); at <= std::min(x + 1 + margin, n); ++at)
          {
            call(at);
          }
        };
        each(c.k, [&](int k) { each(c.j, [&](int j) { each(c.i,
          [&](int i) { needed.insert(mortonCode({ i, j, k }) / BrickField::BrickPoints); }); }); });
      }
      EXPECT_EQ(field.bricks(), std::vector<std::uint64_t>(needed.begin(), needed.end()))
        << "depth " << depth << " margin " << margin;
      EXPECT_EQ(field.size(), needed.size() * BrickField::BrickPoints);
    }
  }
  EXPECT_EQ(BrickField(latticeOf(5), {}, 3, execution).size(), 0u);
}

TEST(BrickField, FindsItsPointsAndNoOthers)
{
  Execution execution;
  Random random(2);
  const BrickField field(latticeOf(6), randomCells(latticeOf(6), 4, random), 2, execution);
  const std::set<std::uint64_t> bricks(field.bricks().begin(), field.bricks().end());
  for (std::uint64_t brick = 0; brick < 729; ++brick)
  {
    const std::ptrdiff_t at = field.findBrick(brick);
    EXPECT_EQ(at >= 0, bricks.count(brick) == 1) << brick;
    EXPECT_TRUE(at < 0 || field.bricks()[at] == brick);
  }
  std::size_t found = 0;
  for (std::uint64_t point = 0; point < 729 * BrickField::BrickPoints; ++point)
  {
    const std::ptrdiff_t at = field.find(point);
    found += at >= 0;
    EXPECT_TRUE(at < 0 ? bricks.count(point / BrickField::BrickPoints) == 0 : field.code(at) == point);
  }
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    EXPECT_EQ(field.find(field.code(n)), std::ptrdiff_t(n));
  }
  EXPECT_LE(found, field.size());
  EXPECT_GT(found, 0u);
  EXPECT_EQ(BrickField().find(0), -1);
}

TEST(BrickField, MixedCellsAreThoseWithCornersOfBothSigns)
{
  Execution execution;
  Random random(5);
  for (const int depth : { 2, 3, 5 })
  {
    const Lattice lattice = latticeOf(depth);
    BrickField field(lattice, randomCells(lattice, 3, random), 1, execution);
    // Rare signs, so that most cells are not mixed, and zeros, which are outside.
    fill(field, [&](const LatticePoint&) { return random.below(9) ? (random.below(3) ? -1.0 : 0.0) : 0.5; });
    std::vector<std::uint64_t> expected;
    for (const std::uint64_t cell : allCells(lattice))
    {
      int inside = 0, known = 0;
      for (int n = 0; n < 8; ++n)
      {
        const LatticePoint corner = fromMorton(cell) + cornerOffset(n);
        const auto at = field.find(mortonCode(corner));
        known += at >= 0;
        inside += at >= 0 && field.values()[at] > 0.0f && !lattice.onBorder(corner);
      }
      if (known == 8 && inside > 0 && inside < 8)
      {
        expected.push_back(cell);
      }
    }
    EXPECT_EQ(field.mixedCells(execution), expected) << depth;
    EXPECT_GT(expected.size(), 10u);
    EXPECT_LT(expected.size(), field.size());
  }
}

TEST(BrickField, TheContourOfASpheresDistancesIsTheSphere)
{
  Execution execution;
  const double pi = std::acos(-1.0);
  for (const double radius : { 19.3, 25.0 })
  {
    const Vector3 centre(31.7, 30.2, 32.9);
    const BrickField field = sphereField(6, centre, radius);
    const Mesh mesh = field.contourMesh(execution);
    const MeshSoundness s = assessMesh(mesh, execution);
    EXPECT_TRUE(s.sound());
    EXPECT_EQ(s.components, 1u);
    EXPECT_EQ(s.genus.value_or(-1), 0);
    const double leaf = field.lattice().leafEdge();
    const double volume = 4.0 / 3.0 * pi * std::pow(radius * leaf, 3);
    EXPECT_NEAR(s.volume, volume, 0.01 * volume);
    const Vector3 middle = field.lattice().root.origin + leaf * centre;
    for (const Vector3& p : mesh.points)
    {
      EXPECT_NEAR((p - middle).norm() / leaf, radius, 0.02);
    }
  }
}

TEST(BrickField, TheContourOfAFieldThatIsPositiveOnTheBorderIsClosed)
{
  Execution execution;
  const Lattice lattice = latticeOf(4);
  BrickField field(lattice, allCells(lattice), 0, execution);
  fill(field, [](const LatticePoint&) { return 1.0; });
  const Mesh mesh = field.contourMesh(execution);
  EXPECT_EQ(mesh.triangles.size(), 6u * 2u * 14u * 14u + 12u * 2u * 14u + 8u); // a box, its edges and corners cut off
  EXPECT_TRUE(assessMesh(mesh, execution).sound());
}

TEST(BrickField, ACursorFindsWhatTheFieldFinds)
{
  const BrickField field = sphereField(5, Vector3(15.2, 16.1, 15.7), 10.4);
  BrickCursor cursor(field);
  Random random(10);
  LatticePoint p{ 16, 16, 16 };
  int missing = 0, there = 0;
  for (int n = 0; n < 20000; ++n)
  {
    const auto step = [&](int x) { return std::clamp(x + random.below(5) - 2, 0, 63); };
    p = { step(p.i), step(p.j), step(p.k) };
    const std::ptrdiff_t found = cursor.find(mortonCode(p));
    ASSERT_EQ(found, field.find(mortonCode(p))) << n;
    (found < 0 ? missing : there) += 1;
  }
  EXPECT_GT(missing, 100);
  EXPECT_GT(there, 100);
}

TEST(BrickField, SameBytesForAnyNumberOfThreads)
{
  const auto make = [](Execution& execution)
  {
    BrickField field = sphereField(5, Vector3(15.2, 16.1, 15.7), 10.4);
    Random random(6);
    for (float& value : field.values())
    {
      value += float(random.uniform(-1.5, 1.5));
    }
    return std::make_pair(field, field.contourMesh(execution));
  };
  Execution serial;
  const auto one = make(serial);
  EXPECT_GT(one.second.triangles.size(), 1000u);
  for (const int threads : { 1, 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = make(execution);
    EXPECT_EQ(one.first.values(), many.first.values());
    EXPECT_EQ(one.first.mixedCells(serial), many.first.mixedCells(execution));
    EXPECT_EQ(one.second.points, many.second.points);
    EXPECT_EQ(one.second.triangles, many.second.triangles);
  }
}
