// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteExecution.h"

#include "OctreeSharing.h"
#include "PreparedViewsSharing.h"
#include "ThreadFailure.h"
#include "vtkSilhouetteCompatibility.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <new>

vtkSilhouetteExecution::vtkSilhouetteExecution(vtkAlgorithm* filter)
    : Filter(filter), Caller(std::this_thread::get_id())
{
}

void vtkSilhouetteExecution::forRanges(std::size_t count, std::size_t grain, const Range& work)
{
  if (count == 0)
  {
    return;
  }
  silhouette::ThreadFailure failure;
  const auto range = [&](vtkIdType first, vtkIdType last)
  { failure.guard([&] { work(static_cast<std::size_t>(first), static_cast<std::size_t>(last)); }); };
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), static_cast<vtkIdType>(std::max<std::size_t>(grain, 1)),
                   range);
  failure.rethrow();
}

int vtkSilhouetteExecution::threads() const
{
  return std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
}

bool vtkSilhouetteExecution::cancelled() const
{
  return silhouette::modeling::abortRequested(this->Filter);
}

void vtkSilhouetteExecution::progress(double fraction)
{
  // Observers may do anything, drawing included: they are called from the pipeline's own thread or not at
  // all.
  if (std::this_thread::get_id() != this->Caller)
  {
    return;
  }
  this->Last = std::max(this->Last, std::min(fraction, 1.0));
  this->Filter->UpdateProgress(this->Last);
}

namespace silhouette::modeling
{
namespace
{

void emptyOutputs(vtkInformationVector* outputs, int port)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject* data = vtkDataObject::GetData(outputs, i);
    if (data && (port < 0 || port == i))
    {
      data->Initialize();
      forgetPreparedViews(data);
      forgetOctree(data);
    }
  }
}

} // namespace

Outcome attempt(vtkAlgorithm* filter, const std::function<void(vtkSilhouetteExecution&)>& work)
{
  try
  {
    vtkSilhouetteExecution execution(filter);
    work(execution);
    // Asked to stop too late for the core to notice: the promise of an empty output holds all the same.
    return {execution.cancelled() ? Outcome::End::Cancelled : Outcome::End::Done, {}};
  }
  catch (const Cancelled&)
  {
    return {Outcome::End::Cancelled, {}};
  }
  catch (const std::bad_alloc&)
  {
    return {Outcome::End::Failed, "not enough memory; a smaller depth needs less"};
  }
  catch (const std::exception& error)
  {
    return {Outcome::End::Failed, error.what()};
  }
}

int settle(vtkAlgorithm* filter, vtkInformationVector* outputs, const Outcome& outcome, int port)
{
  if (outcome.end != Outcome::End::Done)
  {
    emptyOutputs(outputs, port);
  }
  if (outcome.end == Outcome::End::Failed)
  {
    vtkErrorWithObjectMacro(filter, << outcome.message);
    return 0;
  }
  return 1;
}

int runFilter(vtkAlgorithm* filter, vtkInformationVector* outputs,
              const std::function<void(vtkSilhouetteExecution&)>& work, int port)
{
  return settle(filter, outputs, attempt(filter, work), port);
}

} // namespace silhouette::modeling
