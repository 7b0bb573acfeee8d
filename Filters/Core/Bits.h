// SPDX-License-Identifier: BSD-3-Clause
/**
 * Sets of up to 64 things as the bits of a word. Without the processor's own instructions, which a program for any
 * 64-bit machine cannot count on, counting is a dozen operations.
 */
#pragma once

#include <cstdint>
#include <cstring>

namespace silhouette
{

inline int countBits(std::uint64_t bits)
{
  bits -= bits >> 1 & 0x5555555555555555ULL;
  bits = (bits & 0x3333333333333333ULL) + (bits >> 2 & 0x3333333333333333ULL);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fULL;
  return int(bits * 0x0101010101010101ULL >> 56);
}

/** Position of the lowest bit that is set; some bit is. */
inline int lowestBit(std::uint64_t bits)
{
#if defined(__GNUC__)
  return __builtin_ctzll(bits);
#else
  return countBits((bits & (0 - bits)) - 1);
#endif
}

/** Position of the highest bit that is set; some bit is. */
inline int highestBit(std::uint64_t bits)
{
#if defined(__GNUC__)
  return 63 - __builtin_clzll(bits);
#else
  for (int shift = 1; shift < 64; shift *= 2)
  {
    bits |= bits >> shift;
  }
  return countBits(bits) - 1;
#endif
}

/** Eight consecutive bytes, wherever they begin. */
inline std::uint64_t wordAt(const std::uint8_t* bytes)
{
  std::uint64_t word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

} // namespace silhouette
