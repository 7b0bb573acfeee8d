// SPDX-License-Identifier: BSD-3-Clause
/**
 * Disjoint sets of the numbers 0 to n - 1; the least member stands for its set, so that results do not depend on
 * the order of the unions.
 */
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace silhouette
{

class UnionFind
{
public:
  explicit UnionFind(std::size_t count = 0)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), std::uint32_t(0));
  }
  std::uint32_t find(std::uint32_t a)
  {
    while (this->Parent[a] != a)
    {
      this->Parent[a] = this->Parent[this->Parent[a]];
      a = this->Parent[a];
    }
    return a;
  }
  void unite(std::uint32_t a, std::uint32_t b)
  {
    a = this->find(a);
    b = this->find(b);
    if (a != b)
    {
      this->Parent[a < b ? b : a] = a < b ? a : b;
    }
  }
  /** One number more, alone; returns it. */
  std::uint32_t add()
  {
    this->Parent.push_back(std::uint32_t(this->Parent.size()));
    return this->Parent.back();
  }
  std::size_t size() const { return this->Parent.size(); }

private:
  std::vector<std::uint32_t> Parent;
};

} // namespace silhouette
