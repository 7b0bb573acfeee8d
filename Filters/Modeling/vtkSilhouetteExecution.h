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

/**
 * Run a filter's work and settle how it ended: 1 where it was done, or was cancelled (outputs empty, no error
 * text); 0 after an error, with its text as the filter's error and the outputs empty. `port` restricts what
 * is emptied to one output port; -1 is all of them.
 */
int runFilter(vtkAlgorithm* filter, vtkInformationVector* outputs,
              const std::function<void(vtkSilhouetteExecution&)>& work, int port = -1);

} // namespace silhouette::modeling
