// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sets of lattice points or cells as words: one for each block of 4 x 4 x 4 that has any, made from codes and from parts, side by side.
 */
#pragma once

#include "Bits.h"
#include "Execution.h"
#include "IndicesWhere.h"
#include "RadixSort.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace silhouette
{

/** What is of a block: bit n is the one of Morton code 64 `block` + n. Of any value until it is written. */
struct BlockWord
{
  std::uint64_t block;
  std::uint64_t bits;
};

/** Does another block begin with the n-th of a list of codes, ascending? */
inline bool beginsBlock(const std::vector<std::uint64_t>& codes, std::size_t n)
{
  return n == 0 || codes[n - 1] >> 6 != codes[n] >> 6;
}

/** The blocks of a list of codes, ascending. */
inline std::vector<std::uint64_t> blocksOf(const std::vector<std::uint64_t>& codes, Execution& execution)
{
  return selected(
    codes.size(), [&](std::size_t n) { return beginsBlock(codes, n); }, [&](std::size_t n) { return codes[n] >> 6; }, execution);
}

/** Where each block begins in a list of codes, ascending, and the list's end. */
inline std::vector<std::size_t> blockStarts(const std::vector<std::uint64_t>& codes, Execution& execution)
{
  auto starts = selected(
    codes.size(), [&](std::size_t n) { return beginsBlock(codes, n); }, [](std::size_t n) { return n; }, execution);
  starts.push_back(codes.size());
  return starts;
}

/** The words of a list of codes, ascending; `starts` are its blockStarts(). */
inline std::vector<BlockWord> blockWords(const std::vector<std::uint64_t>& codes, const std::vector<std::size_t>& starts, Execution& execution)
{
  std::vector<BlockWord> words(starts.size() - 1);
  execution.forRanges(words.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t b = first; b < last; ++b)
      {
        words[b] = { codes[starts[b]] >> 6, 0 };
        for (std::size_t n = starts[b]; n < starts[b + 1]; ++n)
        {
          words[b].bits |= std::uint64_t(1) << (codes[n] & 63);
        }
      }
    });
  return words;
}

/**
 * From parts of words, in any order and several of a block, the words, ascending. `parts` have a member `word` and are sorted by it; `blockBits`, 0 to 58, bits of their blocks' codes
 * may be set. `tell(part, n)` is told, perhaps side by side, that a part is in the n-th word.
 */
template <typename Part, typename Tell>
std::vector<BlockWord> joinParts(std::vector<Part>& parts, int blockBits, const Tell& tell, Execution& execution)
{
  radixSort(parts, blockBits, [](const Part& part) { return part.word.block; }, execution);
  auto starts = selected(
    parts.size(), [&](std::size_t n) { return n == 0 || parts[n - 1].word.block != parts[n].word.block; }, [](std::size_t n) { return n; }, execution);
  std::vector<BlockWord> words(starts.size());
  starts.push_back(parts.size());
  execution.forRanges(words.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t b = first; b < last; ++b)
      {
        words[b] = { parts[starts[b]].word.block, 0 };
        for (std::size_t n = starts[b]; n < starts[b + 1]; ++n)
        {
          words[b].bits |= parts[n].word.bits;
          tell(parts[n], b);
        }
      }
    });
  return words;
}

/**
 * Parts that items [0, count) have, a few each: `forParts(n, add)` calls add(part) for each of the n-th item's, and is asked twice.
 */
template <typename Part, typename ForParts>
std::vector<Part> collectParts(std::size_t count, const ForParts& forParts, Execution& execution)
{
  std::vector<std::size_t> ends(count + 1, 0);
  const auto forItems = [&](const auto& work)
  {
    execution.forRanges(count, 1024,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          work(n);
        }
      });
  };
  forItems([&](std::size_t n) { forParts(n, [&](const Part&) { ++ends[n + 1]; }); });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Part> parts(ends.back());
  forItems(
    [&](std::size_t n)
    {
      std::size_t at = ends[n];
      forParts(n, [&](const Part& part) { parts[at++] = part; });
    });
  return parts;
}

} // namespace silhouette
