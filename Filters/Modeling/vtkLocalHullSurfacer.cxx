// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLocalHullSurfacer.h"

#include "FieldValues.h"
#include "LocalHullSurface.h"
#include "MeshConversion.h"
#include "OctreeConversion.h"
#include "OctreeSharing.h"
#include "PieceRequests.h"
#include "PreparedViewsSharing.h"
#include "vtkSilhouetteExecution.h"

#include "vtkCellData.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

using namespace silhouette::modeling;

namespace
{

/** The filter's inputs as the core takes them. */
struct Inputs
{
  silhouette::Mesh surface;
  SharedOctree octree;
  SharedViews views; ///< null without views

  Inputs(vtkPolyData* polyData, vtkHyperTreeGrid* grid, vtkPartitionedDataSetCollection* collection,
         silhouette::Execution& execution)
  {
    this->surface = meshOf(polyData, "the surface");
    this->octree = sharedOctree(grid);
    if (collection)
    {
      silhouette::ViewOptions options;
      options.outside = this->octree->outside;
      this->views = preparedViews(collection, options, execution);
    }
    execution.checkpoint(1.0);
  }
};

void storeSurface(const silhouette::LocalHullSurface& found, const MeshOutput& output, vtkPolyData* surface)
{
  storeMesh(found.mesh, output, surface);
  setField(surface, "Survivors", found.survivors);
  setField(surface, "CoveredOctants", found.coveredOctants);
  setField(surface, "CoveringCorners", found.coveringCorners);
  setField(surface, "Bridges", found.bridges);
  setField(surface, "CavitiesFilled", found.cavitiesFilled);
  setField(surface, "IgnoredPoints", found.ignoredPoints);
  setField(surface, "MovedToMiddle", found.movedToMiddle);
  setField(surface, "DroppedOctants", found.dropped.octants);
  if (!found.dropped.leaves.empty())
  {
    setField(surface, "DroppedLeaves", found.dropped.leaves);
  }
  setField(surface, "HandleCorners", found.handleCorners);
  setField(surface, "TunnelCorners", found.tunnelCorners);
  setField(surface, "Deficit", found.deficit);
  setField(surface, "Shift", found.shift);
  setField(surface, "Alignment", found.alignment);
  setField(surface, "RepairedPixels", found.repairedPixels);
}

/** The triangles of a piece: an even share, in order. */
void takePiece(silhouette::Mesh& mesh, const silhouette::Piece& piece)
{
  if (piece.count > 1)
  {
    mesh = silhouette::selectTriangles(mesh, silhouette::rangeOfPiece(mesh.triangles.size(), piece));
  }
}

void storeHulls(const std::vector<silhouette::LocalHull>& found, const silhouette::Piece& piece,
                const MeshOutput& output, vtkPolyData* hulls)
{
  silhouette::Mesh all;
  vtkNew<vtkIntArray> ids;
  ids->SetName("HullId");
  const silhouette::PieceRange range = silhouette::rangeOfPiece(found.size(), piece);
  for (std::size_t hull = range.first; hull < range.last; ++hull)
  {
    const auto offset = static_cast<std::int32_t>(all.points.size());
    const silhouette::Mesh& mesh = found[hull].mesh;
    all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    for (const silhouette::Triangle& t : mesh.triangles)
    {
      all.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
      ids->InsertNextValue(static_cast<int>(hull));
    }
  }
  storeMesh(all, output, hulls);
  hulls->GetCellData()->SetScalars(ids);
}

int requestedPort(vtkInformation* request)
{
  return request->Has(vtkExecutive::FROM_OUTPUT_PORT()) ? request->Get(vtkExecutive::FROM_OUTPUT_PORT()) : -1;
}

} // namespace

