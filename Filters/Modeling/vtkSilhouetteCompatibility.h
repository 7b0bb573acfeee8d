// SPDX-License-Identifier: BSD-3-Clause
/**
 * What differs between the versions of VTK that this module builds against. Private; nothing else asks for a
 * version number.
 */
#pragma once

#include "vtkAlgorithm.h"
#include "vtkHyperTreeGrid.h"
#include "vtkVersionMacros.h"

namespace silhouette::modeling
{

/** True once somebody asked the filter to stop. */
inline bool abortRequested(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230101)
  return filter->CheckAbort();
#else
  return filter->GetAbortExecute() != 0;
#endif
}

/** Cells of all trees, masked ones too. */
inline vtkIdType numberOfOctants(vtkHyperTreeGrid* grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
  return grid->GetNumberOfCells();
#else
  return grid->GetNumberOfVertices();
#endif
}

} // namespace silhouette::modeling
