// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sorting by an integer key, digit by digit, which for Morton codes of a lattice is a few passes.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Sort `items` by key(item), of which the lowest `keyBits` bits count. Stable. Cost: a pass for each 11 bits. */
template <typename Item, typename Key>
void radixSort(std::vector<Item>& items, int keyBits, const Key& key)
{
  constexpr int DigitBits = 11;
  constexpr std::uint64_t Digits = std::uint64_t(1) << DigitBits;
  std::vector<Item> other(items.size());
  for (int shift = 0; shift < keyBits; shift += DigitBits)
  {
    std::array<std::size_t, Digits> start{};
    for (const Item& item : items)
    {
      ++start[key(item) >> shift & (Digits - 1)];
    }
    std::size_t sum = 0;
    for (std::size_t& count : start)
    {
      const std::size_t own = count;
      count = sum;
      sum += own;
    }
    for (const Item& item : items)
    {
      other[start[key(item) >> shift & (Digits - 1)]++] = item;
    }
    items.swap(other);
  }
}

} // namespace silhouette
