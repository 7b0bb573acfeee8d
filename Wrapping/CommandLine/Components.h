// SPDX-License-Identifier: BSD-3-Clause
/**
 * The pieces of a mesh: triangles that hang together by shared points.
 */
#pragma once

#include "vtkSmartPointer.h"
#include "vtkType.h"

class vtkPolyData;

namespace silhouette::program
{

vtkIdType countComponents(vtkPolyData* triangles);

/**
 * The component that encloses the largest volume, with the points that it uses; points and triangles keep their order
 * and the points their precision. Of two equal ones the first. What noise leaves may have more area than the object.
 */
vtkSmartPointer<vtkPolyData> largestComponent(vtkPolyData* triangles);

} // namespace silhouette::program
