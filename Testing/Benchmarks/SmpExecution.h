// SPDX-License-Identifier: BSD-3-Clause
/**
 * The core's loops by vtkSMPTools, for programs that call the core without a filter.
 */
#pragma once

#include "Execution.h"
#include "ThreadFailure.h"

#include "vtkSMPTools.h"

#include <algorithm>

namespace silhouette
{

class SmpExecution : public Execution
{
public:
  void forRanges(std::size_t count, std::size_t grain, const Range& work) override
  {
    ThreadFailure failure;
    const auto range = [&](vtkIdType first, vtkIdType last)
    { failure.guard([&] { work(std::size_t(first), std::size_t(last)); }); };
    vtkSMPTools::For(0, vtkIdType(count), vtkIdType(std::max<std::size_t>(grain, 1)), range);
    failure.rethrow();
  }
  int threads() const override { return std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()); }
};

} // namespace silhouette
