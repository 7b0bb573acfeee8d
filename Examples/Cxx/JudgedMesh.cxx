// SPDX-License-Identifier: BSD-3-Clause
/**
 * A capture in, a judged mesh out: errors as exceptions, a time limit, threads, and the metrics read.
 *
 *   JudgedMesh CAPTURE MESH.vtp [DEPTH [THREADS [SECONDS]]]
 *
 * CAPTURE holds masks, or images that are silhouettes already, and their cameras. The mesh is that of
 * `vtksilhouette reconstruct CAPTURE -o MESH.vtp`, triangle for triangle. Exit code 0: it is sound, and written.
 */
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkHyperTreeGrid.h>
#include <vtkLocalHullSurfacer.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSilhouetteCaptureReader.h>
#include <vtkSilhouetteEvaluator.h>
#include <vtkSilhouetteExtractor.h>
#include <vtkSilhouetteOctreeSource.h>
#include <vtkTable.h>
#include <vtkVariant.h>
#include <vtkVotingMarchingCubes.h>
#include <vtkXMLPolyDataWriter.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

namespace
{

/** Runs filters; their errors become exceptions, and so does the end of the time. */
class Watch : public vtkCommand
{
public:
  static Watch* New() { return new Watch; }

  void SetSeconds(double seconds) { this->Seconds = seconds; }

  /**
   * Updates one filter that was not run before; what is upstream should have been, so that the first error is the
   * cause and not a consequence.
   */
  void Run(vtkAlgorithm* algorithm)
  {
    algorithm->AddObserver(vtkCommand::ProgressEvent, this);
    algorithm->AddObserver(vtkCommand::ErrorEvent, this);
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this); // it repeats that there was one
    algorithm->Update();
    if (!this->Error.empty())
    {
      throw std::runtime_error(this->Error);
    }
    if (algorithm->GetAbortExecute())
    {
      throw std::runtime_error("the time was up in " + std::string(algorithm->GetClassName()));
    }
  }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    if (event == vtkCommand::ErrorEvent && this->Error.empty())
    {
      const std::string text = static_cast<const char*>(data);
      this->Error = text.substr(text.find('\n') + 1); // without the line that names VTK's source file
      this->Error.erase(this->Error.find_last_not_of('\n') + 1);
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - this->Start;
    if (event == vtkCommand::ProgressEvent && passed.count() > this->Seconds)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  double Seconds = 3600.0;
  std::string Error;
};

/** A value of a data object's field data. */
double value(vtkDataObject* data, const char* name)
{
  return data->GetFieldData()->GetArray(name)->GetTuple1(0);
}

/** The views in the order of the capture, and what the mesh is as a whole. */
void report(vtkTable* table)
{
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    std::cout << table->GetValueByName(row, "Name").ToString() << ": IoU "
              << table->GetValueByName(row, "IoU").ToDouble() << ", XOR "
              << 100.0 * table->GetValueByName(row, "XOR").ToDouble() << " %\n";
  }
  std::cout << "mean IoU " << value(table, "MeanIoU") << ", volume " << value(table, "Volume") << ", "
            << value(table, "Components") << " component(s), " << value(table, "LostSurface")
            << " octants lost\n";
}

/** Returns whether the mesh is sound, and written. */
bool reconstruct(const char* capture, const char* mesh, int depth, Watch* watch)
{
  vtkNew<vtkSilhouetteCaptureReader> reader;
  reader->SetFileName(capture);
  reader->ReleaseDataFlagOn(); // images are given up as soon as the silhouettes are made
  vtkNew<vtkSilhouetteExtractor> extractor;
  extractor->SetInputConnection(reader->GetOutputPort());
  watch->Run(reader);
  watch->Run(extractor);

  vtkNew<vtkSilhouetteOctreeSource> octree;
  octree->SetInputConnection(extractor->GetOutputPort());
  octree->SetDepth(depth);
  octree->AutomaticToleranceOn(); // forgives wrong silhouettes where they would cut the object
  watch->Run(octree);
  const double views = value(octree->GetOutput(), "NumberOfViews");
  const double votes = value(octree->GetOutput(), "BackgroundVotes");

  vtkNew<vtkVotingMarchingCubes> cubes;
  cubes->SetInputConnection(octree->GetOutputPort(0));
  cubes->SetViewsConnection(octree->GetOutputPort(1));
  cubes->SetShare((views - votes) / views); // as many views as the octree has asked
  watch->Run(cubes);

  vtkNew<vtkLocalHullSurfacer> hulls;
  hulls->SetInputConnection(cubes->GetOutputPort());
  hulls->SetOctreeConnection(octree->GetOutputPort(0));
  hulls->SetViewsConnection(octree->GetOutputPort(1));
  watch->Run(hulls);

  vtkNew<vtkSilhouetteEvaluator> evaluator;
  evaluator->SetInputConnection(hulls->GetOutputPort());
  evaluator->SetViewsConnection(
      extractor->GetOutputPort()); // as extracted, not as the octree may dilate them
  evaluator->SetOctreeConnection(octree->GetOutputPort(0));
  watch->Run(evaluator);
  report(evaluator->GetOutput());

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(hulls->GetOutputPort());
  writer->SetFileName(mesh);
  return value(evaluator->GetOutput(), "Sound") == 1.0 && writer->Write() == 1;
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 3 || argc > 6)
  {
    std::cerr << "usage: " << argv[0] << " CAPTURE MESH.vtp [DEPTH [THREADS [SECONDS]]]\n";
    return 2;
  }
  // 0: as many threads as there are processors. The mesh is the same, byte for byte, for any number.
  vtkSMPTools::Initialize(argc > 4 ? std::atoi(argv[4]) : 0);
  vtkNew<Watch> watch;
  watch->SetSeconds(argc > 5 ? std::atof(argv[5]) : 3600.0);
  try
  {
    if (!reconstruct(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 8, watch))
    {
      std::cerr << "the mesh is not sound, or could not be written\n";
      return 1;
    }
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
