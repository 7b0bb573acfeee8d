// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSmoothing.h"

#include "BrickTestFields.h"
#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr float Unlimited = 1e30f;

void smoothField(BrickField& field, double sigma, Execution& execution)
{
  FieldSmoother().smooth(field, sigma, Unlimited, execution);
}

/** What is left of an impulse tells the weights at 0, 1, 2, ... along one axis. */
std::vector<double> weightsOf(double sigma, int radius)
{
  Execution execution;
  const Lattice lattice = latticeOf(6);
  BrickField field(lattice, allCells(lattice), 0, execution);
  const LatticePoint middle{ 31, 32, 33 };
  fill(field, [&](const LatticePoint& p) { return p == middle ? 1.0 : 0.0; });
  smoothField(field, sigma, execution);
  const auto at = [&](int d) { return double(field.values()[std::size_t(field.find(mortonCode(middle + LatticePoint{ d, 0, 0 })))]); };
  std::vector<double> weights{ std::cbrt(at(0)) };
  for (int d = 1; d <= radius; ++d)
  {
    weights.push_back(at(d) / weights[0] / weights[0]);
  }
  return weights;
}

/** One value after another, along one axis. */
std::vector<double> smoothedAlong(const BrickField& field, const std::vector<double>& values, int axis, const std::vector<double>& weights)
{
  std::vector<double> smoothed;
  for (std::size_t n = 0; n < values.size(); ++n)
  {
    double sum = weights[0] * values[n];
    for (const int side : { -1, 1 })
    {
      LatticePoint p = fromMorton(field.code(n));
      std::size_t last = n;
      bool ends = false; // the last value goes on
      for (std::size_t d = 1; d < weights.size(); ++d)
      {
        (axis == 0 ? p.i : axis == 1 ? p.j : p.k) += side;
        const std::ptrdiff_t found = ends || std::min({ p.i, p.j, p.k }) < 0 ? -1 : field.find(mortonCode(p));
        ends = found < 0;
        last = ends ? last : std::size_t(found);
        sum += weights[d] * values[last];
      }
    }
    smoothed.push_back(sum);
  }
  return smoothed;
}

} // namespace

TEST(FieldSmoothing, KeepsCubicFunctionsAwayFromMissingBricks)
{
  Execution execution;
  const Lattice lattice = latticeOf(6);
  Random random(3);
  std::vector<std::uint64_t> cells; // a bar along each axis, three bricks thick, that cross
  for (const std::uint64_t cell : allCells(lattice))
  {
    const LatticePoint p = fromMorton(cell);
    const int middle = (p.i / 24 == 1) + (p.j / 24 == 1) + (p.k / 24 == 1);
    if (middle >= 2)
    {
      cells.push_back(cell);
    }
  }
  for (const double sigma : { 0.3, 1.0, 2.5, 3.2 })
  {
    BrickField field(lattice, cells, 0, execution);
    const auto cubic = [](const LatticePoint& p)
    {
      const double x = p.i / 32.0 - 1.0, y = p.j / 32.0 - 1.0, z = p.k / 32.0 - 1.0; // a plain Gaussian of 1 octant would change y^2 by 0.001
      return 5.0 + 0.3 * x - 2.0 * y * y + 3.0 * x * x * x - x * y * z + 4.0 * z * z;
    };
    fill(field, cubic);
    smoothField(field, sigma, execution);
    const int radius = std::max(2, int(std::ceil(4.5 * sigma)));
    int interior = 0, changed = 0;
    for (std::size_t n = 0; n < field.size(); ++n)
    {
      const LatticePoint p = fromMorton(field.code(n));
      bool full = true; // does the field have values for the whole of the kernel?
      for (int corner = 0; corner < 8; ++corner)
      {
        const LatticePoint o = cornerOffset(corner);
        const LatticePoint q{ p.i + (2 * o.i - 1) * radius, p.j + (2 * o.j - 1) * radius, p.k + (2 * o.k - 1) * radius };
        full = full && q.i >= 0 && q.j >= 0 && q.k >= 0 && field.find(mortonCode(q)) >= 0;
      }
      const double error = std::abs(field.values()[n] - cubic(p));
      interior += full;
      changed += !full && error > 0.001;
      EXPECT_TRUE(!full || error < 1e-5) << sigma << " at " << p.i << " " << p.j << " " << p.k << ": " << error;
    }
    EXPECT_GT(interior, 100) << sigma;
    EXPECT_TRUE(sigma < 1.0 || changed > 100) << sigma; // where bricks end the last value goes on
  }
}

