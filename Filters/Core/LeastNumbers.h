// SPDX-License-Identifier: BSD-3-Clause
/**
 * For each of many things the least number that any thread has named for it: the same whatever the threads' order.
 */
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace silhouette
{

class LeastNumbers
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  explicit LeastNumbers(std::size_t size)
    : Complements(size)
  {
  }

  /** Name `number` for thing i. */
  void lower(std::size_t i, std::uint32_t number)
  {
    std::uint32_t before = this->Complements[i].load(std::memory_order_relaxed);
    while (~number > before &&
      !this->Complements[i].compare_exchange_weak(before, ~number, std::memory_order_relaxed))
    {
    }
  }

  /** The least number that was named for thing i; None where none was. */
  std::uint32_t operator[](std::size_t i) const { return ~this->Complements[i].load(std::memory_order_relaxed); }

private:
  std::vector<std::atomic<std::uint32_t>> Complements; // 0 at first, which is None
};

} // namespace silhouette
