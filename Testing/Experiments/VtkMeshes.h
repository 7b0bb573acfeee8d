// SPDX-License-Identifier: BSD-3-Clause
/**
 * The core's meshes as VTK's data sets, and back.
 */
#pragma once

#include "Mesh.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace silhouette::experiments
{

/** Points alone. */
vtkSmartPointer<vtkPolyData> pointSet(const std::vector<Eigen::Vector3d>& points);

vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh);

/** The triangles of a data set; other cells are left out. */
Mesh meshOf(vtkPolyData* surface);

/** The mesh, turned inside out if its volume is negative. */
Mesh outwards(Mesh mesh);

} // namespace silhouette::experiments
