// SPDX-License-Identifier: BSD-3-Clause
/**
 * For each of many things the least number that any thread has named for it: the same whatever the threads' order.
 */
#pragma once

#include "Execution.h"
#include "LargePages.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace silhouette
{

class LeastNumbers
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  LeastNumbers(std::size_t size, Execution& execution)
    : Complements(new std::atomic<std::uint32_t>[size])
  {
    adviseLargePages(this->Complements.get(), size * sizeof(std::atomic<std::uint32_t>));
    execution.forRanges(size, 16384,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          this->Complements[i].store(~None, std::memory_order_relaxed);
        }
      });
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
  std::unique_ptr<std::atomic<std::uint32_t>[]> Complements;
};

} // namespace silhouette
