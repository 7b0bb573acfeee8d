// SPDX-License-Identifier: BSD-3-Clause
/**
 * How the core runs loops side by side, tells its progress and is asked to stop, without knowing who does it.
 *
 * The default runs everything on the calling thread. The VTK classes hand in one that uses vtkSMPTools and
 * vtkAlgorithm's progress and AbortExecute. Results never depend on how a loop is cut: every algorithm writes
 * each range's output to a place that depends on the range's position alone.
 */
#pragma once

#include "Error.h"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace silhouette
{

class Execution
{
public:
  using Range = std::function<void(std::size_t first, std::size_t last)>;

  virtual ~Execution() = default;

  /**
   * Call `work` on ranges that cover [0, count) once, perhaps at the same time. `grain` is the least number of
   * items worth handing to a thread. What `work` throws, as where memory is short, is thrown here, once no thread
   * works any more; of several the first, by time, so that errors that are told apart are not for it to throw.
   */
  virtual void forRanges(std::size_t count, std::size_t grain, const Range& work)
  {
    (void)grain;
    if (count > 0)
    {
      work(0, count);
    }
  }

  /** Number of threads that forRanges may use; a hint for cutting work. */
  virtual int threads() const { return 1; }

  /** True once the caller wants the algorithm to stop. Only asked on the calling thread. */
  virtual bool cancelled() const { return false; }

  /** Told the fraction done, in [0, 1] and never falling. Only called on the calling thread. */
  virtual void progress(double fraction) { (void)fraction; }

  /** Progress, then throw Cancelled if the caller wants to stop. */
  void checkpoint(double fraction)
  {
    progress(fraction);
    if (cancelled())
    {
      throw Cancelled();
    }
  }
};

/** A part of an algorithm too short to be told of: another Execution without its progress. */
class Unannounced : public Execution
{
public:
  explicit Unannounced(Execution& whole)
    : Whole(whole)
  {
  }

  void forRanges(std::size_t count, std::size_t grain, const Range& work) override
  {
    this->Whole.forRanges(count, grain, work);
  }
  int threads() const override { return this->Whole.threads(); }
  bool cancelled() const override { return this->Whole.cancelled(); }

private:
  Execution& Whole;
};

/** A phase of an algorithm: forwards to another Execution and maps its own 0 to 1 onto [from, to] of it. */
class Phase : public Execution
{
public:
  Phase(Execution& whole, double from, double to)
    : Whole(whole)
    , From(from)
    , To(to)
  {
  }

  void forRanges(std::size_t count, std::size_t grain, const Range& work) override
  {
    this->Whole.forRanges(count, grain, work);
  }
  int threads() const override { return this->Whole.threads(); }
  bool cancelled() const override { return this->Whole.cancelled(); }
  void progress(double fraction) override
  {
    this->Whole.progress(this->From + (this->To - this->From) * std::clamp(fraction, 0.0, 1.0));
  }

private:
  Execution& Whole;
  double From;
  double To;
};

} // namespace silhouette
