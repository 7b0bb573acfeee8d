// SPDX-License-Identifier: BSD-3-Clause
#include "Components.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace silhouette::program
{
namespace
{

/** Disjoint sets of points. */
class PointSets
{
public:
  explicit PointSets(vtkPolyData* triangles)
    : Parent(static_cast<std::size_t>(triangles->GetNumberOfPoints()))
  {
    std::iota(this->Parent.begin(), this->Parent.end(), vtkIdType(0));
    const auto cells = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
    for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* points = nullptr;
      cells->GetCurrentCell(size, points);
      for (vtkIdType i = 1; i < size; ++i)
      {
        this->unite(points[0], points[i]);
      }
    }
  }

  /** The lowest point of the set that `point` is in. */
  vtkIdType find(vtkIdType point)
  {
    while (this->parent(point) != point)
    {
      this->parent(point) = this->parent(this->parent(point));
      point = this->parent(point);
    }
    return point;
  }

private:
  vtkIdType& parent(vtkIdType point) { return this->Parent[static_cast<std::size_t>(point)]; }

  void unite(vtkIdType a, vtkIdType b)
  {
    const vtkIdType first = this->find(a), second = this->find(b);
    this->parent(std::max(first, second)) = std::min(first, second);
  }

  std::vector<vtkIdType> Parent;
};

/** Volume by component, the component named by its lowest point; that of a cavity's wall is negative. */
std::map<vtkIdType, double> volumes(vtkPolyData* triangles, PointSets& sets)
{
  std::map<vtkIdType, double> volumes;
  double middle[3];
  triangles->GetCenter(middle);
  const auto cells = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    cells->GetCurrentCell(size, points);
    double corners[3][3];
    for (int i = 0; i < 3; ++i)
    {
      triangles->GetPoint(points[i], corners[i]);
      vtkMath::Subtract(corners[i], middle, corners[i]);
    }
    volumes[sets.find(points[0])] += vtkMath::Determinant3x3(corners[0], corners[1], corners[2]) / 6.0;
  }
  return volumes;
}

/** New numbers for the points of one component, -1 for the others; the points themselves go to `kept`. */
std::vector<vtkIdType> keepPoints(vtkPolyData* triangles, PointSets& sets, vtkIdType component, vtkPolyData* kept)
{
  std::vector<vtkIdType> numbers(static_cast<std::size_t>(triangles->GetNumberOfPoints()), -1);
  vtkNew<vtkPoints> points;
  points->SetDataType(triangles->GetPoints()->GetDataType());
  kept->GetPointData()->CopyAllocate(triangles->GetPointData());
  for (vtkIdType i = 0; i < triangles->GetNumberOfPoints(); ++i)
  {
    if (sets.find(i) == component)
    {
      const vtkIdType number = points->InsertNextPoint(triangles->GetPoint(i));
      kept->GetPointData()->CopyData(triangles->GetPointData(), i, number);
      numbers[static_cast<std::size_t>(i)] = number;
    }
  }
  kept->SetPoints(points);
  return numbers;
}

} // namespace

vtkIdType countComponents(vtkPolyData* triangles)
{
  PointSets sets(triangles);
  return static_cast<vtkIdType>(volumes(triangles, sets).size());
}

vtkSmartPointer<vtkPolyData> largestComponent(vtkPolyData* triangles)
{
  PointSets sets(triangles);
  const std::map<vtkIdType, double> byVolume = volumes(triangles, sets);
  auto kept = vtkSmartPointer<vtkPolyData>::New();
  if (byVolume.empty())
  {
    return kept;
  }
  const auto largest = std::max_element(byVolume.begin(), byVolume.end(),
    [](const auto& first, const auto& second) { return first.second < second.second; });
  const std::vector<vtkIdType> numbers = keepPoints(triangles, sets, largest->first, kept);
  vtkNew<vtkCellArray> faces;
  const auto cells = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    cells->GetCurrentCell(size, points);
    if (sets.find(points[0]) == largest->first)
    {
      faces->InsertNextCell(3);
      for (int i = 0; i < 3; ++i)
      {
        faces->InsertCellPoint(numbers[static_cast<std::size_t>(points[i])]);
      }
    }
  }
  kept->SetPolys(faces);
  kept->GetFieldData()->ShallowCopy(triangles->GetFieldData());
  return kept;
}

} // namespace silhouette::program
