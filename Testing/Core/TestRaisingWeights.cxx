// SPDX-License-Identifier: BSD-3-Clause
#include "RaisingWeights.h"

#include "BrickTestFields.h"
#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** By the definition: a sum over all corners of the cells, each counted once. */
class BruteWeights
{
public:
  BruteWeights(const std::vector<std::uint64_t>& cells, double width)
    : Reach(int(std::ceil(3.0 * width)))
    , Width(width)
  {
    for (const std::uint64_t cell : cells)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        this->Corners.insert(mortonCode(fromMorton(cell) + cornerOffset(corner)));
      }
    }
    const double alone = 1.0 + this->gaussian(1);
    this->Alone = alone * alone * alone;
  }

  double at(const LatticePoint& p) const
  {
    double sum = 0.0;
    for (const std::uint64_t code : this->Corners)
    {
      const LatticePoint q = fromMorton(code);
      sum += this->gaussian(q.i - p.i) * this->gaussian(q.j - p.j) * this->gaussian(q.k - p.k);
    }
    const double w = std::min(1.0, 1.001 * sum / this->Alone);
    return w < 0.01 ? 0.0 : w * w * (3.0 - 2.0 * w);
  }

private:
  double gaussian(int d) const { return std::abs(d) > this->Reach ? 0.0 : std::exp(-0.5 * d * d / (this->Width * this->Width)); }

  int Reach;
  double Width;
  double Alone = 0.0;
  std::set<std::uint64_t> Corners;
};

/** Cells here and there, some at the lattice's border, and two that share corners. */
std::vector<std::uint64_t> someCells(const Lattice& lattice, int count)
{
  Random random(7);
  const int n = lattice.cells();
  std::vector<std::uint64_t> cells = { mortonCode(LatticePoint{ 0, 0, 0 }), mortonCode(LatticePoint{ n - 1, n - 1, 3 }), mortonCode(LatticePoint{ 9, 8, 7 }), mortonCode(LatticePoint{ 10, 8, 7 }) };
  for (int c = 0; c < count; ++c)
  {
    cells.push_back(random.below(std::uint64_t(1) << 3 * lattice.depth));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

} // namespace

TEST(RaisingWeights, AreSumsOfGaussiansAroundTheCorners)
{
  Execution execution;
  const Lattice lattice = latticeOf(5);
  for (const double width : { 0.3, 1.5, 3.0, WidestRaising })
  {
    const auto cells = someCells(lattice, 6);
    const BruteWeights brute(cells, width);
    const BrickField field(lattice, allCells(lattice), 0, execution);
    const RaisingWeights weights(cells, width, execution);
    const auto near = weights.near(field);
    RaisingWeights::Brick brick(weights);
    int some = 0, none = 0, beyond = 0;
    for (std::size_t n = 0; n < field.size(); n += 3)
    {
      const std::size_t inBrick = n % BrickField::BrickPoints, block = inBrick / 64 * 64;
      brick.moveTo(field.bricks()[n / BrickField::BrickPoints]);
      const double expected = brute.at(fromMorton(field.code(n)));
      const float weight = brick.at(inBrick);
      EXPECT_NEAR(weight, expected, 4e-4) << width << ", " << n; // where the least one that counts is met all but exactly
      const BlockGroups groups = brick.groups(block);
      bool isNamed = false;
      for (std::size_t m = 0; m < groups.size(); ++m)
      {
        isNamed = isNamed || groups.first(m) == (inBrick - block) / 8 * 8;
      }
      EXPECT_TRUE(isNamed || weight == 0.0f);
      EXPECT_TRUE(near[n / BrickField::BrickPoints] != 0 || weight == 0.0f);
      some += weight > 0.0f;
      none += weight == 0.0f;
      beyond += near[n / BrickField::BrickPoints] == 0;
    }
    EXPECT_GT(some, 20) << width;
    EXPECT_TRUE(none > 100 || width > 2.0) << width;
    EXPECT_TRUE(beyond > 100 || width > 0.5) << width;
  }
}

TEST(RaisingWeights, AreOneAtTheCornersOfEachCell)
{
  Execution execution;
  const Lattice lattice = latticeOf(6);
  for (const double width : { 0.1, 1.5, 5.0 })
  {
    const auto cells = someCells(lattice, 300);
    const RaisingWeights weights(cells, width, execution);
    RaisingWeights::Brick brick(weights);
    for (const std::uint64_t cell : cells)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        const std::uint64_t code = mortonCode(fromMorton(cell) + cornerOffset(corner));
        brick.moveTo(code / BrickField::BrickPoints);
        EXPECT_EQ(brick.at(code % BrickField::BrickPoints), 1.0f);
      }
    }
  }
}
