// SPDX-License-Identifier: BSD-3-Clause
/**
 * `vtksilhouette evaluate`: how good is a mesh?
 */
#pragma once

#include "CaptureOptions.h"
#include "Commands.h"

#include <string>

namespace silhouette::program
{

class Evaluate : public Command
{
public:
  explicit Evaluate(CLI::App& program);
  void finish() override;
  void run() override;

private:
  std::string Mesh;
  std::string Capture;
  CaptureOptions Silhouettes;
  std::string Truth;
  double SampleSpacing = 0.0;
  std::string MetricsFile;
  int Threads = 0;
  bool Quiet = false;
};

} // namespace silhouette::program
