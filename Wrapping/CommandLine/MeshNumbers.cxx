// SPDX-License-Identifier: BSD-3-Clause
#include "MeshNumbers.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkPolyData.h"

#include <cmath>

namespace silhouette::program
{

std::string pointsFault(vtkPolyData* mesh)
{
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    double at[3];
    mesh->GetPoint(point, at);
    if (!std::isfinite(at[0]) || !std::isfinite(at[1]) || !std::isfinite(at[2]))
    {
      return "point " + std::to_string(point) + " is not finite";
    }
  }
  return {};
}

std::string cornersFault(vtkPolyData* mesh)
{
  auto cells = vtk::TakeSmartPointer(mesh->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCurrentCell(size, corners);
    for (vtkIdType corner = 0; corner < size; ++corner)
    {
      if (corners[corner] < 0 || corners[corner] >= mesh->GetNumberOfPoints())
      {
        return "face " + std::to_string(cells->GetCurrentCellId()) + " names point " + std::to_string(corners[corner]) + ", there are " +
          std::to_string(mesh->GetNumberOfPoints());
      }
    }
  }
  return {};
}

} // namespace silhouette::program
