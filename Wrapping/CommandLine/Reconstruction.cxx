// SPDX-License-Identifier: BSD-3-Clause
#include "Reconstruction.h"

#include "Arguments.h"
#include "Components.h"
#include "MeshFiles.h"
#include "OutputChecks.h"
#include "OutputFiles.h"
#include "ParameterRange.h"
#include "Preview.h"
#include "Reconstruct.h"
#include "VotingMarchingCubes.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkLocalHullSurfacer.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSilhouetteCaptureReader.h"
#include "vtkSilhouetteEvaluator.h"
#include "vtkSilhouetteExtractor.h"
#include "vtkSilhouetteOctreeSource.h"
#include "vtkTable.h"
#include "vtkVotingMarchingCubes.h"
#include "vtkXMLHyperTreeGridWriter.h"

#include <algorithm>
#include <cstdio>

namespace silhouette::program
{

Reconstruction::Reconstruction(const ReconstructOptions& options)
  : Options(options)
  , Run(options.quiet)
{
}

Reconstruction::~Reconstruction() = default;

void Reconstruction::run()
{
  if (this->Options.threads > 0)
  {
    vtkSMPTools::Initialize(this->Options.threads);
  }
  this->checkOutputs();
  if (!this->Options.truth.empty())
  {
    this->Run.run("read", "reading the truth", [this] { this->Truth = readMesh(this->Options.truth); });
  }
  this->connect();
  this->readCapture();
  this->setVotes();
  this->setLocalHulls();
  this->carve();
  this->makeSurface();

  StagedFiles files;
  const vtkSmartPointer<vtkPolyData> stored = this->store(this->Kept, files.add(this->Options.mesh));
  this->writeOctree(files);
  this->writeImage(stored, files);
  if (this->isJudged())
  {
    this->evaluate(stored);
    this->gatherMetrics(stored);
  }
  if (!this->Options.metrics.empty())
  {
    writeMetrics(this->Found, files.add(this->Options.metrics));
  }
  files.commit();
  if (!this->Options.quiet)
  {
    this->summarise();
  }
}

bool Reconstruction::isJudged() const
{
  return !this->Options.quiet || !this->Options.metrics.empty() || !this->Options.truth.empty();
}

void Reconstruction::checkOutputs() const
{
  const ReconstructOptions& options = this->Options;
  program::checkOutputs({ options.mesh, options.metrics, options.image, options.octree }, options.capture, { options.truth });
  if (!this->Options.image.empty())
  {
    checkPreview();
  }
}

void Reconstruction::connect()
{
  this->Extractor->SetInputConnection(this->Reader->GetOutputPort());
  this->Octree->SetInputConnection(this->Extractor->GetOutputPort());
  this->Cubes->SetInputConnection(this->Octree->GetOutputPort(0));
  this->Cubes->SetViewsConnection(this->Octree->GetOutputPort(1));
  this->Hulls->SetInputConnection(this->Cubes->GetOutputPort());
  this->Hulls->SetOctreeConnection(this->Octree->GetOutputPort(0));
  this->Hulls->SetViewsConnection(this->Octree->GetOutputPort(1));
  this->Evaluator->SetViewsConnection(this->Extractor->GetOutputPort());
  if (this->Options.pieces == 1)
  {
    this->Evaluator->SetOctreeConnection(this->Octree->GetOutputPort(0));
  }

  // The promises are kept for the coordinates that the file will hold.
  const int precision =
    keepsSinglePrecision(this->Options.mesh) ? vtkAlgorithm::SINGLE_PRECISION : vtkAlgorithm::DOUBLE_PRECISION;
  this->Hulls->SetOutputPointsPrecision(precision);
  if (this->Options.surface != "local-hull")
  {
    this->Cubes->SetOutputPointsPrecision(precision);
  }
}

void Reconstruction::readCapture()
{
  this->Options.silhouettes.configure(this->Options.capture, this->Reader);
  this->Options.silhouettes.configure(this->Extractor);
  this->Run.run(this->Reader, "read", "reading the capture", FileFailed);
  this->Run.run(this->Extractor, "silhouettes", "finding the silhouettes");
}

void Reconstruction::setVotes()
{
  const bool consistent = this->Options.votes == "consistent";
  const int views = static_cast<int>(this->Extractor->GetOutput()->GetNumberOfPartitionedDataSets());
  this->Share = this->Options.voteShare.value_or(1.0);
  const int left = views - requiredInsideVotes(this->Share, views);
  const int background = this->Options.backgroundVotes.value_or(consistent ? left : 0);
  if (background >= views)
  {
    throw CLI::ValidationError("--background-votes", std::to_string(background) + " of " + std::to_string(views) +
        " views is out of range: 0 to " + std::to_string(views - 1));
  }
  if (this->Options.voteShare && consistent && background != left)
  {
    throw CLI::ValidationError("--background-votes", std::to_string(background) + " contradicts --vote-share " +
        numberText(this->Share) + ", which leaves " + std::to_string(left) + " of " + std::to_string(views) +
        " views; one of the two is enough");
  }
  if (!this->Options.voteShare && consistent)
  {
    this->setShare(views, background);
  }
  this->Octree->SetBackgroundVotes(background);
  this->Cubes->SetShare(this->Share);
  this->Cubes->SetMode(consistent ? vtkVotingMarchingCubes::CONSISTENT : vtkVotingMarchingCubes::FAITHFUL);
  this->Cubes->SetEdgePlacement(this->Options.edges == "exact" ? vtkVotingMarchingCubes::EXACT
      : this->Options.edges == "sub-pixel"                     ? vtkVotingMarchingCubes::SUB_PIXEL
                                                               : vtkVotingMarchingCubes::MIDDLE);
}

bool Reconstruction::carvesTolerantly() const
{
  return this->Options.carving == "tolerant" && this->Options.carvingSettledBy().empty();
}

void Reconstruction::setShare(int views, int backgroundVotes)
{
  if (backgroundVotes > 0 && backgroundVotes < views)
  {
    this->Share = double(views - backgroundVotes) / views;
    this->Cubes->SetShare(this->Share);
  }
}

void Reconstruction::setLocalHulls()
{
  const ReconstructOptions& options = this->Options;
  this->Hulls->SetMode(
    options.mode == "thesis" ? vtkLocalHullSurfacer::THESIS : vtkLocalHullSurfacer::ROBUST);
  this->Hulls->SetIslandShare(options.islandShare);
  this->Hulls->SetRepairSilhouettes(options.repair);
  this->Hulls->SetAlignViews(options.alignment);
  this->Hulls->SetCorrectField(options.correction);
  this->Hulls->SetThinHulls(options.thinHulls);
  this->Hulls->SetJoinHandles(options.handles);
  this->Hulls->SetFillTunnels(options.tunnels);
}

void Reconstruction::carve()
{
  if (this->Options.depth)
  {
    this->Octree->SetDepth(*this->Options.depth);
  }
  if (this->Options.leafEdge)
  {
    this->Octree->SetLeafEdge(*this->Options.leafEdge);
  }
  if (this->Options.bounds)
  {
    this->Octree->AutomaticBoundsOff();
    this->Octree->SetBounds(this->Options.bounds->data());
  }
  this->Octree->SetOutsidePolicy(indexOf(this->Options.outside, { "border", "unknown", "background" }));
  this->Octree->SetAutomaticTolerance(this->carvesTolerantly());
  if (this->Options.pieces > 1)
  {
    return; // with the surface, piece after piece
  }
  this->Run.run(this->Octree, "carve", "carving the octree");
  this->takeTolerance();
}

void Reconstruction::takeTolerance()
{
  if (this->carvesTolerantly())
  {
    vtkHyperTreeGrid* octree = this->Octree->GetOutput();
    this->setShare(static_cast<int>(fieldCount(octree, "NumberOfViews")),
      static_cast<int>(fieldCount(octree, "BackgroundVotes")));
  }
}

void Reconstruction::makePieces()
{
  const int pieces = this->Options.pieces;
  for (int piece = 0; piece < pieces; ++piece)
  {
    const std::string which = ", piece " + std::to_string(piece + 1) + " of " + std::to_string(pieces);
    this->Run.run(this->Octree, "carve", "carving the octree" + which, ProcessingFailed, piece, pieces);
    this->takeTolerance();
    this->Run.run(this->Cubes, "marching_cubes", "marching cubes" + which, ProcessingFailed, piece, pieces);
    this->Pieces.add(this->Octree->GetOutput(), this->Cubes->GetOutput());
  }
  this->Run.run("marching_cubes", "joining the pieces", [this] { this->Surface = this->Pieces.join(); });
}

vtkHyperTreeGrid* Reconstruction::octreeFields()
{
  return this->Options.pieces > 1 ? this->Pieces.octree() : this->Octree->GetOutput();
}

vtkPolyData* Reconstruction::cubes()
{
  return this->Options.pieces > 1 ? this->Surface.GetPointer() : this->Cubes->GetOutput();
}

void Reconstruction::makeSurface()
{
  if (this->Options.pieces > 1)
  {
    this->makePieces();
  }
  else
  {
    this->Run.run(this->Cubes, "marching_cubes", "marching cubes");
    this->Surface = this->Cubes->GetOutput();
  }
  if (this->Options.surface == "local-hull")
  {
    this->Run.run(this->Hulls, "local_hulls", "local hulls");
    this->Surface = this->Hulls->GetOutput();
  }
  if (this->Surface->GetNumberOfPolys() == 0)
  {
    throw ProgramError(ProcessingFailed,
      "the surface is empty: no octant holds a corner that enough views call inside; --surface local-hull keeps thin "
      "parts, a larger --depth or a smaller --vote-share may help");
  }
  this->Kept = this->Surface;
  if (this->Options.largest)
  {
    this->Run.run("largest", "the largest component", [this] { this->Kept = largestComponent(this->Surface); });
  }
}

vtkSmartPointer<vtkPolyData> Reconstruction::store(vtkPolyData* mesh, const StagedFile& file)
{
  // What is judged is what was stored: read again, which also finds files that were cut short.
  vtkSmartPointer<vtkPolyData> stored;
  this->Run.run("write", "writing the mesh",
    [&]
    {
      vtkNew<vtkPolyData> bare; // no formats' extras, nor field data
      bare->SetPoints(mesh->GetPoints());
      bare->SetPolys(mesh->GetPolys());
      writeMesh(bare, file.path());
      stored = readMesh(file.path());
    });
  if (stored->GetNumberOfPolys() != mesh->GetNumberOfPolys())
  {
    throw ProgramError(FileFailed, "cannot write mesh " + file.target().string() + ": it reads as " +
        std::to_string(stored->GetNumberOfPolys()) + " triangles of " + std::to_string(mesh->GetNumberOfPolys()));
  }
  return stored;
}

void Reconstruction::evaluate(vtkPolyData* stored)
{
  std::uint64_t lost = 0;
  const bool dropped = this->Kept->GetNumberOfPolys() < this->Surface->GetNumberOfPolys();
  const bool hasOctree = this->Options.pieces == 1; // the whole one, to judge against
  if (dropped && hasOctree)
  {
    this->Evaluator->SetInputData(this->Surface);
    this->Run.run(this->Evaluator, "evaluate", "judging the whole surface");
    lost = fieldCount(this->Evaluator->GetOutput(), "LostSurface");
  }
  if (this->Truth)
  {
    this->Evaluator->SetTruthData(this->Truth);
    this->Evaluator->SetSampleSpacing(leafEdge(this->octreeFields())); // its own default, but pieces leave it no octree
  }
  if (vtkDataArray* given = this->Surface->GetFieldData()->GetArray("DroppedLeaves"))
  {
    stored->GetFieldData()->AddArray(given); // what is given up is dropped, not lost
  }
  this->Evaluator->SetInputData(stored);
  this->Run.run(this->Evaluator, "evaluate", "judging the mesh");
  const std::uint64_t lostNow = fieldCount(this->Evaluator->GetOutput(), "LostSurface");
  this->Found["lost_surface"] = hasOctree ? Metrics(dropped ? lost : lostNow) : Metrics();
  this->Found["dropped_octants"] = hasOctree || !dropped
    ? Metrics(fieldCount(this->Surface, "DroppedOctants") + (dropped ? lostNow - std::min(lost, lostNow) : 0)) // islands and debris, and the other components
    : Metrics();
}

void Reconstruction::gatherMetrics(vtkPolyData* stored)
{
  const Metrics lostSurface = this->Found["lost_surface"], droppedOctants = this->Found["dropped_octants"];
  vtkPolyData* cubes = this->cubes();
  Metrics metrics;
  metrics["program"] = "vtksilhouette reconstruct";
  metrics["capture"] = this->Options.capture;
  metrics["mesh"] = this->Options.mesh;
  metrics["surface"] = this->Options.surface;
  metrics["votes"] = this->Options.votes;
  metrics["vote_share"] = this->Share;
  metrics["edges"] = this->Options.edges;
  metrics["carving"] = this->carvesTolerantly() ? "tolerant" : "strict";
  addOctree(metrics, this->octreeFields(), this->Octree->GetViewsOutput());
  metrics["lost_no_corner"] = fieldCount(cubes, "LostNoCorner");
  metrics["lost_all_corners"] = fieldCount(cubes, "LostAllCorners");
  metrics["lost_surface"] = lostSurface;
  metrics["dropped_octants"] = droppedOctants;
  metrics["cavities_filled"] = fieldCount(this->Surface, "CavitiesFilled");
  metrics["marching_cubes_points"] = cubes->GetNumberOfPoints();
  metrics["marching_cubes_triangles"] = cubes->GetNumberOfPolys();
  metrics["marching_cubes_components"] = countComponents(cubes);
  if (this->Options.surface == "local-hull")
  {
    metrics["survivors"] = fieldCount(this->Surface, "Survivors");
    metrics["covered_octants"] = fieldCount(this->Surface, "CoveredOctants");
    metrics["mode"] = this->Options.mode;
    metrics["island_share"] = this->Options.islandShare;
    metrics["deficit"] = fieldValue(this->Surface, "Deficit");
    metrics["shift"] = fieldValue(this->Surface, "Shift");
    metrics["alignment"] = fieldValue(this->Surface, "Alignment");
    metrics["repaired_pixels"] = fieldCount(this->Surface, "RepairedPixels");
  }
  addMesh(metrics, this->Evaluator->GetOutput());
  double bounds[6];
  stored->GetBounds(bounds);
  metrics["bounds"] = bounds;
  addAgreement(metrics, this->Evaluator->GetOutput());
  addTruth(metrics, this->Evaluator->GetOutput());
  addCost(metrics, this->Run.seconds());
  this->Found = metrics;
}

void Reconstruction::writeOctree(StagedFiles& files)
{
  if (this->Options.octree.empty())
  {
    return;
  }
  const StagedFile& file = files.add(this->Options.octree);
  vtkNew<vtkXMLHyperTreeGridWriter> writer;
  writer->SetInputData(this->Octree->GetOutput());
  writer->SetFileName(file.path().c_str());
  writer->SetDataModeToBinary(); // appended data are not read again
  this->Run.run(writer, "write", "writing the octree", FileFailed);
  if (writer->GetErrorCode() != 0)
  {
    throw ProgramError(FileFailed, "cannot write octree " + this->Options.octree + "; is the disk full?");
  }
}

void Reconstruction::writeImage(vtkPolyData* stored, StagedFiles& files)
{
  if (this->Options.image.empty())
  {
    return;
  }
  const StagedFile& file = files.add(this->Options.image);
  this->Run.run("image", "rendering the preview",
    [&] { renderPreview(stored, this->Extractor->GetOutput(), file.path()); });
}

std::string Reconstruction::describeCarving() const
{
  if (this->Found["uncovered_share"].is_null())
  {
    return {};
  }
  const int votes = this->Found["background_votes"].get<int>();
  const int dilation = this->Found["dilation"].get<int>();
  const double strict = 100.0 * this->Found["strict_uncovered_share"].get<double>();
  const double share = 100.0 * this->Found["uncovered_share"].get<double>();
  char text[200];
  if (votes == 0 && dilation == 0)
  {
    std::snprintf(
      text, sizeof text, "carving      strict: it loses parts with %.2f %% of the silhouettes\n", share);
    return text;
  }
  std::snprintf(text, sizeof text,
    "carving      tolerant, as strict carving loses parts with %.2f %% of the silhouettes, this %.2f %%: background "
    "votes %d, dilation %d px\n",
    strict, share, votes, dilation);
  return text;
}

void Reconstruction::summarise() const
{
  std::string text = "wrote        " + this->Options.mesh;
  for (const std::string& file : { this->Options.metrics, this->Options.image, this->Options.octree })
  {
    text += file.empty() ? "" : ", " + file;
  }
  char octree[200];
  std::snprintf(octree, sizeof octree,
    "\noctree       depth %d, leaf edge %.4g; %llu inside, %llu on the surface", this->Found["depth"].get<int>(),
    this->Found["leaf_edge"].get<double>(), this->Found["inside"].get<unsigned long long>(),
    this->Found["intersection"].get<unsigned long long>());
  const Metrics& lost = this->Found["lost_surface"];
  text += octree + (lost.is_null() ? "\n" : "; " + std::to_string(lost.get<std::uint64_t>()) + " lost by the mesh\n");
  text += this->describeCarving() + describeMesh(this->Found) + describeAgreement(this->Found) + describeTruth(this->Found) +
    describeCost(this->Found);
  std::fputs(text.c_str(), stdout);
}

} // namespace silhouette::program
