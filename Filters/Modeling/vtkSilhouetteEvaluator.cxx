// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteEvaluator.h"

#include "EvaluationTable.h"
#include "FieldValues.h"
#include "MeshConversion.h"
#include "OctreeConversion.h"
#include "OctreeSharing.h"
#include "PieceRequests.h"
#include "SurvivorIslands.h"
#include "ViewConversion.h"
#include "vtkSilhouetteExecution.h"

#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <memory>

using namespace silhouette::modeling;

namespace
{

silhouette::Mesh nonEmptyMesh(vtkPolyData* polyData, const char* what)
{
  silhouette::Mesh mesh = meshOf(polyData, what);
  if (mesh.triangles.empty())
  {
    throw silhouette::InvalidInput(std::string(what) + " has no triangles");
  }
  return mesh;
}

/** The octree without what the surface says was given up. */
std::shared_ptr<const silhouette::Octree> withoutDropped(
    const std::shared_ptr<const silhouette::Octree>& octree, vtkPolyData* surface)
{
  std::vector<std::uint64_t> leaves = getUnsignedFields(surface, "DroppedLeaves", "the surface");
  if (leaves.empty())
  {
    return octree;
  }
  std::sort(leaves.begin(), leaves.end());
  silhouette::DroppedSurvivors dropped;
  return std::make_shared<silhouette::Octree>(silhouette::dropLeaves(*octree, leaves, dropped));
}

} // namespace

vtkStandardNewMacro(vtkSilhouetteEvaluator);

vtkSilhouetteEvaluator::vtkSilhouetteEvaluator()
{
  this->SetNumberOfInputPorts(4);
}

int vtkSilhouetteEvaluator::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = {"vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPolyData",
                               "vtkHyperTreeGrid"};
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port >= 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkSilhouetteEvaluator::RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  if (requestedPiece(request, outputs).number > 0)
  {
    requestNothing(inputs, 4);
  }
  else
  {
    requestWhole(inputs, 4);
  }
  return 1;
}

int vtkSilhouetteEvaluator::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                        vtkInformationVector* outputs)
{
  vtkPartitionedDataSetCollection* collection = vtkPartitionedDataSetCollection::GetData(inputs[1]);
  vtkPolyData* truthData = vtkPolyData::GetData(inputs[2]);
  vtkHyperTreeGrid* grid = vtkHyperTreeGrid::GetData(inputs[3]);
  vtkTable* table = vtkTable::GetData(outputs);
  if (requestedPiece(request, outputs).number > 0)
  {
    return 1;
  }

  const auto evaluate = [&](vtkSilhouetteExecution& execution)
  {
    const silhouette::Mesh mesh = nonEmptyMesh(vtkPolyData::GetData(inputs[0]), "the surface");
    const std::vector<silhouette::View> views = silhouetteViews(imageViews(collection), execution);
    if (views.empty())
    {
      throw silhouette::InvalidInput("no views: silhouettes to compare the surface with are needed");
    }
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      const int rank = silhouette::projectionRank(views[i].projection);
      if (rank < 3)
      {
        throw silhouette::InvalidInput(silhouette::describeView(i, views[i].name) + ": the projection matrix has rank " +
                                       std::to_string(rank) + ", 3 is needed");
      }
    }
    execution.checkpoint(0.1);
    silhouette::Phase assessing(execution, 0.1, 0.4);
    storeSoundness(silhouette::assessMesh(mesh, assessing), table);
    silhouette::Phase comparing(execution, 0.4, 0.6);
    storeAgreement(silhouette::compareSilhouettes(mesh, views, comparing), table);

    double spacing = this->SampleSpacing;
    if (grid)
    {
      const auto octree = withoutDropped(sharedOctree(grid), vtkPolyData::GetData(inputs[0]));
      silhouette::Phase covering(execution, 0.6, 0.7);
      setField(table, "LostSurface", std::uint64_t(silhouette::lostSurvivors(*octree, mesh, covering)));
      setField(table, "LeafEdge", octree->lattice.leafEdge());
      spacing = spacing == 0.0 ? octree->lattice.leafEdge() : spacing;
    }
    if (truthData)
    {
      const silhouette::Mesh truth = nonEmptyMesh(truthData, "the truth");
      spacing = spacing == 0.0 ? longestSide(truth) / 512.0 : spacing;
      silhouette::Phase measuring(execution, 0.7, 1.0);
      storeTruth(silhouette::compareMeshes(mesh, truth, spacing, measuring), table);
      setField(table, "SampleSpacing", spacing);
    }
    execution.progress(1.0);
  };
  return runFilter(this, outputs, evaluate);
}

void vtkSilhouetteEvaluator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SampleSpacing: " << this->SampleSpacing << "\n";
}
