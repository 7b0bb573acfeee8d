// SPDX-License-Identifier: BSD-3-Clause
#include "ChildNumbering.h"

#include "FirstTouch.h"
#include "NumberedCount.h"

#include <algorithm>
#include <numeric>

namespace silhouette
{

void numberChildren(Generation& generation, Execution& execution)
{
  constexpr std::size_t RunSize = 4096;
  const std::size_t count = generation.size(), runs = (count + RunSize - 1) / RunSize;
  const auto forRuns = [&](const auto& work)
  {
    execution.forRanges(runs, 4,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t run = first; run < last; ++run)
        {
          work(run, run * RunSize, std::min(count, (run + 1) * RunSize));
        }
      });
  };
  std::vector<std::uint32_t> before(runs + 1, 0); // blocks before each run
  forRuns(
    [&](std::size_t run, std::size_t first, std::size_t last)
    {
      before[run + 1] = std::uint32_t(std::count(
        generation.state.begin() + std::ptrdiff_t(first), generation.state.begin() + std::ptrdiff_t(last), OctantState::Intersection));
    });
  numberedCount(std::accumulate(before.begin(), before.end(), std::size_t(0)), "subdivided octants of one generation");
  std::partial_sum(before.begin(), before.end(), before.begin());
  resizeSideBySide(generation.childBlock, count, execution);
  forRuns(
    [&](std::size_t run, std::size_t first, std::size_t last)
    {
      std::uint32_t blocks = before[run];
      for (std::size_t i = first; i < last; ++i)
      {
        generation.childBlock[i] = blocks;
        blocks += generation.state[i] == OctantState::Intersection;
      }
    });
}

} // namespace silhouette
