// SPDX-License-Identifier: BSD-3-Clause
/**
 * Exceptions in threads that somebody else has started, who may not carry them: of VTK's backends TBB does, others end the program.
 */
#pragma once

#include <atomic>
#include <exception>
#include <mutex>

namespace silhouette
{

/** Keeps an exception from leaving a thread until the caller asks for it. May be used by several threads at once, but for rethrow(). */
class ThreadFailure
{
public:
  /** Call `work()`, unless some work has failed before. */
  template <typename Work>
  void guard(const Work& work) noexcept
  {
    if (this->Failed)
    {
      return;
    }
    try
    {
      work();
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->Lock);
      if (!this->First)
      {
        this->First = std::current_exception();
      }
      this->Failed = true;
    }
  }

  /** Throw what was thrown first, if anything was. To be called once all work has ended. */
  void rethrow() const
  {
    if (this->First)
    {
      std::rethrow_exception(this->First);
    }
  }

private:
  std::atomic<bool> Failed{ false };
  std::mutex Lock;
  std::exception_ptr First;
};

} // namespace silhouette
