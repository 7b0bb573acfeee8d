// SPDX-License-Identifier: BSD-3-Clause
#include "PieceSurface.h"

#include "vtkAppendPolyData.h"
#include "vtkCleanPolyData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkPolyData.h"

#include <initializer_list>

namespace silhouette::program
{
namespace
{

/** Add the named arrays of a piece's field data to those there are; the others are the same in every piece. */
void addUp(vtkDataObject* piece, std::initializer_list<const char*> names, vtkDataObject* sums)
{
  if (piece->GetFieldData()->GetNumberOfArrays() == 0)
  {
    return;
  }
  if (sums->GetFieldData()->GetNumberOfArrays() == 0)
  {
    sums->GetFieldData()->DeepCopy(piece->GetFieldData());
    return;
  }
  for (const char* name : names)
  {
    vtkDataArray* from = piece->GetFieldData()->GetArray(name);
    vtkDataArray* to = sums->GetFieldData()->GetArray(name);
    for (vtkIdType i = 0; from && to && i < to->GetNumberOfTuples(); ++i)
    {
      to->SetComponent(i, 0, to->GetComponent(i, 0) + from->GetComponent(i, 0));
    }
  }
}

} // namespace

PieceSurface::PieceSurface() = default;
PieceSurface::~PieceSurface() = default;

void PieceSurface::add(vtkHyperTreeGrid* octree, vtkPolyData* surface)
{
  addUp(octree, { "OctantsTested", "ViewTests", "CarvedByView", "InsideOctants", "IntersectionOctants" }, this->Octree);
  addUp(surface, { "IntersectionOctants", "LostNoCorner", "LostAllCorners", "Vertices", "Faces" }, this->Counts);
  if (surface->GetNumberOfPolys() > 0)
  {
    auto copy = vtkSmartPointer<vtkPolyData>::New();
    copy->SetPoints(surface->GetPoints());
    copy->SetPolys(surface->GetPolys());
    this->Surfaces.push_back(copy);
  }
}

vtkSmartPointer<vtkPolyData> PieceSurface::join()
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION); // that of the pieces
  for (const auto& surface : this->Surfaces)
  {
    append->AddInputData(surface);
  }
  vtkNew<vtkCleanPolyData> merge;
  merge->SetInputConnection(append->GetOutputPort());
  merge->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION);
  merge->ToleranceIsAbsoluteOn();
  merge->SetAbsoluteTolerance(0.0); // pieces compute a common point to the last bit
  merge->ConvertPolysToLinesOff();
  merge->ConvertLinesToPointsOff();
  vtkSmartPointer<vtkPolyData> whole = vtkSmartPointer<vtkPolyData>::New();
  if (!this->Surfaces.empty())
  {
    merge->Update();
    whole->ShallowCopy(merge->GetOutput());
  }
  this->Surfaces.clear();
  whole->SetFieldData(this->Counts->GetFieldData());
  return whole;
}

} // namespace silhouette::program
