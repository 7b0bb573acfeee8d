// SPDX-License-Identifier: BSD-3-Clause
#include "Evaluate.h"

#include "Arguments.h"
#include "ExitCodes.h"
#include "MeshFiles.h"
#include "Metrics.h"
#include "OutputChecks.h"
#include "OutputFiles.h"
#include "Stages.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSilhouetteCaptureReader.h"
#include "vtkSilhouetteEvaluator.h"
#include "vtkSilhouetteExtractor.h"
#include "vtkTable.h"

#include <cstdio>
#include <limits>

namespace silhouette::program
{
namespace
{

const char* const Description =
  "How good is a mesh: is it sound, does it explain the silhouettes, how far is it from the truth?\n\n"
  "Counts open and non-manifold edges, self-intersections, components and genus; renders the mesh in each view and\n"
  "compares that with the silhouette; measures the distance to a true mesh both ways.";

std::string footer()
{
  return std::string("Points of an STL file that are exactly equal count as one. Distances, areas and volumes are in the "
                     "unit of the cameras.\n\n"
                     "Example:\n"
                     "  vtksilhouette evaluate jug.ply --capture jug --truth jug/truth.ply --metrics quality.json\n\n") +
    ExitCodesHelp;
}

std::string viewLines(const Metrics& metrics)
{
  std::string text = "     IoU    XOR %  false object  false background  view\n";
  for (const Metrics& view : metrics["per_view"])
  {
    char line[128];
    std::snprintf(line, sizeof line, "  %6.4f  %7.3f  %12llu  %16llu  ",
      view["iou"].is_null() ? 0.0 : view["iou"].get<double>(),
      view["xor"].is_null() ? 100.0 : 100.0 * view["xor"].get<double>(),
      view["false_object"].get<unsigned long long>(), view["false_background"].get<unsigned long long>());
    text += line + view["name"].get<std::string>() + "\n";
  }
  return text;
}

} // namespace

Evaluate::Evaluate(CLI::App& program)
{
  this->App = addCommand(program, "evaluate", Description);
  this->App->add_option("MESH", this->Mesh, "The mesh: .vtp, .ply, .stl or .obj")->required();
  this->App
    ->add_option("--capture", this->Capture, "The capture, as for reconstruct; give the options for its silhouettes "
                                             "that the mesh was made with")
    ->type_name("CAPTURE")
    ->required()
    ->group("Capture");
  this->Silhouettes.addTo(*this->App);
  this->App->add_option("--truth", this->Truth, "The true mesh: .vtp, .ply, .stl or .obj")
    ->type_name("MESH")
    ->group("Run");
  this->App
    ->add_option("--sample-spacing", this->SampleSpacing, "Distance between the samples of the comparison with the "
                                                          "truth (default: a 512th of the truth's longest side). Larger "
                                                          "is faster and coarser")
    ->type_name("LENGTH")
    ->check(aboveZero(std::numeric_limits<double>::max()))
    ->group("Run");
  this->App->add_option("--metrics", this->MetricsFile, "All that was found, one JSON object")
    ->type_name("FILE.json")
    ->group("Run");
  this->App->add_option("--threads", this->Threads, "Threads to use (default: 0, all processors)")
    ->type_name("N")
    ->check(inRange(0, 4096, true))
    ->group("Run");
  this->App->add_flag("-q,--quiet", this->Quiet, "No progress bar and no report")->group("Run");
  this->App->footer(footer());
}

void Evaluate::finish()
{
  this->Silhouettes.finish();
  if (this->SampleSpacing > 0.0 && this->Truth.empty())
  {
    throw CLI::ValidationError("--sample-spacing", "is for the comparison with --truth");
  }
  checkExtension("--metrics", this->MetricsFile, ".json");
}

void Evaluate::run()
{
  if (this->Threads > 0)
  {
    vtkSMPTools::Initialize(this->Threads);
  }
  checkOutputs({ this->MetricsFile }, this->Capture, { this->Mesh, this->Truth });
  Stages stages(this->Quiet);
  vtkNew<vtkSilhouetteCaptureReader> reader;
  vtkNew<vtkSilhouetteExtractor> extractor;
  vtkNew<vtkSilhouetteEvaluator> evaluator;
  this->Silhouettes.configure(this->Capture, reader);
  this->Silhouettes.configure(extractor);
  extractor->SetInputConnection(reader->GetOutputPort());
  evaluator->SetViewsConnection(extractor->GetOutputPort());
  evaluator->SetSampleSpacing(this->SampleSpacing);
  stages.run("read", "reading the meshes",
    [&]
    {
      evaluator->SetInputData(readMesh(this->Mesh));
      if (!this->Truth.empty())
      {
        evaluator->SetTruthData(readMesh(this->Truth));
      }
    });
  stages.run(reader, "read", "reading the capture", FileFailed);
  stages.run(extractor, "silhouettes", "finding the silhouettes");
  stages.run(evaluator, "evaluate", "judging the mesh");

  Metrics metrics;
  metrics["program"] = "vtksilhouette evaluate";
  metrics["capture"] = this->Capture;
  metrics["mesh"] = this->Mesh;
  metrics["views"] = fieldCount(evaluator->GetOutput(), "Views");
  addMesh(metrics, evaluator->GetOutput());
  addAgreement(metrics, evaluator->GetOutput());
  addTruth(metrics, evaluator->GetOutput());
  addCost(metrics, stages.seconds());
  if (!this->MetricsFile.empty())
  {
    StagedFile file(this->MetricsFile);
    writeMetrics(metrics, file);
    file.commit();
  }
  if (!this->Quiet)
  {
    const std::string text = describeMesh(metrics) + describeAgreement(metrics) + viewLines(metrics) +
      describeTruth(metrics) + describeCost(metrics);
    std::fputs(text.c_str(), stdout);
  }
}

} // namespace silhouette::program
