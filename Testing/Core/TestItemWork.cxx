// SPDX-License-Identifier: BSD-3-Clause
#include "ItemWork.h"

#include "EvaluationTestMeshes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Stops after having told its progress twice. */
class StoppedExecution : public Execution
{
public:
  void progress(double) override { ++this->Told; }
  bool cancelled() const override { return this->Told >= 2; }

private:
  int Told = 0;
};

} // namespace

TEST(ItemWork, EachItemOnce)
{
  for (const int threads : { 1, 2, 8 })
  {
    for (const std::size_t count : { 0u, 1u, 7u, 100u })
    {
      ThreadedExecution execution(threads);
      std::vector<std::atomic<int>> done(count);
      forItems(count, execution, [&](std::size_t i) { ++done[i]; });
      for (const auto& times : done)
      {
        EXPECT_EQ(times, 1);
      }
    }
  }
  ProgressExecution progress;
  forItems(7, progress, [](std::size_t) {});
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}

TEST(ItemWork, ThrowsTheFirstFailureAndNoneThatComesAfterIt)
{
  for (const int threads : { 1, 2, 8 })
  {
    ThreadedExecution execution(threads);
    std::atomic<int> worked{ 0 };
    try
    {
      forItems(100, execution,
        [&](std::size_t i)
        {
          ++worked;
          if (i >= 41)
          {
            throw std::runtime_error("item " + std::to_string(i));
          }
        });
      FAIL();
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_EQ(std::string(error.what()), "item 41");
    }
    EXPECT_LT(worked, 100);
  }
}

TEST(ItemWork, NoTwoSideBySideShareAPlace)
{
  for (const int threads : { 1, 2, 8 })
  {
    ThreadedExecution execution(threads);
    std::vector<std::atomic<int>> busy(itemsAtATime(execution));
    std::atomic<int> shared{ 0 };
    forItems(100, execution,
      [&](std::size_t i)
      {
        auto& place = busy[i % busy.size()];
        shared += place++ != 0;
        std::this_thread::yield();
        --place;
      });
    EXPECT_EQ(shared, 0);
  }
}

TEST(ItemWork, StopsBetweenItems)
{
  StoppedExecution execution;
  int worked = 0;
  EXPECT_THROW(forItems(100, execution, [&](std::size_t) { ++worked; }), Cancelled);
  EXPECT_LT(worked, 50);
}