/** The settings as the core has them, and back. */
class vtkLocalHullSurfacer::vtkInternals
{
public:
  /** Call `pair(setting, option)` for every one that has the same type in both. */
  template <typename Surfacer, typename Options, typename Pair>
  static void forSettings(Surfacer& self, Options& options, const Pair& pair)
  {
    pair(self.FillCavities, options.fillCavities);
    pair(self.CoverOffset, options.coverOffset);
    pair(self.BridgeGap, options.bridgeGap);
    pair(self.HullTolerance, options.hulls.tolerance);
    pair(self.SeedBlock, options.hulls.seedBlock);
    pair(self.IslandShare, options.islandShare);
    pair(self.RepairSilhouettes, options.repairSilhouettes);
    pair(self.AlignViews, options.correction.alignViews);
    pair(self.CorrectField, options.correction.moveSurface);
    pair(self.ThinHulls, options.thinHulls);
    pair(self.JoinHandles, options.handles.joinHandles);
    pair(self.HandleReach, options.handles.reach);
    pair(self.FillTunnels, options.tunnels.fillTunnels);
    pair(self.TunnelWidth, options.tunnels.width);
    pair(self.LoopLength, options.handles.loop);
    pair(self.LoopLength, options.tunnels.loop);
    pair(self.SpeckleArea, options.repair.speckleArea);
    pair(self.SpeckleShare, options.repair.speckleShare);
    pair(self.BlobDepth, options.repair.blobDepth);
    pair(self.BlobChord, options.repair.blobChord);
    pair(self.BlobCorners, options.repair.blobCorners);
    pair(self.SmallestDeficit, options.correction.smallestDeficit);
    pair(self.SmallestShift, options.correction.smallestShift);
    pair(self.HullConvexity, options.correction.hullConvexity);
    pair(self.ModelDissent, options.correction.modelDissent);
    pair(self.Smoothing, options.correction.smoothing);
    pair(self.GreatestSmoothing, options.correction.greatestSmoothing);
    pair(self.Gentleness, options.correction.gentleness);
    pair(self.Alignments, options.correction.alignments);
    pair(self.ContourReach, options.correction.contourReach);
    pair(self.ThinSmallestRadius, options.thin.smallestRadius);
    pair(self.ThinLargestRadius, options.thin.largestRadius);
    pair(self.ThinReach, options.thin.reach);
    pair(self.SliceAxis, options.slices.axis);
    pair(self.SliceTolerance, options.slices.tolerance);
    pair(self.ChainTolerance, options.chains.tolerance);
    pair(self.ChainOverlap, options.chains.overlap);
  }

  static silhouette::LocalHullOptions options(const vtkLocalHullSurfacer& self)
  {
    silhouette::LocalHullOptions options;
    options.mode = static_cast<silhouette::LocalHullMode>(self.Mode);
    options.singlePrecision = self.OutputPointsPrecision == SINGLE_PRECISION;
    forSettings(self, options, [](const auto& setting, auto& option) { option = setting; });
    return options;
  }

  static void setDefaults(vtkLocalHullSurfacer& self)
  {
    const silhouette::LocalHullOptions options;
    self.Mode = static_cast<int>(options.mode);
    forSettings(self, options, [](auto& setting, const auto& option) { setting = option; });
  }
};

vtkStandardNewMacro(vtkLocalHullSurfacer);

vtkLocalHullSurfacer::vtkLocalHullSurfacer()
{
  vtkInternals::setDefaults(*this);
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
}

int vtkLocalHullSurfacer::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[] = {"vtkPolyData", "vtkHyperTreeGrid", "vtkPartitionedDataSetCollection"};
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

