// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sets of lattice points or cells as words: one for each block of 4 x 4 x 4 that has any, made from codes and from parts, side by side.
 */
#pragma once

#include "Bits.h"
#include "Execution.h"
#include "IndicesWhere.h"
#include "LargePages.h"
#include "RadixSort.h"

#include <algorithm>
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

/** Append what is of a block, none of whose successors is among the words. */
inline void append(std::vector<BlockWord>& words, const BlockWord& more)
{
  if (words.empty() || words.back().block != more.block)
  {
    words.push_back({ more.block, 0 });
  }
  words.back().bits |= more.bits;
}

/** The words of a list of codes, ascending, of which there are few; else blockWords(). */
inline std::vector<BlockWord> wordsOf(const std::vector<std::uint64_t>& codes)
{
  std::vector<BlockWord> words;
  for (const std::uint64_t code : codes)
  {
    append(words, { code >> 6, std::uint64_t(1) << (code & 63) });
  }
  return words;
}

/** Call `work(code)` for each of a word's, ascending. */
template <typename Work> void forCodes(const BlockWord& word, const Work& work)
{
  for (std::uint64_t left = word.bits; left != 0; left &= left - 1)
  {
    work(64 * word.block + std::uint64_t(lowestBit(left)));
  }
}

/** The codes of words, ascending as these. */
inline std::vector<std::uint64_t> codesOf(const std::vector<BlockWord>& words)
{
  std::vector<std::uint64_t> codes;
  for (const BlockWord& word : words)
  {
    forCodes(word, [&](std::uint64_t code) { codes.push_back(code); });
  }
  return codes;
}

/** The words of two lists, which are ascending but may have several of a block; of a block one. */
inline std::vector<BlockWord> unitedWords(const std::vector<BlockWord>& a, const std::vector<BlockWord>& b)
{
  std::vector<BlockWord> both;
  both.reserve(a.size() + b.size());
  auto other = b.begin();
  for (const BlockWord& word : a)
  {
    for (; other != b.end() && other->block < word.block; ++other)
    {
      append(both, *other);
    }
    append(both, word);
  }
  std::for_each(other, b.end(), [&](const BlockWord& word) { append(both, word); });
  return both;
}

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
  auto words = largeVector<BlockWord>(starts.size() - 1);
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
  auto words = largeVector<BlockWord>(starts.size());
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
  auto ends = largeVector<std::size_t>(count + 1);
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
  auto parts = largeVector<Part>(ends.back());
  forItems(
    [&](std::size_t n)
    {
      std::size_t at = ends[n];
      forParts(n, [&](const Part& part) { parts[at++] = part; });
    });
  return parts;
}

} // namespace silhouette
