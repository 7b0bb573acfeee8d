// SPDX-License-Identifier: BSD-3-Clause
/**
 * A folder of photographs in, a mesh and its picture out, by VTK's pipeline.
 *
 *   PhotographsToMesh CAPTURE MESH.ply PICTURE.png [DEPTH]
 *
 * CAPTURE holds photographs on a blue background and their cameras (`vtksilhouette synthesize jug` makes one).
 * The mesh is, byte for byte, that of
 *
 *   vtksilhouette reconstruct CAPTURE --carving strict --key blue:0.08 --largest-region -o MESH.ply
 */
#include "SilhouetteOffScreen.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLocalHullSurfacer.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSilhouetteCaptureReader.h>
#include <vtkSilhouetteExtractor.h>
#include <vtkSilhouetteOctreeSource.h>
#include <vtkVotingMarchingCubes.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>
#include <iostream>

namespace
{

/**
 * The mesh from where the first camera stood, upright as its photograph. `cameras` has five points a camera: its
 * centre and its image's corners, clockwise from the top left. Returns whether the file was written.
 */
bool writePicture(vtkPolyData* mesh, vtkPolyData* cameras, const char* fileName)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(mesh);
  normals->SplittingOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.86, 0.80, 0.72);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  double top[3], bottom[3];
  cameras->GetPoint(1, top);
  cameras->GetPoint(4, bottom);
  vtkCamera* view = renderer->GetActiveCamera();
  view->SetPosition(cameras->GetPoint(0));
  view->SetFocalPoint(mesh->GetCenter());
  view->SetViewUp(top[0] - bottom[0], top[1] - bottom[1], top[2] - bottom[2]);
  renderer->ResetCamera();

  vtkNew<vtkRenderWindow> window;
  window->SetSize(600, 600);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput(window);
  pixels->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> picture;
  picture->SetInputConnection(pixels->GetOutputPort());
  picture->SetFileName(fileName);
  picture->Write();
  return picture->GetErrorCode() == 0;
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 4 || argc > 5)
  {
    std::cerr << "usage: " << argv[0] << " CAPTURE MESH.ply PICTURE.png [DEPTH]\n";
    return 2;
  }
  silhouette::useOffScreenWindow();

  // The pipeline: each filter's output is the next one's input. Nothing runs before Update().
  vtkNew<vtkSilhouetteCaptureReader> reader;
  reader->SetFileName(argv[1]);
  reader->SetImageChoiceToPhotographs();

  vtkNew<vtkSilhouetteExtractor> extractor;
  extractor->SetInputConnection(reader->GetOutputPort());
  extractor->SetKeyChannelToBlue();
  extractor->LargestRegionOn();

  vtkNew<vtkSilhouetteOctreeSource> octree;
  octree->SetInputConnection(extractor->GetOutputPort());
  octree->SetDepth(argc == 5 ? std::atoi(argv[4]) : 8);

  vtkNew<vtkVotingMarchingCubes> cubes;
  cubes->SetInputConnection(octree->GetOutputPort(0));
  cubes->SetViewsConnection(octree->GetOutputPort(1));

  vtkNew<vtkLocalHullSurfacer> hulls;
  hulls->SetInputConnection(cubes->GetOutputPort());
  hulls->SetOctreeConnection(octree->GetOutputPort(0));
  hulls->SetViewsConnection(octree->GetOutputPort(1));
  hulls->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION); // what a PLY file keeps: sound as stored

  hulls->Update();
  vtkPolyData* mesh = hulls->GetOutput();
  if (mesh->GetNumberOfPolys() == 0)
  {
    std::cerr << argv[1] << ": no mesh; VTK's messages above say why\n";
    return 1;
  }
  std::cout << mesh->GetNumberOfPoints() << " points, " << mesh->GetNumberOfPolys() << " triangles\n";

  vtkNew<vtkPLYWriter> writer;
  writer->SetInputConnection(hulls->GetOutputPort());
  writer->SetFileName(argv[2]);
  writer->Write();
  if (writer->GetErrorCode() != 0 || !writePicture(mesh, reader->GetCamerasOutput(), argv[3]))
  {
    std::cerr << "not all could be written; VTK's messages above say why\n";
    return 1;
  }
  return 0;
}
