// SPDX-License-Identifier: BSD-3-Clause
/**
 * Reading PLY. VTK's reader of version 9.1 does not survive files that promise more than they hold, name points that there are not or lack what it looks
 * for, keeps coordinates in single precision alone, and counts a face's corners by a byte.
 */
#pragma once

#include "vtkSmartPointer.h"

#include <filesystem>

class vtkPolyData;

namespace silhouette::program
{

/**
 * Points (x, y, z of element vertex) in the file's own precision and faces (the list vertex_indices or vertex_index of element face) of a PLY file, text or binary
 * of either byte order; whatever else it holds is passed over. Throws ProgramError (FileFailed) with the file and what is wrong with it.
 */
vtkSmartPointer<vtkPolyData> readPly(const std::filesystem::path& file);

} // namespace silhouette::program
