// SPDX-License-Identifier: BSD-3-Clause
/**
 * Choosing some of many side by side.
 */
#pragma once

#include "Execution.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * The numbers n below `count` for which a test holds, ascending. `grain` as forRanges() has it; `makeTest()` makes the test of each range, `test(n)`, which
 * may remember things from one n to the next.
 */
template <typename MakeTest>
std::vector<std::int32_t> indicesWhereTests(std::size_t count, std::size_t grain, Execution& execution, const MakeTest& makeTest)
{
  std::vector<std::uint8_t> holds(count);
  execution.forRanges(count, grain,
    [&](std::size_t first, std::size_t last)
    {
      auto test = makeTest();
      for (std::size_t n = first; n < last; ++n)
      {
        holds[n] = test(n);
      }
    });
  std::vector<std::int32_t> indices;
  for (std::size_t n = 0; n < count; ++n)
  {
    if (holds[n] != 0)
    {
      indices.push_back(std::int32_t(n));
    }
  }
  return indices;
}

/** The same with one test, which may be called at the same time. */
template <typename Test>
std::vector<std::int32_t> indicesWhere(std::size_t count, std::size_t grain, Execution& execution, const Test& test)
{
  return indicesWhereTests(count, grain, execution, [&] { return [&](std::size_t n) { return test(n); }; });
}

} // namespace silhouette
