// SPDX-License-Identifier: BSD-3-Clause
#include "EvaluationTable.h"

#include "FieldValues.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTypeUInt64Array.h"

namespace silhouette::modeling
{
namespace
{

/** A column of one member of each view's agreement. */
template <typename Array, typename Member>
void addColumn(const std::vector<ViewAgreement>& views, const char* name, Member ViewAgreement::*member,
               vtkTable* table)
{
  vtkNew<Array> column;
  column->SetName(name);
  column->SetNumberOfValues(static_cast<vtkIdType>(views.size()));
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    column->SetValue(static_cast<vtkIdType>(i), views[i].*member);
  }
  table->AddColumn(column);
}

double mean(const std::vector<ViewAgreement>& views, double ViewAgreement::*member)
{
  double sum = 0.0;
  for (const ViewAgreement& view : views)
  {
    sum += view.*member;
  }
  return views.empty() ? 0.0 : sum / double(views.size());
}

} // namespace

void storeAgreement(const std::vector<ViewAgreement>& views, vtkTable* table)
{
  addColumn<vtkStringArray>(views, "Name", &ViewAgreement::name, table);
  addColumn<vtkDoubleArray>(views, "IoU", &ViewAgreement::iou, table);
  addColumn<vtkDoubleArray>(views, "XOR", &ViewAgreement::xorShare, table);
  addColumn<vtkTypeUInt64Array>(views, "FalseObject", &ViewAgreement::falseObject, table);
  addColumn<vtkTypeUInt64Array>(views, "FalseBackground", &ViewAgreement::falseBackground, table);
  addColumn<vtkTypeUInt64Array>(views, "SilhouettePixels", &ViewAgreement::silhouettePixels, table);
  addColumn<vtkTypeUInt64Array>(views, "MeshPixels", &ViewAgreement::meshPixels, table);
  const ViewAgreement total = totalAgreement(views);
  setField(table, "Views", int(views.size()));
  setField(table, "MeanIoU", mean(views, &ViewAgreement::iou));
  setField(table, "MeanXOR", mean(views, &ViewAgreement::xorShare));
  setField(table, "TotalIoU", total.iou);
  setField(table, "TotalXOR", total.xorShare);
  setField(table, "FalseObject", total.falseObject);
  setField(table, "FalseBackground", total.falseBackground);
}

void storeSoundness(const MeshSoundness& soundness, vtkTable* table)
{
  setField(table, "Points", soundness.points);
  setField(table, "UnusedPoints", soundness.unusedPoints);
  setField(table, "Triangles", soundness.triangles);
  setField(table, "OpenEdges", soundness.openEdges);
  setField(table, "NonManifoldEdges", soundness.nonManifoldEdges);
  setField(table, "NonManifoldVertices", soundness.nonManifoldVertices);
  setField(table, "InconsistentEdges", soundness.inconsistentEdges);
  setField(table, "SelfIntersections", soundness.selfIntersections);
  setField(table, "Components", soundness.components);
  if (soundness.genus)
  {
    setField(table, "Genus", int(*soundness.genus));
  }
  setField(table, "Volume", soundness.volume);
  setField(table, "Area", soundness.area);
  setField(table, "Closed", int(soundness.closed()));
  setField(table, "Sound", int(soundness.sound()));
}

void storeTruth(const MeshComparison& comparison, vtkTable* table)
{
  setField(table, "MeshToTruthMean", comparison.meshToTruth.mean);
  setField(table, "TruthToMeshMean", comparison.truthToMesh.mean);
  setField(table, "MeshToTruthMaximum", comparison.meshToTruth.maximum);
  setField(table, "TruthToMeshMaximum", comparison.truthToMesh.maximum);
  setField(table, "TruthMean", comparison.mean);
  setField(table, "TruthRMS", comparison.rms);
  setField(table, "TruthHausdorff", comparison.hausdorff);
}

double longestSide(const Mesh& mesh)
{
  if (mesh.points.empty())
  {
    return 0.0;
  }
  Eigen::Vector3d lowest = mesh.points.front(), highest = mesh.points.front();
  for (const Eigen::Vector3d& point : mesh.points)
  {
    lowest = lowest.cwiseMin(point);
    highest = highest.cwiseMax(point);
  }
  return (highest - lowest).maxCoeff();
}

} // namespace silhouette::modeling
