// SPDX-License-Identifier: BSD-3-Clause
/**
 * Runs a pipeline stage by stage: progress, time, warnings, errors and interrupts of each.
 */
#pragma once

#include "ExitCodes.h"
#include "Progress.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;

namespace silhouette::program
{

/** VTK's text of an error or a warning without file, line, class and address. */
std::string plainMessage(const char* vtkText);

/** From now on what no one observes in VTK becomes a warning of the program's. */
void routeOutputWindow();

class Stages
{
public:
  explicit Stages(bool quiet)
    : Bar(quiet)
  {
  }

  /**
   * Update a filter, or one piece of several of it. `key` names the stage in the metrics, `words` on the terminal. Throws ProgramError with
   * `code` and the filter's error, or Interrupted.
   */
  void run(vtkAlgorithm* filter, const std::string& key, const std::string& words, ExitCode code = ProcessingFailed,
    int piece = 0, int pieces = 1);

  /** Do other work as a stage. Throws what the work throws, or Interrupted. */
  void run(const std::string& key, const std::string& words, const std::function<void()>& work);

  /** Seconds by stage, in the order of their first run; stages run twice are added up. */
  const std::vector<std::pair<std::string, double>>& seconds() const { return this->Seconds; }

private:
  void addSeconds(const std::string& key, double seconds);

  Progress Bar;
  std::vector<std::pair<std::string, double>> Seconds;
};

} // namespace silhouette::program
