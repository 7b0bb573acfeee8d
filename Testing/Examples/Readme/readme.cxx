// SPDX-License-Identifier: BSD-3-Clause
/** Gives README's lines of C++ the views that they ask for, and prints how many triangles they make. */
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkLocalHullSurfacer.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkSilhouetteOctreeSource.h>
#include <vtkSyntheticCaptureSource.h>
#include <vtkVotingMarchingCubes.h>

#include <iostream>
#include <vector>

namespace
{

struct View
{
  vtkImageData* image;
  double matrix[12];
  const char* name;
};

std::vector<View> viewsOf(vtkPartitionedDataSetCollection* collection)
{
  std::vector<View> views;
  for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkDataSet* image = collection->GetPartitionedDataSet(i)->GetPartition(0);
    View view{vtkImageData::SafeDownCast(image), {}, nullptr};
    image->GetFieldData()->GetArray("Projection")->GetTuple(0, view.matrix);
    views.push_back(view);
  }
  return views;
}

} // namespace

int main()
{
  vtkNew<vtkSyntheticCaptureSource> capture;
  capture->SetNumberOfViews(12);
  capture->SetWidth(128);
  capture->SetHeight(128);
  capture->Update();
  const std::vector<View> views =
      viewsOf(vtkPartitionedDataSetCollection::SafeDownCast(capture->GetOutputDataObject(0)));
#include "readme.inc"
  std::cout << hulls->GetOutput()->GetNumberOfPolys() << " triangles\n";
  return 0;
}
