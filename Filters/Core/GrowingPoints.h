// SPDX-License-Identifier: BSD-3-Clause
/**
 * A set of lattice points that only grows, as blocks of 4 x 4 x 4 in a table by hash: what a search has seen.
 */
#pragma once

#include "BlockWords.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Points by Morton code. Cost: of adding and asking, constant; memory: 16 to 48 bytes a block. */
class GrowingPoints
{
public:
  bool has(std::uint64_t point) const { return this->Table[this->placeOf(point >> 6)].bits >> (point & 63) & 1; }

  /** Those of a block, a bit each. */
  std::uint64_t ofBlock(std::uint64_t block) const { return this->Table[this->placeOf(block)].bits; }

  void add(std::uint64_t point) { this->add(BlockWord{ point >> 6, std::uint64_t(1) << (point & 63) }); }

  void add(const std::vector<BlockWord>& words)
  {
    for (const BlockWord& word : words)
    {
      this->add(word);
    }
  }

private:
  void add(const BlockWord& more)
  {
    BlockWord& word = this->Table[this->placeOf(more.block)];
    const bool isNew = word.bits == 0 && more.bits != 0;
    word = { more.block, word.bits | more.bits };
    this->Used += isNew;
    if (isNew && 3 * this->Used > 2 * this->Table.size())
    {
      this->grow();
    }
  }

  /** Where a block is or would be. */
  std::size_t placeOf(std::uint64_t block) const
  {
    const std::size_t mask = this->Table.size() - 1;
    std::size_t place = std::size_t(block * 0x9e3779b97f4a7c15ULL >> 20) & mask;
    while (this->Table[place].bits != 0 && this->Table[place].block != block)
    {
      place = (place + 1) & mask;
    }
    return place;
  }

  void grow()
  {
    std::vector<BlockWord> old(2 * this->Table.size());
    old.swap(this->Table);
    for (const BlockWord& word : old)
    {
      if (word.bits != 0)
      {
        this->Table[this->placeOf(word.block)] = word;
      }
    }
  }

  std::vector<BlockWord> Table = std::vector<BlockWord>(1024); ///< a power of two; a place without points is free
  std::size_t Used = 0;
};

} // namespace silhouette
