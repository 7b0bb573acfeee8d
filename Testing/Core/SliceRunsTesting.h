// SPDX-License-Identifier: BSD-3-Clause
/**
 * Runs of a slice as sets of cells, for tests.
 */
#pragma once

#include "ConvexParts.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace silhouette::test
{

using Cells = std::set<std::pair<int, int>>; ///< (row, place)

inline Cells cellsOf(const SliceRuns& runs)
{
  Cells cells;
  for (const auto& run : runs)
  {
    for (int u = run.from; u < run.to; ++u)
    {
      EXPECT_TRUE(cells.emplace(run.v, u).second) << "runs of one row do not touch";
    }
  }
  return cells;
}

} // namespace silhouette::test
