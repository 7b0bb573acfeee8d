// SPDX-License-Identifier: BSD-3-Clause
/**
 * Runs the core's loops through vtkSMPTools, and hands its progress and its questions whether to stop to a
 * VTK filter. Progress never falls, and only the thread that made the object reports it. Private to the
 * module.
 */
#pragma once

#include "Execution.h"

#include <functional>
#include <string>
#include <thread>

class vtkAlgorithm;
class vtkInformationVector;

class vtkSilhouetteExecution : public silhouette::Execution
{
public:
  explicit vtkSilhouetteExecution(vtkAlgorithm* filter);

  void forRanges(std::size_t count, std::size_t grain, const Range& work) override;
  int threads() const override;
  bool cancelled() const override;
  void progress(double fraction) override;

private:
  vtkAlgorithm* Filter;
  std::thread::id Caller;
  double Last = 0.0;
};

namespace silhouette::modeling
{

/** How a filter's work ended. */
struct Outcome
{
  enum class End
  {
    Done,
    Cancelled,
    Failed
  };
  End end = End::Done;
  std::string message; ///< of a failure
};

/** Run a filter's work; throws nothing. */
Outcome attempt(vtkAlgorithm* filter, const std::function<void(vtkSilhouetteExecution&)>& work);

/**
 * What RequestData returns, and does, for an outcome: 1 where the work was done, or was cancelled (outputs
 * empty, no error text); 0 after an error, with its text as the filter's error and the outputs empty. `port`
 * restricts what is emptied to one output port; -1 is all of them.
 */
int settle(vtkAlgorithm* filter, vtkInformationVector* outputs, const Outcome& outcome, int port = -1);

/** Both: run a filter's work and settle how it ended. */
int runFilter(vtkAlgorithm* filter, vtkInformationVector* outputs,
              const std::function<void(vtkSilhouetteExecution&)>& work, int port = -1);

} // namespace silhouette::modeling
