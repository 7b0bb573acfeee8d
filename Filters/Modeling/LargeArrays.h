// SPDX-License-Identifier: BSD-3-Clause
/**
 * Large arrays of VTK's in large pages (LargePages). Private to the module.
 */
#pragma once

#include "LargePages.h"

#include "vtkDataArray.h"

namespace silhouette::modeling
{

/** array->SetNumberOfTuples(tuples), of an array that had none and whose values will all be written. */
inline void setTuples(vtkDataArray* array, vtkIdType tuples)
{
  array->SetNumberOfTuples(tuples);
  adviseLargePages(array->GetVoidPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()) *
                                                 static_cast<std::size_t>(array->GetDataTypeSize()));
}

} // namespace silhouette::modeling
