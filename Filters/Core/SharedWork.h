// SPDX-License-Identifier: BSD-3-Clause
/**
 * Items that are worked on one after another by each of several workers, which keep their memory from one to the next.
 */
#pragma once

#include "Execution.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace silhouette
{

/**
 * Call `work(i)` once for each i below `count`, by as many workers as there are threads: whoever is free takes the next. `makeWork()` makes the work of each. It is not asked meanwhile
 * whether to stop.
 */
template <typename MakeWork>
void shareWork(std::size_t count, Execution& execution, const MakeWork& makeWork)
{
  std::atomic<std::size_t> next{ 0 };
  execution.forRanges(std::min(count, std::size_t(std::max(execution.threads(), 1))), 1,
    [&](std::size_t, std::size_t)
    {
      auto work = makeWork();
      for (std::size_t i = next++; i < count; i = next++)
      {
        work(i);
      }
    });
}

} // namespace silhouette
