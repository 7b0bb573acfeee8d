// SPDX-License-Identifier: BSD-3-Clause
/**
 * The pipeline of `vtksilhouette reconstruct`, run stage by stage.
 */
#pragma once

#include "Metrics.h"
#include "PieceSurface.h"
#include "Stages.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

class vtkHyperTreeGrid;
class vtkLocalHullSurfacer;
class vtkPolyData;
class vtkSilhouetteCaptureReader;
class vtkSilhouetteEvaluator;
class vtkSilhouetteExtractor;
class vtkSilhouetteOctreeSource;
class vtkVotingMarchingCubes;

namespace silhouette::program
{

struct ReconstructOptions;
class StagedFile;
class StagedFiles;

class Reconstruction
{
public:
  explicit Reconstruction(const ReconstructOptions& options);
  ~Reconstruction();
  Reconstruction(const Reconstruction&) = delete;
  Reconstruction& operator=(const Reconstruction&) = delete;

  /** Throws what Command::run() does; files that are finished by then stay, and are whole. */
  void run();

private:
  void checkOutputs() const;
  void readCapture();
  void connect();
  /** Throws CLI::ValidationError where votes and share do not fit the number of views. */
  void setVotes();
  void carve();
  /** Is the carving's tolerance to be found? */
  bool carvesTolerantly() const;
  /** The share that the octree's background votes leave, where its tolerance was found. */
  void takeTolerance();
  void setShare(int views, int backgroundVotes);
  void setLocalHulls();
  std::string describeCarving() const;
  void makeSurface();
  /** Octree and surface piece after piece. */
  void makePieces();
  /** The octree's field data; in pieces those of the whole. */
  vtkHyperTreeGrid* octreeFields();
  vtkPolyData* cubes();
  /** The mesh as the staged file has it. */
  vtkSmartPointer<vtkPolyData> store(vtkPolyData* mesh, const StagedFile& file);
  /** Does anybody ask what the mesh is like? */
  bool isJudged() const;
  void evaluate(vtkPolyData* stored);
  void gatherMetrics(vtkPolyData* stored);
  void writeOctree(StagedFiles& files);
  void writeImage(vtkPolyData* stored, StagedFiles& files);
  void summarise() const;

  const ReconstructOptions& Options;
  Stages Run;
  Metrics Found;
  double Share = 1.0;
  PieceSurface Pieces;
  vtkSmartPointer<vtkPolyData> Truth;
  vtkSmartPointer<vtkPolyData> Surface; ///< whole
  vtkSmartPointer<vtkPolyData> Kept;    ///< what is left of it with --largest
  vtkNew<vtkSilhouetteCaptureReader> Reader;
  vtkNew<vtkSilhouetteExtractor> Extractor;
  vtkNew<vtkSilhouetteOctreeSource> Octree;
  vtkNew<vtkVotingMarchingCubes> Cubes;
  vtkNew<vtkLocalHullSurfacer> Hulls;
  vtkNew<vtkSilhouetteEvaluator> Evaluator;
};

} // namespace silhouette::program
