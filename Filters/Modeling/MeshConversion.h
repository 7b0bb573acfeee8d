// SPDX-License-Identifier: BSD-3-Clause
/**
 * The core's triangle meshes against vtkPolyData. Private to the module.
 */
#pragma once

#include "Mesh.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace silhouette::modeling
{

struct MeshOutput
{
  int pointsPrecision = 1; ///< vtkAlgorithm::DesiredOutputPrecision; the default precision is double here
  bool normals = false;    ///< point normals, the area-weighted mean of the triangles' normals
};

/**
 * Give `out` the mesh's points and triangles, and normals where asked for; its field data stay. Whether single
 * precision is enough is the caller's question (requireSinglePrecision).
 */
void storeMesh(const Mesh& mesh, const MeshOutput& options, vtkPolyData* out);

/** Add the point array InsideVotes. */
void storeInsideVotes(const std::vector<std::array<std::uint16_t, 2>>& votes, vtkPolyData* out);

/** The triangles of `surface`. Throws InvalidInput, naming `what`, where a cell is not a triangle. */
Mesh meshOf(vtkPolyData* surface, const char* what);

} // namespace silhouette::modeling
