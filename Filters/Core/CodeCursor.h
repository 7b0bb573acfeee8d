// SPDX-License-Identifier: BSD-3-Clause
/**
 * Finding Morton codes among many that are sorted, for codes of points near one another.
 */
#pragma once

#include "Bits.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * The blocks of 4 x 4 x 4 points found last are remembered, 64: a block and all around it have places of their own. Not for several threads at once. The codes have to outlive
 * it. Cost: a binary search for each block that is not remembered.
 */
class CodeCursor
{
public:
  /** Codes from `first` on, up to `last`; ascending. */
  CodeCursor(const std::uint64_t* first, const std::uint64_t* last)
    : First(first)
    , Last(last)
  {
  }

  explicit CodeCursor(const std::vector<std::uint64_t>& codes)
    : CodeCursor(codes.data(), codes.data() + codes.size())
  {
  }

  /** Index of a code among them, or -1. */
  std::ptrdiff_t find(std::uint64_t code)
  {
    Block& block = this->Blocks[(code >> 6) % this->Blocks.size()]; // by its coordinates' two lowest bits
    if (block.code != code >> 6)
    {
      this->read(code >> 6, block);
    }
    const std::uint64_t bit = std::uint64_t(1) << (code & 63);
    return (block.points & bit) != 0 ? std::ptrdiff_t(block.first) + countBits(block.points & (bit - 1)) : -1;
  }

private:
  struct Block
  {
    std::uint64_t code = ~std::uint64_t(0); ///< no block's
    std::uint64_t points = 0;               ///< those among the codes, a bit each
    std::size_t first = 0;                  ///< index of the first of them
  };

  void read(std::uint64_t code, Block& block) const
  {
    const std::uint64_t* at = std::lower_bound(this->First, this->Last, code << 6);
    block = { code, 0, std::size_t(at - this->First) };
    for (; at != this->Last && *at >> 6 == code; ++at)
    {
      block.points |= std::uint64_t(1) << (*at & 63);
    }
  }

  const std::uint64_t* First;
  const std::uint64_t* Last;
  std::array<Block, 64> Blocks;
};

} // namespace silhouette
