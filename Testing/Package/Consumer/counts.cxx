// SPDX-License-Identifier: BSD-3-Clause
/** The whole pipeline, from a synthetic capture to a closed surface; prints counts. */
#include <vtkLocalHullSurfacer.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSilhouetteOctreeSource.h>
#include <vtkSyntheticCaptureSource.h>
#include <vtkVotingMarchingCubes.h>

#include <iostream>

int main()
{
  vtkNew<vtkSyntheticCaptureSource> capture;
  capture->SetNumberOfViews(12);
  capture->SetWidth(160);
  capture->SetHeight(160);
  vtkNew<vtkSilhouetteOctreeSource> octree;
  octree->SetInputConnection(capture->GetOutputPort());
  octree->SetDepth(5);
  vtkNew<vtkVotingMarchingCubes> marching;
  marching->SetInputConnection(octree->GetOutputPort(0));
  marching->SetViewsConnection(octree->GetOutputPort(1));
  vtkNew<vtkLocalHullSurfacer> hulls;
  hulls->SetInputConnection(marching->GetOutputPort());
  hulls->SetOctreeConnection(octree->GetOutputPort(0));
  hulls->SetViewsConnection(octree->GetOutputPort(1));
  hulls->Update();
  vtkPolyData* surface = hulls->GetOutput();
  std::cout << "local hulls: " << surface->GetNumberOfPoints() << " points, " << surface->GetNumberOfPolys()
            << " triangles\n";
  return surface->GetNumberOfPolys() > 0 ? 0 : 1;
}
