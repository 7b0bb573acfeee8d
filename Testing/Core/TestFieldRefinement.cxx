// SPDX-License-Identifier: BSD-3-Clause
#include "FieldRefinement.h"

#include "CarvingTestCaptures.h"
#include "Error.h"

#include <gtest/gtest.h>

#include <functional>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

using Function = std::function<double(const Vector3&)>; ///< of a point in octants of the coarser lattice, the value in them

Lattice latticeOf(int depth)
{
  return { { Vector3(-1.1, -0.9, -1.0), 2.0 }, depth };
}

std::vector<std::uint64_t> cellsNear(const Lattice& lattice, const Function& function, double most)
{
  std::vector<std::uint64_t> cells;
  for (std::uint64_t cell = 0; cell < std::uint64_t(1) << 3 * lattice.depth; ++cell)
  {
    const LatticePoint p = fromMorton(cell);
    if (std::abs(function(Vector3(p.i + 0.5, p.j + 0.5, p.k + 0.5))) < most)
    {
      cells.push_back(cell);
    }
  }
  return cells;
}

BrickField fieldOf(int depth, const Function& function, int margin)
{
  Execution execution;
  const Lattice lattice = latticeOf(depth);
  BrickField field(lattice, cellsNear(lattice, function, 1.0), margin, execution);
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    const LatticePoint p = fromMorton(field.code(n));
    field.values()[n] = float(function(Vector3(p.i, p.j, p.k)));
  }
  return field;
}

double sphere(const Vector3& p)
{
  return 9.3 - (p - Vector3(15.2, 16.1, 15.7)).norm();
}

/** The greatest difference from a function at the points of a refined field at which the function is at most `most`. */
double greatestError(const BrickField& fine, int halvings, const Function& function, double most, int* compared)
{
  const double size = double(1 << halvings);
  double greatest = 0.0;
  *compared = 0;
  for (std::size_t n = 0; n < fine.size(); ++n)
  {
    const LatticePoint p = fromMorton(fine.code(n));
    const double expected = function(Vector3(p.i, p.j, p.k) / size);
    if (std::abs(expected) <= most)
    {
      greatest = std::max(greatest, std::abs(double(fine.values()[n]) / size - expected));
      ++*compared;
    }
  }
  return greatest;
}

} // namespace

TEST(FieldRefinement, KeepsAQuadraticAndItsValuesOnTheCoarserLattice)
{
  Execution execution;
  const Function quadratic = [](const Vector3& p)
  {
    const Vector3 q = (p - Vector3(16.0, 16.5, 16.0)) / 6.0;
    return 3.0 - q[0] * q[0] - 0.7 * q[1] * q[1] - 1.1 * q[2] * q[2] + 0.4 * q[0] * q[1] - 0.2 * q[2];
  };
  const BrickField coarse = fieldOf(5, quadratic, 6);
  for (int halvings = 0; halvings <= 3; ++halvings)
  {
    const BrickField fine = refinedField(coarse, halvings, {}, 0, execution);
    EXPECT_EQ(fine.lattice().depth, 5 + halvings);
    int compared = 0, same = 0;
    EXPECT_LT(greatestError(fine, halvings, quadratic, 0.3, &compared), 2e-6) << halvings;
    EXPECT_GT(compared, 1000 << 2 * halvings);
    for (std::size_t n = 0; n < coarse.size(); ++n)
    {
      const std::ptrdiff_t at = fine.find(coarse.code(n) << 3 * halvings);
      same += at >= 0 && fine.values()[std::size_t(at)] == coarse.values()[n] * float(1 << halvings);
      EXPECT_TRUE(at < 0 || std::abs(fine.values()[std::size_t(at)] - coarse.values()[n] * float(1 << halvings)) < 1e-4f);
    }
    EXPECT_GT(same, 1000);
  }
}

/** Linear interpolation would lie inside of a sphere of this radius by up to 3/8 / 9.3 = 0.04 octants of the coarser lattice. */
TEST(FieldRefinement, ASphereStaysWhereItIs)
{
  Execution execution;
  const BrickField coarse = fieldOf(5, sphere, 3);
  for (int halvings = 1; halvings <= 3; ++halvings)
  {
    int compared = 0;
    EXPECT_LT(greatestError(refinedField(coarse, halvings, {}, 2, execution), halvings, sphere, 1.0, &compared), 0.002);
    EXPECT_GT(compared, 4000 << 2 * halvings);
  }
}

TEST(FieldRefinement, IsGivenAroundTheSurfaceAndTheCellsAskedForAsFarAsThereIsAField)
{
  Execution execution;
  const BrickField coarse = fieldOf(5, sphere, 1);
  const BrickField fine = refinedField(coarse, 2, {}, 3, execution);
  const double size = 4.0;
  for (const std::uint64_t cell : cellsNear(fine.lattice(), [&](const Vector3& p) { return size * sphere(p / size); }, 0.9))
  {
    for (int n = 0; n < 27; ++n)
    {
      ASSERT_GE(fine.find(mortonCode(neighbourOf(fromMorton(cell), n))), 0);
    }
  }
  EXPECT_LT(fine.size(), 30 * coarse.size()); // of 64 times as many in all
  const std::uint64_t within = mortonCode({ 61, 64, 116 }), nowhere = mortonCode({ 127, 127, 127 });
  ASSERT_LT(fine.find(within), 0);
  const BrickField wider = refinedField(coarse, 2, { within, nowhere }, 0, execution);
  EXPECT_GE(wider.find(within), 0);
  EXPECT_LT(wider.find(nowhere), 0);
}

TEST(FieldRefinement, SameForAnyNumberOfThreads)
{
  const BrickField coarse = fieldOf(5, sphere, 3);
  Execution serial;
  const BrickField one = refinedField(coarse, 2, {}, 3, serial);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const BrickField many = refinedField(coarse, 2, {}, 3, execution);
    EXPECT_EQ(many.bricks(), one.bricks());
    EXPECT_EQ(many.values(), one.values());
  }
}

TEST(FieldRefinement, RefusesHalvingsOutOfRange)
{
  Execution execution;
  const BrickField coarse = fieldOf(3, [](const Vector3& p) { return 2.0 - (p - Vector3::Constant(4.0)).norm(); }, 1);
  EXPECT_THROW(refinedField(coarse, -1, {}, 0, execution), InvalidInput);
  EXPECT_THROW(refinedField(coarse, 4, {}, 0, execution), InvalidInput);
}
