// SPDX-License-Identifier: BSD-3-Clause
/**
 * A surface put together from those of the octree's pieces, so that no more than one piece's octree is held at a time.
 */
#pragma once

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;
class vtkHyperTreeGrid;
class vtkPolyData;

namespace silhouette::program
{

class PieceSurface
{
public:
  PieceSurface();
  ~PieceSurface();

  /** The next piece, in order. What is kept of it is its surface and its counts. */
  void add(vtkHyperTreeGrid* octree, vtkPolyData* surface);

  /** All pieces as one, points that coincide made one; the counts of its field data are the whole's. */
  vtkSmartPointer<vtkPolyData> join();

  /** A grid without octants that has the octree's field data, the counts being the whole's. */
  vtkHyperTreeGrid* octree() { return this->Octree; }

private:
  std::vector<vtkSmartPointer<vtkPolyData>> Surfaces;
  vtkNew<vtkHyperTreeGrid> Octree;
  vtkNew<vtkPolyData> Counts;
};

} // namespace silhouette::program
