// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVotingMarchingCubes.h"

#include "CellSafety.h"
#include "FieldValues.h"
#include "MeshConversion.h"
#include "OctreeConversion.h"
#include "OctreeSharing.h"
#include "PieceRequests.h"
#include "PreparedViewsSharing.h"
#include "VotingMarchingCubes.h"
#include "vtkSilhouetteExecution.h"

#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

using namespace silhouette::modeling;

vtkStandardNewMacro(vtkVotingMarchingCubes);

vtkVotingMarchingCubes::vtkVotingMarchingCubes()
    : Share(silhouette::VotingOptions().share),
      EdgePlacement(static_cast<int>(silhouette::VotingOptions().edges)),
      Mode(static_cast<int>(silhouette::VotingOptions().mode))
{
  this->SetNumberOfInputPorts(2);
}

int vtkVotingMarchingCubes::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
            port == 0 ? "vtkHyperTreeGrid" : "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkVotingMarchingCubes::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                        vtkInformationVector* outputs)
{
  vtkHyperTreeGrid* grid = vtkHyperTreeGrid::GetData(inputs[0]);
  vtkPartitionedDataSetCollection* collection = vtkPartitionedDataSetCollection::GetData(inputs[1]);
  vtkPolyData* surface = vtkPolyData::GetData(outputs);

  const auto contour = [&](vtkSilhouetteExecution& execution)
  {
    if (isEmpty(grid) || isNothing(requestedPiece(request, outputs)))
    {
      return;
    }
    const SharedOctree shared = sharedOctree(grid);
    const silhouette::Octree& octree = *shared;
    if (this->OutputPointsPrecision == SINGLE_PRECISION)
    {
      silhouette::requireSinglePrecision(octree.lattice);
    }
    execution.checkpoint(0.05);
    silhouette::Phase preparing(execution, 0.05, 0.1);
    silhouette::ViewOptions viewOptions;
    viewOptions.outside = octree.outside;
    const SharedViews views = preparedViews(collection, viewOptions, preparing);

    silhouette::Phase contouring(execution, 0.1, 0.95);
    silhouette::VotingOptions options;
    options.share = this->Share;
    options.edges = static_cast<silhouette::EdgePlacement>(this->EdgePlacement);
    options.mode = static_cast<silhouette::VotingMode>(this->Mode);
    const silhouette::VotingSurface found =
        silhouette::votingMarchingCubes(octree, *views, options, contouring);

    MeshOutput output;
    output.pointsPrecision = this->OutputPointsPrecision;
    output.normals = this->GenerateNormals;
    storeMesh(found.mesh, output, surface);
    storeInsideVotes(found.insideVotes, surface);
    setField(surface, "IntersectionOctants", found.intersectionOctants);
    setField(surface, "LostNoCorner", found.lostNoCorner);
    setField(surface, "LostAllCorners", found.lostAllCorners);
    setField(surface, "Vertices", std::uint64_t(found.mesh.points.size()));
    setField(surface, "Faces", std::uint64_t(found.mesh.triangles.size()));
    execution.progress(1.0);
  };
  return runFilter(this, outputs, contour);
}

void vtkVotingMarchingCubes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Share: " << this->Share << "\n";
  const char* const places[] = {"Middle", "Exact", "SubPixel"};
  os << indent << "EdgePlacement: " << places[this->EdgePlacement] << "\n";
  os << indent << "Mode: " << (this->Mode == CONSISTENT ? "Consistent" : "Faithful") << "\n";
  os << indent << "GenerateNormals: " << (this->GenerateNormals ? "On" : "Off") << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
}
