// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLocalHullSurfacer.h"

#include "FieldValues.h"
#include "LocalHullSurface.h"
#include "MeshConversion.h"
#include "OctreeConversion.h"
#include "OctreeSharing.h"
#include "PieceRequests.h"
#include "PreparedViewsSharing.h"
#include "RankSharing.h"
#include "vtkSilhouetteExecution.h"

#include "vtkCellData.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <optional>

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

/** The surface's counts, and of its triangles those of a piece: an even share, in order. */
void storeSurface(const silhouette::LocalHullSurface& found, const silhouette::Piece& piece,
                  const MeshOutput& output, vtkPolyData* surface)
{
  const std::size_t triangles = found.mesh.triangles.size();
  if (piece.count > 1)
  {
    storeMesh(silhouette::selectTriangles(found.mesh, silhouette::rangeOfPiece(triangles, piece)), output,
              surface);
  }
  else
  {
    storeMesh(found.mesh, output, surface);
  }
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

/** What the filter makes, of the whole; what is not asked for is not there. */
struct Found
{
  std::optional<silhouette::LocalHullSurface> surface;
  std::optional<std::vector<silhouette::LocalHull>> hulls;
};

/** The data of both outputs. */
using Outputs = std::array<vtkSmartPointer<vtkPolyData>, 2>;

void storePiece(const Found& found, const silhouette::Piece& piece, const MeshOutput& output,
                const Outputs& outputs)
{
  if (found.surface)
  {
    storeSurface(*found.surface, piece, output, outputs[0]);
  }
  if (found.hulls)
  {
    storeHulls(*found.hulls, piece, output, outputs[1]);
  }
}

/**
 * A piece as the outputs of another rank. `input`'s field data pass through, as VTK passes them to a filter's
 * outputs.
 */
Outputs shareOf(const Found& found, const silhouette::Piece& piece, const MeshOutput& output,
                vtkPolyData* input)
{
  Outputs share;
  for (auto& data : share)
  {
    data = vtkSmartPointer<vtkPolyData>::New();
    data->GetFieldData()->PassData(input->GetFieldData());
  }
  storePiece(found, piece, output, share);
  return share;
}

Outputs outputsOf(vtkInformationVector* outputs)
{
  return {vtkPolyData::GetData(outputs, 0), vtkPolyData::GetData(outputs, 1)};
}

/** Call `work(port)` for the output that is asked for; -1 is both. */
template <typename Work> void forPorts(int port, const Work& work)
{
  for (const int each : {0, 1})
  {
    if (port < 0 || port == each)
    {
      work(each);
    }
  }
}

/** Outputs without triangles have the arrays all the same. */
void storeEmpties(int port, const MeshOutput& output, const Outputs& outputs)
{
  if (port != 1 && outputs[0]->GetNumberOfCells() == 0)
  {
    storeMesh(silhouette::Mesh(), output, outputs[0]);
  }
  if (port != 0 && outputs[1]->GetNumberOfCells() == 0)
  {
    storeHulls({}, silhouette::Piece(), output, outputs[1]);
  }
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
    pair(self.ShiftNoise, options.correction.shiftNoise);
    pair(self.Alignments, options.correction.alignments);
    pair(self.ContourReach, options.correction.contourReach);
    pair(self.RaiseWidth, options.correction.raiseWidth);
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

  static MeshOutput meshOutput(const vtkLocalHullSurfacer& self)
  {
    MeshOutput output;
    output.pointsPrecision = self.OutputPointsPrecision;
    output.normals = self.GenerateNormals;
    return output;
  }

  /** The whole of what is asked for; nothing of an empty octree. */
  static Found make(const vtkLocalHullSurfacer& self, vtkInformationVector** inputs, int port,
                    vtkSilhouetteExecution& execution)
  {
    Found found;
    vtkHyperTreeGrid* grid = vtkHyperTreeGrid::GetData(inputs[1]);
    if (isEmpty(grid))
    {
      return found;
    }
    const silhouette::LocalHullOptions settings = options(self);
    silhouette::Phase reading(execution, 0.0, 0.1);
    vtkPartitionedDataSetCollection* collection = vtkPartitionedDataSetCollection::GetData(inputs[2]);
    const Inputs in(vtkPolyData::GetData(inputs[0]), grid, collection, reading);
    if (port != 1)
    {
      silhouette::Phase surfacing(execution, 0.1, port < 0 ? 0.5 : 1.0);
      found.surface =
          silhouette::localHullSurface(in.surface, *in.octree, in.views.get(), settings, surfacing);
    }
    if (port != 0)
    {
      silhouette::Phase classifying(execution, port < 0 ? 0.5 : 0.1, 1.0);
      found.hulls =
          silhouette::classifyLocalHulls(in.surface, *in.octree, in.views.get(), settings, classifying);
    }
    return found;
  }

  /** The first rank's work: make the whole, tell how that ended, keep a share and send the others theirs. */
  static Outcome makeForAll(vtkLocalHullSurfacer& self, vtkInformationVector** inputs, int port,
                            const Outputs& outputs)
  {
    vtkMultiProcessController* controller = self.Controller;
    std::vector<Outputs> shares;
    const auto makeShares = [&](vtkSilhouetteExecution& execution)
    {
      const Found found = make(self, inputs, port, execution);
      storePiece(found, pieceOfRank(controller, 0), meshOutput(self), outputs);
      for (int rank = 1; rank < controller->GetNumberOfProcesses(); ++rank)
      {
        shares.push_back(
            shareOf(found, pieceOfRank(controller, rank), meshOutput(self), vtkPolyData::GetData(inputs[0])));
      }
      execution.progress(1.0);
    };
    const Outcome made = attempt(&self, makeShares);
    tellOutcome(controller, made);
    if (made.end != Outcome::End::Done)
    {
      return made;
    }
    const auto send = [&](vtkSilhouetteExecution&)
    {
      for (std::size_t i = 0; i < shares.size(); ++i)
      {
        forPorts(port, [&](int asked) { sendShare(controller, shares[i][asked], int(i) + 1); });
      }
    };
    return attempt(&self, send);
  }

  /** Any other rank's: hear how the first rank's work ended, and receive a share of it. */
  static Outcome receive(vtkLocalHullSurfacer& self, int port, const Outputs& outputs)
  {
    const Outcome made = hearOutcome(self.Controller);
    if (made.end != Outcome::End::Done)
    {
      return made;
    }
    const auto receiveShares = [&](vtkSilhouetteExecution& execution)
    {
      forPorts(port, [&](int asked) { receiveShare(self.Controller, outputs[asked]); });
      storeEmpties(port, meshOutput(self), outputs);
      execution.progress(1.0);
    };
    return attempt(&self, receiveShares);
  }
};

vtkStandardNewMacro(vtkLocalHullSurfacer);
vtkCxxSetObjectMacro(vtkLocalHullSurfacer, Controller, vtkMultiProcessController);

vtkLocalHullSurfacer::vtkLocalHullSurfacer()
{
  vtkInternals::setDefaults(*this);
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkLocalHullSurfacer::~vtkLocalHullSurfacer()
{
  this->SetController(nullptr);
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

int vtkLocalHullSurfacer::ModifyRequest(vtkInformation* request, int when)
{
  const bool dataBefore =
      when == vtkExecutive::BeforeForward && request->Has(vtkDemandDrivenPipeline::REQUEST_DATA());
  if (dataBefore &&
      oneForEachRank(this->Controller,
                     requestedPiece(request, this->GetExecutive()->GetOutputInformation())) &&
      !updateInputsTogether(this, request, this->Controller))
  {
    return 0;
  }
  return this->Superclass::ModifyRequest(request, when);
}

int vtkLocalHullSurfacer::RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                                              vtkInformationVector* outputs)
{
  const silhouette::Piece piece = requestedPiece(request, outputs);
  if (isNothing(piece) || (oneForEachRank(this->Controller, piece) && piece.number > 0))
  {
    requestNothing(inputs, 3);
  }
  else
  {
    requestWhole(inputs, 3);
  }
  return 1;
}

int vtkLocalHullSurfacer::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                      vtkInformationVector* outputs)
{
  const silhouette::Piece piece = requestedPiece(request, outputs);
  if (isNothing(piece))
  {
    return 1;
  }
  const int port = requestedPort(request);
  if (!oneForEachRank(this->Controller, piece))
  {
    const auto makePiece = [&](vtkSilhouetteExecution& execution)
    {
      const Found found = vtkInternals::make(*this, inputs, port, execution);
      storePiece(found, piece, vtkInternals::meshOutput(*this), outputsOf(outputs));
      execution.progress(1.0);
    };
    return runFilter(this, outputs, makePiece, port);
  }
  const Outcome outcome = piece.number == 0
                              ? vtkInternals::makeForAll(*this, inputs, port, outputsOf(outputs))
                              : vtkInternals::receive(*this, port, outputsOf(outputs));
  return settle(this, outputs, outcome, port);
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
  os << indent << "ShiftNoise: " << this->ShiftNoise << "\n";
  os << indent << "Alignments: " << this->Alignments << "\n";
  os << indent << "ContourReach: " << this->ContourReach << "\n";
  os << indent << "RaiseWidth: " << this->RaiseWidth << "\n";
  os << indent << "ThinSmallestRadius: " << this->ThinSmallestRadius << "\n";
  os << indent << "ThinLargestRadius: " << this->ThinLargestRadius << "\n";
  os << indent << "ThinReach: " << this->ThinReach << "\n";
  os << indent << "SliceAxis: " << this->SliceAxis << "\n";
  os << indent << "SliceTolerance: " << this->SliceTolerance << "\n";
  os << indent << "ChainTolerance: " << this->ChainTolerance << "\n";
  os << indent << "ChainOverlap: " << this->ChainOverlap << "\n";
  os << indent << "GenerateNormals: " << (this->GenerateNormals ? "On" : "Off") << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
