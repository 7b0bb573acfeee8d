// SPDX-License-Identifier: BSD-3-Clause
/**
 * Choosing some of many side by side.
 */
#pragma once

#include "Execution.h"
#include "LargePages.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
  auto some = largeVector<decltype(make(std::size_t()))>(ends.back());
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

/** Lists one after another. */
template <typename Item>
std::vector<Item> concatenated(const std::vector<std::vector<Item>>& lists, Execution& execution)
{
  std::vector<std::size_t> ends(lists.size() + 1, 0);
  for (std::size_t n = 0; n < lists.size(); ++n)
  {
    ends[n + 1] = ends[n] + lists[n].size();
  }
  auto all = largeVector<Item>(ends.back());
  execution.forRanges(lists.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t n = first; n < last; ++n)
      {
        std::copy(lists[n].begin(), lists[n].end(), all.begin() + std::ptrdiff_t(ends[n]));
      }
    });
  return all;
}

/**
 * The numbers n below `count` for which a test holds, ascending. `grain` as forRanges() has it; `makeTest()` makes the test of each range, `test(n)`, which
 * may remember things from one n to the next.
 */
template <typename MakeTest>
std::vector<std::int32_t> indicesWhereTests(std::size_t count, std::size_t grain, Execution& execution, const MakeTest& makeTest)
{
  auto holds = largeVector<std::uint8_t>(count);
  execution.forRanges(count, grain,
    [&](std::size_t first, std::size_t last)
    {
      auto test = makeTest();
      for (std::size_t n = first; n < last; ++n)
      {
        holds[n] = test(n);
      }
    });
  return selected(count, [&](std::size_t n) { return holds[n] != 0; }, [](std::size_t n) { return std::int32_t(n); }, execution);
}

/** The same with one test, which may be called at the same time. */
template <typename Test>
std::vector<std::int32_t> indicesWhere(std::size_t count, std::size_t grain, Execution& execution, const Test& test)
{
  return indicesWhereTests(count, grain, execution, [&] { return [&](std::size_t n) { return test(n); }; });
}

/** Those of some codes for whose numbers a test holds, as indicesWhereTests() has it. */
template <typename MakeTest>
std::vector<std::uint64_t> codesWhere(const std::vector<std::uint64_t>& codes, Execution& execution, const MakeTest& makeTest)
{
  std::vector<std::uint64_t> some;
  for (const std::int32_t n : indicesWhereTests(codes.size(), 4096, execution, makeTest))
  {
    some.push_back(codes[std::size_t(n)]);
  }
  return some;
}

} // namespace silhouette
