// SPDX-License-Identifier: BSD-3-Clause
#include "SomeCells.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

TEST(SomeCells, AreFoundAroundEachPointInOrder)
{
  Execution execution;
  Random random(11);
  std::vector<std::uint64_t> codes;
  for (int n = 0; n < 3000; ++n)
  {
    codes.push_back(mortonCode({ random.below(20), random.below(20), random.below(20) }));
  }
  sortUnique(codes);
  const CornerShell shell = makeCornerShell(codes, execution);
  std::vector<std::uint32_t> some;
  for (std::uint32_t cell = 0; cell < shell.cells.size(); ++cell)
  {
    if (random.below(3) == 0)
    {
      some.push_back(cell);
    }
  }
  const SomeCells cells(shell, some);
  std::size_t met = 0;
  for (int n = 0; n < 22 * 22 * 22; ++n)
  {
    const LatticePoint p{ n % 22, n / 22 % 22, n / 22 / 22 };
    std::vector<std::uint32_t> expected, found;
    for (int a = 0; a < 64; ++a)
    {
      const auto cell = shell.findCell({ p.i + a % 4 - 2, p.j + a / 4 % 4 - 2, p.k + a / 16 - 2 });
      if (cell >= 0 && std::binary_search(some.begin(), some.end(), std::uint32_t(cell)))
      {
        expected.push_back(std::uint32_t(cell));
      }
    }
    cells.forCellsAround(p, [&](std::uint32_t cell) { found.push_back(cell); });
    ASSERT_EQ(found, expected) << n;
    met += found.size();
  }
  EXPECT_GT(met, 1000u);
}

TEST(SomeCells, NoneAreAroundNoPoint)
{
  const std::vector<std::uint32_t> none;
  const SomeCells cells(CornerShell(), none);
  cells.forCellsAround({ 0, 0, 0 }, [](std::uint32_t) { FAIL(); });
}
