// SPDX-License-Identifier: BSD-3-Clause
/**
 * The system hands out memory page by page when it is first written to, which costs more than the writing. Large
 * arrays are therefore first touched by all threads side by side.
 */
#pragma once

#include "Execution.h"
#include "LargePages.h"

#include <vector>

namespace silhouette
{

/** Give an empty vector n values of 0; the same as resize(n), whatever the threads. */
template <typename Value>
void resizeSideBySide(std::vector<Value>& values, std::size_t n, Execution& execution)
{
  constexpr std::size_t Page = 4096;
  reserveLarge(values, n);
  auto* bytes = reinterpret_cast<volatile unsigned char*>(values.data());
  execution.forRanges(n * sizeof(Value) / Page, 64,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t page = first; page < last; ++page)
      {
        bytes[page * Page] = 0;
      }
    });
  values.resize(n);
}

} // namespace silhouette
