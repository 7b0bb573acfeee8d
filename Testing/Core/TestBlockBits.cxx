// SPDX-License-Identifier: BSD-3-Clause
#include "BlockBits.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

LatticePoint stepped(const LatticePoint& p, int axis, int step)
{
  return p + LatticePoint{ axis == 0 ? step : 0, axis == 1 ? step : 0, axis == 2 ? step : 0 };
}

std::uint64_t randomWord(Random& random)
{
  std::uint64_t word = 0;
  for (int n = 0; n < 64; ++n)
  {
    word |= std::uint64_t(random.uniform(0.0, 1.0) < 0.5) << n;
  }
  return word;
}

} // namespace

TEST(BlockBits, StepsComeFromTheBlockItselfAndTheOneBeyond)
{
  Random random(3);
  const auto bitAt = [](const LatticePoint& p, std::uint64_t bits, std::uint64_t beyond)
  {
    const LatticePoint q{ p.i & 3, p.j & 3, p.k & 3 };
    return (q == p ? bits : beyond) >> mortonCode(q) & 1;
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::uint64_t bits = randomWord(random), beyond = randomWord(random);
    for (std::uint64_t n = 0; n < 64; ++n)
    {
      const LatticePoint p = fromMorton(n);
      EXPECT_EQ(fromAhead(bits, beyond, axis) >> n & 1, bitAt(stepped(p, axis, 1), bits, beyond));
      EXPECT_EQ(fromBehind(bits, beyond, axis) >> n & 1, bitAt(stepped(p, axis, -1), bits, beyond));
    }
  }
}

TEST(BlockBits, CornersAreBroughtFromTheBlockAndThoseAheadOfIt)
{
  Random random(5);
  std::array<std::uint64_t, 8> words;
  std::generate(words.begin(), words.end(), [&] { return randomWord(random); });
  std::array<std::uint64_t, 8> corners = words;
  bringCorners(corners);
  for (std::uint64_t n = 0; n < 64; ++n)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const LatticePoint p = fromMorton(n) + cornerOffset(corner);
      const unsigned word = unsigned(p.i >> 2) | unsigned(p.j >> 2) << 1 | unsigned(p.k >> 2) << 2;
      EXPECT_EQ(corners[std::size_t(corner)] >> n & 1, words[word] >> mortonCode({ p.i & 3, p.j & 3, p.k & 3 }) & 1) << n << ", corner " << corner;
    }
  }
}

TEST(BlockBits, BlocksBesideAreOneStepAway)
{
  for (const LatticePoint& p : { LatticePoint{ 0, 5, 7 }, LatticePoint{ 3, 0, 8 }, LatticePoint{ 15, 16, 0 } })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const bool ahead : { true, false })
      {
        const LatticePoint q = stepped(p, axis, ahead ? 1 : -1);
        std::uint64_t other = 0;
        ASSERT_EQ(besideBlock(mortonCode(p), axis, ahead, other), std::min({ q.i, q.j, q.k }) >= 0);
        EXPECT_TRUE(std::min({ q.i, q.j, q.k }) < 0 || other == mortonCode(q));
      }
    }
  }
}

TEST(BlockBits, WithinTheBorderIsWhatTheLatticeSays)
{
  const Lattice lattice{ { Eigen::Vector3d::Zero(), 1.0 }, 3 };
  for (std::uint64_t n = 0; n < 64 * 64; ++n)
  {
    EXPECT_EQ(withinBorder(lattice, n / 64) >> n % 64 & 1, std::uint64_t(!lattice.onBorder(fromMorton(n))));
  }
}
