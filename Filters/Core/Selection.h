// SPDX-License-Identifier: BSD-3-Clause
/**
 * Some of many, in their order, found side by side.
 */
#pragma once

#include "Execution.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace silhouette
{

/** `make(i)` for each i in [0, count) of which `isWanted(i)` holds, ascending; both may be asked from any thread, `isWanted` twice. */
template <typename IsWanted, typename Make>
auto selected(std::size_t count, const IsWanted& isWanted, const Make& make, Execution& execution) -> std::vector<decltype(make(std::size_t()))>
{
  constexpr std::size_t RangeSize = 1 << 15;
  const std::size_t ranges = (count + RangeSize - 1) / RangeSize;
  std::vector<std::size_t> ends(ranges + 1, 0);
  const auto forItems = [&](std::size_t range, const auto& work)
  {
    for (std::size_t i = range * RangeSize; i < std::min((range + 1) * RangeSize, count); ++i)
    {
      if (isWanted(i))
      {
        work(i);
      }
    }
  };
  execution.forRanges(ranges, 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t range = first; range < last; ++range)
      {
        forItems(range, [&](std::size_t) { ++ends[range + 1]; });
      }
    });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<decltype(make(std::size_t()))> some(ends.back());
  execution.forRanges(ranges, 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t range = first; range < last; ++range)
      {
        std::size_t at = ends[range];
        forItems(range, [&](std::size_t i) { some[at++] = make(i); });
      }
    });
  return some;
}

} // namespace silhouette