TEST(FieldSmoothing, HasNoSecondMomentAndReducesNoise)
{
  Execution execution;
  const Lattice lattice = latticeOf(5);
  BrickField field(lattice, allCells(lattice), 0, execution);
  const LatticePoint middle{ 16, 15, 17 };
  fill(field, [&](const LatticePoint& p) { return p == middle ? 1000.0 : 0.0; });
  smoothField(field, 1.3, execution);
  double sum = 0.0, square[3] = { 0, 0, 0 };
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    const LatticePoint p = fromMorton(field.code(n));
    const double weight = field.values()[n] / 1000.0;
    sum += weight;
    square[0] += weight * (p.i - middle.i) * (p.i - middle.i);
    square[1] += weight * (p.j - middle.j) * (p.j - middle.j);
    square[2] += weight * (p.k - middle.k) * (p.k - middle.k);
  }
  EXPECT_NEAR(sum, 1.0, 1e-4);
  for (const double variance : square)
  {
    EXPECT_NEAR(variance, 0.0, 1e-4);
  }

  Random random(4);
  fill(field, [&](const LatticePoint&) { return random.uniform(-1.0, 1.0); });
  const auto deviation = [&]
  {
    double squares = 0.0;
    for (const float value : field.values())
    {
      squares += double(value) * value;
    }
    return std::sqrt(squares / double(field.size()));
  };
  const double before = deviation();
  const BrickField noise = field;
  smoothField(field, 1.3, execution);
  // White noise falls, along each axis, to the root of the integral of (2 g - g * g)^2: (4 / 2 - 4 / sqrt(6) + 1 / 2 / sqrt(2)) /
  // sqrt(pi) / sigma, with g a Gaussian; a little less where bricks end.
  const double axis = (2.0 - 4.0 / std::sqrt(6.0) + 0.5 / std::sqrt(2.0)) / std::sqrt(std::acos(-1.0)) / 1.3;
  EXPECT_NEAR(deviation() / before, std::pow(axis, 1.5), 0.05);
  field = noise;
  smoothField(field, 0.0, execution);
  EXPECT_EQ(field.values(), noise.values());
}

TEST(FieldSmoothing, IsWhatItIsValueByValueWhereverBricksEnd)
{
  Execution serial;
  Random random(7);
  const Lattice lattice = latticeOf(6);
  for (const double sigma : { 0.2, 0.9, 2.0, 4.1 })
  {
    const int radius = std::max(2, int(std::ceil(4.5 * sigma)));
    const auto weights = weightsOf(sigma, radius);
    for (const int among : { 1, 2, 3 }) // bricks, of which one is there
    {
      std::vector<std::uint64_t> cells;
      for (std::uint64_t brick = 0; brick < 512; ++brick)
      {
        if (random.below(among) == 0)
        {
          cells.push_back(brick * BrickField::BrickPoints + 7); // no corner of it in other bricks
        }
      }
      BrickField field(lattice, cells, 0, serial);
      fill(field, [&](const LatticePoint&) { return random.uniform(-3.0, 3.0); });
      std::vector<double> expected(field.values().begin(), field.values().end());
      for (int axis = 0; axis < 3; ++axis)
      {
        expected = smoothedAlong(field, expected, axis, weights);
      }
      BrickField again = field;
      smoothField(field, sigma, serial);
      double most = 0.0;
      for (std::size_t n = 0; n < field.size(); ++n)
      {
        most = std::max(most, std::abs(field.values()[n] - expected[n]));
      }
      EXPECT_LT(most, 1e-4) << sigma << ", one brick in " << among;
      EXPECT_GT(field.bricks().size(), 100u);
      for (const int threads : { 2, 8 })
      {
        BrickField other = again;
        ThreadedExecution execution(threads);
        smoothField(other, sigma, execution);
        EXPECT_EQ(other.values(), field.values()) << threads;
      }
    }
  }
  BrickField nothing;
  smoothField(nothing, 2.0, serial);
  EXPECT_EQ(nothing.size(), 0u);
}

TEST(FieldSmoothing, LeavesEverythingWhereItIsNextToNone)
{
  Execution execution;
  const Lattice lattice = latticeOf(4);
  Random random(5);
  BrickField field(lattice, allCells(lattice), 0, execution);
  fill(field, [&](const LatticePoint&) { return random.uniform(); });
  const std::vector<float> before = field.values();
  for (const double sigma : { 0.0, 1e-300, 1e-170, 1e-5, 1e-3, 1.0001e-3 })
  {
    smoothField(field, sigma, execution);
    EXPECT_EQ(field.values(), before) << sigma;
  }
}

TEST(FieldSmoothing, ChangesNoValueByMoreThanIsAllowedAndDoesNotRememberTheLastField)
{
  Execution execution;
  Random random(9);
  FieldSmoother smoother;
  for (const int depth : { 5, 4, 5, 6 })
  {
    const Lattice lattice = latticeOf(depth);
    BrickField field(lattice, allCells(lattice), 0, execution);
    fill(field, [&](const LatticePoint&) { return random.uniform(-1.0, 1.0); });
    BrickField free = field, fixed = field;
    const BrickField before = field;
    smoothField(free, 1.3, execution);
    smoother.smooth(field, 1.3, 0.2f, execution);
    smoother.smooth(fixed, 1.3, 0.0f, execution);
    EXPECT_EQ(fixed.values(), before.values());
    std::size_t limited = 0;
    for (std::size_t n = 0; n < field.size(); ++n)
    {
      const float was = before.values()[n], expected = std::clamp(free.values()[n], was - 0.2f, was + 0.2f);
      ASSERT_EQ(field.values()[n], expected) << depth << ", " << n;
      limited += expected != free.values()[n];
    }
    EXPECT_GT(limited, field.size() / 4);
    EXPECT_LT(limited, field.size());
  }
}

TEST(FieldSmoothing, AGaussianKernelAddsUpToOneAndReachesThreeDeviations)
{
  for (const double sigma : { 0.5, 1.5 })
  {
    const std::vector<float> kernel = gaussianKernel(sigma);
    double sum = kernel[0];
    for (std::size_t d = 1; d < kernel.size(); ++d)
    {
      sum += 2.0 * kernel[d];
      EXPECT_NEAR(kernel[d] / kernel[0], std::exp(-0.5 * double(d * d) / sigma / sigma), 1e-6);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_GE(double(kernel.size() - 1), 3.0 * sigma);
  }
  EXPECT_EQ(gaussianKernel(1e-300)[0], 1.0f);
  EXPECT_EQ(gaussianKernel(1e-300)[1], 0.0f);
}
