// SPDX-License-Identifier: BSD-3-Clause
/**
 * UnionFind for several threads at once, without locks: the least member stands for its set, so that the sets and who stands for them depend neither on
 * the order of the unions nor on who makes them. (R. Anderson and H. Woll, Wait-free parallel algorithms for the union-find problem, STOC 1991; there the
 * links go by rank, here by number.)
 */
#pragma once

#include "Execution.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Disjoint sets of the numbers 0 to n - 1. */
class ConcurrentUnionFind
{
public:
  ConcurrentUnionFind() = default;
  /** Every number alone. */
  ConcurrentUnionFind(std::size_t count, Execution& execution)
    : Parent(count)
  {
    execution.forRanges(count, 1 << 16,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          this->Parent[n].store(std::uint32_t(n), std::memory_order_relaxed);
        }
      });
  }

  /** The least member of a number's set, as long as nobody is uniting. */
  std::uint32_t find(std::uint32_t a)
  {
    for (;;)
    {
      const std::uint32_t parent = this->Parent[a].load(std::memory_order_relaxed);
      const std::uint32_t next = this->Parent[parent].load(std::memory_order_relaxed);
      if (next == parent)
      {
        return parent;
      }
      // Whatever another thread has written here meanwhile, this too is a member of the set, and less than `a`.
      this->Parent[a].store(next, std::memory_order_relaxed);
      a = next;
    }
  }

  void unite(std::uint32_t a, std::uint32_t b)
  {
    // Most that are united again have the same parent.
    while (this->Parent[a].load(std::memory_order_relaxed) != this->Parent[b].load(std::memory_order_relaxed))
    {
      a = this->find(a);
      b = this->find(b);
      if (a == b)
      {
        return;
      }
      // Only a root is linked: whoever was faster has made it a member of another set, and the rest is to be united with that.
      std::uint32_t root = a < b ? b : a;
      if (this->Parent[root].compare_exchange_strong(root, a < b ? a : b, std::memory_order_relaxed))
      {
        return;
      }
    }
  }

  std::size_t size() const { return this->Parent.size(); }

private:
  std::vector<std::atomic<std::uint32_t>> Parent;
};

} // namespace silhouette
