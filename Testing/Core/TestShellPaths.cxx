// SPDX-License-Identifier: BSD-3-Clause
#include "ShellPaths.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <cstdlib>

using namespace silhouette;
using namespace silhouette::test;

/** All distances over random labels, by relaxation until nothing changes. */
TEST(ShellPaths, FindsTheLengthOfTheShortestWay)
{
  Execution execution;
  std::vector<std::uint64_t> cells;
  for (std::uint64_t cell = 0; cell < 64; ++cell)
  {
    cells.push_back(cell);
  }
  const CornerShell shell = makeCornerShell(cells, execution);
  const std::size_t count = shell.corners.size();
  Random random(3);
  std::vector<std::uint8_t> taken(count);
  for (auto& one : taken)
  {
    one = random.uniform() < 0.35;
  }
  ShellPaths paths(shell);
  const auto isTaken = [&](std::uint32_t corner) { return taken[corner] != 0; };
  int far = 0;
  for (std::uint32_t a = 0; a < count; ++a)
  {
    std::vector<int> steps(count, 1000);
    steps[a] = 0;
    for (bool changed = taken[a]; changed;)
    {
      changed = false;
      for (std::size_t p = 0; p < count; ++p)
      {
        for (std::size_t q = 0; q < count && taken[p]; ++q)
        {
          const LatticePoint u = fromMorton(shell.corners[p]), v = fromMorton(shell.corners[q]);
          const int i = std::abs(u.i - v.i), j = std::abs(u.j - v.j), k = std::abs(u.k - v.k);
          if (taken[q] && std::max({ i, j, k }) == 1 && i + j + k < 3 && steps[q] > steps[p] + 1)
          {
            steps[q] = steps[p] + 1;
            changed = true;
          }
        }
      }
    }
    for (std::uint32_t b = 0; b < count && taken[a]; ++b)
    {
      if (taken[b])
      {
        far += steps[b] > 3 && steps[b] < 1000;
        EXPECT_EQ(paths.meet(a, b, 3, isTaken), steps[b] <= 3);
        EXPECT_EQ(paths.meet(a, b, 500, isTaken), steps[b] < 1000);
      }
    }
  }
  EXPECT_GT(far, 0);
}
