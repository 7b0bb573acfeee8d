// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sorting by an integer key, digit by digit, which for Morton codes of a lattice is a few passes.
 */
#pragma once

#include "Execution.h"
#include "LargePages.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace silhouette
{

/**
 * Sort `items` by key(item), of which the lowest `keyBits` bits, 0 to 64, count. Stable, so that the outcome is the same whatever the threads. Cost: a pass for each
 * 12 bits, side by side; memory for the items once more.
 */
template <typename Item, typename Key>
void radixSort(std::vector<Item>& items, int keyBits, const Key& key, Execution& execution)
{
  constexpr int MostDigitBits = 12;
  constexpr std::size_t RangeSize = 1 << 14, MostRanges = 16;
  const int passes = (keyBits + MostDigitBits - 1) / MostDigitBits, digitBits = passes > 0 ? (keyBits + passes - 1) / passes : 0;
  const std::size_t digits = std::size_t(1) << digitBits;
  const std::size_t ranges = std::clamp(items.size() / RangeSize, std::size_t(1), MostRanges);
  const std::unique_ptr<Item[]> others(new Item[items.size()]); // not written to before it is used
  adviseLargePages(others.get(), items.size() * sizeof(Item));
  std::vector<std::size_t> next(ranges * digits); // of each range and digit
  Item *from = items.data(), *to = others.get();
  const auto forItems = [&](const auto& work)
  {
    execution.forRanges(ranges, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t range = first; range < last; ++range)
        {
          const std::size_t end = items.size() * (range + 1) / ranges;
          for (std::size_t n = items.size() * range / ranges; n < end; ++n)
          {
            work(range, from[n]);
          }
        }
      });
  };
  for (int pass = 0; pass < passes; ++pass)
  {
    const int shift = pass * digitBits;
    const std::size_t mask = (std::size_t(1) << std::min(digitBits, keyBits - shift)) - 1;
    const auto digitOf = [&](const Item& item) { return std::size_t(key(item) >> shift) & mask; };
    std::fill(next.begin(), next.end(), 0);
    forItems([&](std::size_t range, const Item& item) { ++next[range * digits + digitOf(item)]; });
    std::size_t sum = 0;
    for (std::size_t digit = 0; digit < digits; ++digit)
    {
      for (std::size_t range = 0; range < ranges; ++range)
      {
        std::size_t& count = next[range * digits + digit];
        const std::size_t own = count;
        count = sum;
        sum += own;
      }
    }
    forItems([&](std::size_t range, const Item& item) { to[next[range * digits + digitOf(item)]++] = item; });
    std::swap(from, to);
  }
  if (from != items.data())
  {
    std::copy(from, from + items.size(), items.data());
  }
}

} // namespace silhouette
