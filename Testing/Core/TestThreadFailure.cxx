// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadFailure.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace silhouette;

TEST(ThreadFailure, ThrowsNothingWhereNothingFailed)
{
  ThreadFailure failure;
  int done = 0;
  failure.guard([&] { ++done; });
  failure.guard([&] { ++done; });
  EXPECT_NO_THROW(failure.rethrow());
  EXPECT_EQ(done, 2);
}

TEST(ThreadFailure, ThrowsTheFirstAndDoesNoWorkAfterIt)
{
  ThreadFailure failure;
  int done = 0;
  failure.guard([&] { ++done; });
  failure.guard([] { throw std::runtime_error("the first"); });
  failure.guard([&] { ++done; });
  failure.guard([] { throw std::bad_alloc(); });
  EXPECT_EQ(done, 1);
  try
  {
    failure.rethrow();
    ADD_FAILURE() << "nothing was thrown";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "the first");
  }
}

TEST(ThreadFailure, KeepsExceptionsWithinTheirThreads)
{
  ThreadFailure failure;
  std::vector<std::thread> threads;
  for (int n = 0; n < 8; ++n)
  {
    threads.emplace_back([&] { failure.guard([] { throw std::bad_alloc(); }); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_THROW(failure.rethrow(), std::bad_alloc);
}
