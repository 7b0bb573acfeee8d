// SPDX-License-Identifier: BSD-3-Clause
#include "MeshConversion.h"

#include "Error.h"
#include "LargeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedShortArray.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace silhouette::modeling
{
namespace
{

void storePoints(const Mesh& mesh, bool single, vtkPolyData* out)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(single ? VTK_FLOAT : VTK_DOUBLE);
  setTuples(points->GetData(), static_cast<vtkIdType>(mesh.points.size()));
  if (!single && !mesh.points.empty())
  {
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "points are three doubles each");
    std::memcpy(points->GetVoidPointer(0), mesh.points.data(), mesh.points.size() * sizeof(Eigen::Vector3d));
  }
  for (std::size_t i = 0; single && i < mesh.points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  out->SetPoints(points);
}

void storeTriangles(const Mesh& mesh, vtkPolyData* out)
{
  const auto count = static_cast<vtkIdType>(mesh.triangles.size());
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> corners;
  setTuples(offsets, count + 1);
  setTuples(corners, 3 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    offsets->SetValue(i, 3 * i);
    for (int c = 0; c < 3; ++c)
    {
      corners->SetValue(3 * i + c, mesh.triangles[static_cast<std::size_t>(i)][c]);
    }
  }
  offsets->SetValue(count, 3 * count);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  out->SetPolys(cells);
}

void storeNormals(const Mesh& mesh, vtkPolyData* out)
{
  auto sums = largeVector<Eigen::Vector3d>(mesh.points.size(), Eigen::Vector3d::Zero());
  for (const Triangle& t : mesh.triangles)
  {
    // Twice the area times the unit normal: large triangles count for more.
    const Eigen::Vector3d normal =
        (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    for (const std::int32_t corner : t)
    {
      sums[corner] += normal;
    }
  }
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  setTuples(normals, static_cast<vtkIdType>(sums.size()));
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    const Eigen::Vector3d unit = sums[i].normalized();
    normals->SetTuple(static_cast<vtkIdType>(i), unit.data());
  }
  out->GetPointData()->SetNormals(normals);
}

} // namespace

void storeMesh(const Mesh& mesh, const MeshOutput& options, vtkPolyData* out)
{
  const bool single = options.pointsPrecision == vtkAlgorithm::SINGLE_PRECISION;
  storePoints(mesh, single, out);
  storeTriangles(mesh, out);
  if (options.normals)
  {
    storeNormals(mesh, out);
  }
}

void storeInsideVotes(const std::vector<std::array<std::uint16_t, 2>>& votes, vtkPolyData* out)
{
  vtkNew<vtkUnsignedShortArray> array;
  array->SetName("InsideVotes");
  array->SetNumberOfComponents(2);
  array->SetComponentName(0, "InsideEnd");
  array->SetComponentName(1, "OutsideEnd");
  setTuples(array, static_cast<vtkIdType>(votes.size()));
  for (std::size_t i = 0; i < votes.size(); ++i)
  {
    array->SetTypedTuple(static_cast<vtkIdType>(i), votes[i].data());
  }
  out->GetPointData()->AddArray(array);
}

Mesh meshOf(vtkPolyData* surface, const char* what)
{
  if (surface->GetNumberOfPoints() > std::numeric_limits<std::int32_t>::max())
  {
    throw InvalidInput(std::string(what) + " has more than 2^31 - 1 points");
  }
  if (surface->GetNumberOfPolys() > std::numeric_limits<std::int32_t>::max())
  {
    throw InvalidInput(std::string(what) + " has more than 2^31 - 1 triangles");
  }
  if (surface->GetNumberOfStrips() > 0)
  {
    throw InvalidInput(std::string(what) + " has triangle strips; vtkTriangleFilter makes triangles of them");
  }
  Mesh mesh;
  resizeLarge(mesh.points, static_cast<std::size_t>(surface->GetNumberOfPoints()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    surface->GetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
    if (!mesh.points[i].allFinite())
    {
      throw InvalidInput(std::string(what) + ": point " + std::to_string(i) + " is not finite");
    }
  }
  reserveLarge(mesh.triangles, static_cast<std::size_t>(surface->GetNumberOfPolys()));
  auto cells = vtk::TakeSmartPointer(surface->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCurrentCell(size, corners);
    if (size != 3)
    {
      throw InvalidInput(std::string(what) + ": polygon " + std::to_string(cells->GetCurrentCellId()) +
                         " has " + std::to_string(size) +
                         " corners, not 3; vtkTriangleFilter makes triangles of them");
    }
    for (int c = 0; c < 3; ++c)
    {
      if (corners[c] < 0 || corners[c] >= surface->GetNumberOfPoints())
      {
        throw InvalidInput(std::string(what) + ": triangle " + std::to_string(cells->GetCurrentCellId()) +
                           " names point " + std::to_string(corners[c]) + ", there are " +
                           std::to_string(surface->GetNumberOfPoints()));
      }
    }
    mesh.triangles.push_back({static_cast<std::int32_t>(corners[0]), static_cast<std::int32_t>(corners[1]),
                              static_cast<std::int32_t>(corners[2])});
  }
  return mesh;
}

} // namespace silhouette::modeling
