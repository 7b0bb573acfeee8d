// SPDX-License-Identifier: BSD-3-Clause
#include "SharedWork.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

TEST(SharedWork, EveryItemIsDoneOnceByWorkersThatKeepTheirMemory)
{
  for (const int threads : { 1, 2, 8 })
  {
    ThreadedExecution execution(threads);
    for (const std::size_t count : { 0, 1, 5, 1000 })
    {
      std::vector<std::atomic<int>> done(count);
      std::atomic<int> workers{ 0 };
      shareWork(count, execution,
        [&]
        {
          ++workers;
          return [&, last = std::ptrdiff_t(-1)](std::size_t i) mutable
          {
            EXPECT_GT(std::ptrdiff_t(i), last); // of one worker, one after another
            last = std::ptrdiff_t(i);
            ++done[i];
          };
        });
      EXPECT_LE(workers, threads);
      EXPECT_EQ(workers > 0, count > 0);
      for (std::size_t i = 0; i < count; ++i)
      {
        EXPECT_EQ(done[i], 1) << i << " of " << count << ", " << threads << " threads";
      }
    }
  }
}

TEST(SharedWork, WhatAWorkerThrowsArrives)
{
  Execution execution;
  const auto fail = [] { return [](std::size_t i) { i == 7 ? throw InvalidInput("the eighth") : void(); }; };
  EXPECT_THROW(shareWork(20, execution, fail), InvalidInput);
}
