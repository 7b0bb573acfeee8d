// SPDX-License-Identifier: BSD-3-Clause
/**
 * Large arrays in large pages: the system hands out memory page by page when it is first written to, and with pages of
 * 4 KiB that takes longer than the writing (Documentation/performance.md).
 */
#pragma once

#include <cstddef>
#include <vector>

namespace silhouette
{

/** Of an array that is worth it. Smaller ones are mostly made of memory that the C library has kept, and has been written to before. */
constexpr std::size_t LeastLargeBytes = std::size_t(1) << 24;

/**
 * Tell the system that memory, nothing of which has been written to yet, is going to be used as a whole. Where it has no large pages, or has been told to
 * hand out none, nothing happens. Cost: of less than LeastLargeBytes none, else a system call.
 */
void adviseLargePages(void* memory, std::size_t bytes);

/** Reserve an empty vector's memory for n values that will all be written. */
template <typename Value>
void reserveLarge(std::vector<Value>& values, std::size_t n)
{
  values.reserve(n);
  adviseLargePages(values.data(), n * sizeof(Value));
}

/** Give an empty vector n values; the same as resize(n). */
template <typename Value>
void resizeLarge(std::vector<Value>& values, std::size_t n)
{
  reserveLarge(values, n);
  values.resize(n);
}

/** The same as std::vector<Value>(n, value). */
template <typename Value>
std::vector<Value> largeVector(std::size_t n, const Value& value = Value())
{
  std::vector<Value> values;
  reserveLarge(values, n);
  values.resize(n, value);
  return values;
}

} // namespace silhouette
