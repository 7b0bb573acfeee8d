// SPDX-License-Identifier: BSD-3-Clause
/**
 * Items that are worked on each for itself, and may fail: images that are read, views that are checked.
 */
#pragma once

#include "Execution.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

namespace silhouette
{

/** So many items forItems() has under way at most: two whose numbers are alike modulo this are never worked on side by side, so that memory kept from one item to another needs no more places. */
inline std::size_t itemsAtATime(const Execution& execution)
{
  return 2 * std::size_t(std::max(execution.threads(), 1));
}

/**
 * Call `work(i)` once for each i below `count`, some of them side by side, and tell how far it is after each few, so that whoever wants to stop need not wait for all. Where some throw, what the
 * first of them threw is thrown on, whichever thread came to it first; later ones may then not have been worked on.
 */
template <typename Work>
void forItems(std::size_t count, Execution& execution, const Work& work)
{
  const std::size_t batch = itemsAtATime(execution);
  for (std::size_t begin = 0; begin < count; begin += batch)
  {
    const std::size_t end = std::min(begin + batch, count);
    std::vector<std::exception_ptr> failures(end - begin);
    execution.forRanges(end - begin, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          try
          {
            work(begin + i);
          }
          catch (...)
          {
            failures[i] = std::current_exception();
          }
        }
      });
    for (const std::exception_ptr& failure : failures)
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    }
    execution.checkpoint(double(end) / double(count));
  }
}

} // namespace silhouette
