// SPDX-License-Identifier: BSD-3-Clause
#include "VtkMeshes.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <Eigen/Geometry>

#include <utility>

namespace silhouette::experiments
{

vtkSmartPointer<vtkPolyData> pointSet(const std::vector<Eigen::Vector3d>& points)
{
  vtkNew<vtkPoints> coordinates;
  coordinates->SetDataTypeToDouble();
  for (const Eigen::Vector3d& p : points)
  {
    coordinates->InsertNextPoint(p.data());
  }
  vtkNew<vtkPolyData> result;
  result->SetPoints(coordinates);
  return result;
}

vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh)
{
  vtkSmartPointer<vtkPolyData> result = pointSet(mesh.points);
  vtkNew<vtkCellArray> triangles;
  for (const Triangle& t : mesh.triangles)
  {
    const vtkIdType ids[] = {t[0], t[1], t[2]};
    triangles->InsertNextCell(3, ids);
  }
  result->SetPolys(triangles);
  return result;
}

Mesh meshOf(vtkPolyData* surface)
{
  Mesh mesh;
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    mesh.points.emplace_back(surface->GetPoint(p));
  }
  vtkCellArray* polygons = surface->GetPolys();
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType c = 0; c < polygons->GetNumberOfCells(); ++c)
  {
    polygons->GetCellAtId(c, count, ids);
    if (count == 3)
    {
      mesh.triangles.push_back({std::int32_t(ids[0]), std::int32_t(ids[1]), std::int32_t(ids[2])});
    }
  }
  return mesh;
}

Mesh outwards(Mesh mesh)
{
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]]));
  }
  for (std::size_t t = 0; volume < 0.0 && t < mesh.triangles.size(); ++t)
  {
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return mesh;
}

} // namespace silhouette::experiments
