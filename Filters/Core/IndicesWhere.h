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

/** The numbers n below `count` for which `test(n)` holds, ascending. `grain` as forRanges() has it; `test` may be called at the same time. */
template <typename Test>
std::vector<std::int32_t> indicesWhere(std::size_t count, std::size_t grain, Execution& execution, const Test& test)
{
  std::vector<std::uint8_t> holds(count);
  execution.forRanges(count, grain,
    [&](std::size_t first, std::size_t last)
    {
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

} // namespace silhouette