vtkTypeBool vtkLocalHullSurfacer::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                 vtkInformationVector* outputs)
{
  // The executive asks beforehand what will not be made. An output that was left out stays out of date, so
  // that asking for it later executes the filter for that output alone.
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    const int port = requestedPort(request);
    if (port >= 0)
    {
      outputs->GetInformationObject(1 - port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkLocalHullSurfacer::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                              vtkInformationVector*)
{
  requestWhole(inputs, 3);
  return 1;
}

int vtkLocalHullSurfacer::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                      vtkInformationVector* outputs)
{
  vtkHyperTreeGrid* grid = vtkHyperTreeGrid::GetData(inputs[1]);
  const int port = requestedPort(request);
  const silhouette::Piece piece = requestedPiece(request, outputs);

  const auto makeWhole = [&](vtkSilhouetteExecution& execution)
  {
    if (isEmpty(grid))
    {
      return;
    }
    const silhouette::LocalHullOptions options = vtkInternals::options(*this);
    silhouette::Phase reading(execution, 0.0, 0.1);
    vtkPartitionedDataSetCollection* collection = vtkPartitionedDataSetCollection::GetData(inputs[2]);
    const Inputs in(vtkPolyData::GetData(inputs[0]), grid, collection, reading);
    MeshOutput output;
    output.pointsPrecision = this->OutputPointsPrecision;
    output.normals = this->GenerateNormals;
    if (port != 1)
    {
      silhouette::Phase surfacing(execution, 0.1, port < 0 ? 0.5 : 1.0);
      silhouette::LocalHullSurface found =
          silhouette::localHullSurface(in.surface, *in.octree, in.views.get(), options, surfacing);
      takePiece(found.mesh, piece);
      storeSurface(found, output, vtkPolyData::GetData(outputs, 0));
    }
    if (port != 0)
    {
      silhouette::Phase classifying(execution, port < 0 ? 0.5 : 0.1, 1.0);
      storeHulls(silhouette::classifyLocalHulls(in.surface, *in.octree, in.views.get(), options, classifying),
                 piece, output, vtkPolyData::GetData(outputs, 1));
    }
    execution.progress(1.0);
  };
  return runFilter(this, outputs, makeWhole, port);
}

void vtkLocalHullSurfacer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << (this->Mode == THESIS ? "Thesis" : "Robust") << "\n";
  os << indent << "FillCavities: " << (this->FillCavities ? "On" : "Off") << "\n";
  os << indent << "CoverOffset: " << this->CoverOffset << "\n";
  os << indent << "BridgeGap: " << this->BridgeGap << "\n";
  os << indent << "HullTolerance: " << this->HullTolerance << "\n";
  os << indent << "SeedBlock: " << this->SeedBlock << "\n";
  os << indent << "IslandShare: " << this->IslandShare << "\n";
  os << indent << "RepairSilhouettes: " << (this->RepairSilhouettes ? "On" : "Off") << "\n";
  os << indent << "AlignViews: " << (this->AlignViews ? "On" : "Off") << "\n";
  os << indent << "CorrectField: " << (this->CorrectField ? "On" : "Off") << "\n";
  os << indent << "ThinHulls: " << (this->ThinHulls ? "On" : "Off") << "\n";
  os << indent << "JoinHandles: " << (this->JoinHandles ? "On" : "Off") << "\n";
  os << indent << "HandleReach: " << this->HandleReach << "\n";
  os << indent << "FillTunnels: " << (this->FillTunnels ? "On" : "Off") << "\n";
  os << indent << "TunnelWidth: " << this->TunnelWidth << "\n";
  os << indent << "LoopLength: " << this->LoopLength << "\n";
  os << indent << "SpeckleArea: " << this->SpeckleArea << "\n";
  os << indent << "SpeckleShare: " << this->SpeckleShare << "\n";
  os << indent << "BlobDepth: " << this->BlobDepth << "\n";
  os << indent << "BlobChord: " << this->BlobChord << "\n";
  os << indent << "BlobCorners: " << this->BlobCorners << "\n";
  os << indent << "SmallestDeficit: " << this->SmallestDeficit << "\n";
  os << indent << "SmallestShift: " << this->SmallestShift << "\n";
  os << indent << "HullConvexity: " << this->HullConvexity << "\n";
  os << indent << "ModelDissent: " << this->ModelDissent << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
  os << indent << "GreatestSmoothing: " << this->GreatestSmoothing << "\n";
  os << indent << "Gentleness: " << this->Gentleness << "\n";
  os << indent << "Alignments: " << this->Alignments << "\n";
  os << indent << "ContourReach: " << this->ContourReach << "\n";
  os << indent << "ThinSmallestRadius: " << this->ThinSmallestRadius << "\n";
  os << indent << "ThinLargestRadius: " << this->ThinLargestRadius << "\n";
  os << indent << "ThinReach: " << this->ThinReach << "\n";
  os << indent << "SliceAxis: " << this->SliceAxis << "\n";
  os << indent << "SliceTolerance: " << this->SliceTolerance << "\n";
  os << indent << "ChainTolerance: " << this->ChainTolerance << "\n";
  os << indent << "ChainOverlap: " << this->ChainOverlap << "\n";
  os << indent << "GenerateNormals: " << (this->GenerateNormals ? "On" : "Off") << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
}
