// SPDX-License-Identifier: BSD-3-Clause
/**
 * Wavefront OBJ with all digits of its coordinates; positions and faces, nothing else.
 */
#pragma once

#include "vtkSmartPointer.h"

#include <filesystem>

class vtkPolyData;

namespace silhouette::program
{

/** Faces of any number of corners; throws ProgramError (FileFailed) that names file and line. */
vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& file);

/** Throws ProgramError (FileFailed). */
void writeObj(vtkPolyData* mesh, const std::filesystem::path& file);

} // namespace silhouette::program
