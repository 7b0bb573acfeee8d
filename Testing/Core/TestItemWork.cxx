// SPDX-License-Identifier: BSD-3-Clause
#include "ItemWork.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

using namespace silhouette;

namespace
{

/** As many threads as it is told, whatever the machine has; stops when it is told. */
class Threads : public Execution
{
public:
  explicit Threads(int count)
    : Count(count)
  {
  }
  int threads() const override { return this->Count; }
  void forRanges(std::size_t count, std::size_t, const Range& work) override
  {
    std::vector<std::thread> workers;
    for (std::size_t first = 0; first < count; ++first)
    {
      workers.emplace_back([&work, first] { work(first, first + 1); });
    }
    for (std::thread& worker : workers)
    {
      worker.join();
    }
  }
  void progress(double share) override { this->Shares.push_back(share); }
  bool cancelled() const override { return this->Shares.size() >= this->StopAfter; }

  std::vector<double> Shares;
  std::size_t StopAfter = 1000;

private:
  int Count;
};

} // namespace

TEST(ItemWork, EachItemOnce)
{
  for (const int threads : { 1, 2, 8 })
  {
    for (const std::size_t count : { 0u, 1u, 7u, 100u })
    {
      Threads execution(threads);
      std::vector<std::atomic<int>> done(count);
      forItems(count, execution, [&](std::size_t i) { ++done[i]; });
      for (const auto& times : done)
      {
        EXPECT_EQ(times, 1);
      }
      EXPECT_TRUE(count == 0 || execution.Shares.back() == 1.0);
    }
  }
}

TEST(ItemWork, ThrowsTheFirstFailureAndNoneThatComesAfterIt)
{
  for (const int threads : { 1, 2, 8 })
  {
    Threads execution(threads);
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

TEST(ItemWork, StopsBetweenItems)
{
  Threads execution(2);
  execution.StopAfter = 2;
  std::atomic<int> worked{ 0 };
  EXPECT_THROW(forItems(100, execution, [&](std::size_t) { ++worked; }), Cancelled);
  EXPECT_LT(worked, 50);
}
