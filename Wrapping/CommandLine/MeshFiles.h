// SPDX-License-Identifier: BSD-3-Clause
/**
 * Meshes to and from files, by their extension: vtp, ply, stl, obj.
 *
 * | format | coordinates | written by | reading |
 * | --- | --- | --- | --- |
 * | vtp | double | VTK | |
 * | ply | float, binary | VTK | |
 * | stl | float, binary | VTK | points of exactly equal coordinates become one |
 * | obj | double, 17 digits | us: VTK's writer keeps six digits, its reader floats | positions and faces alone |
 */
#pragma once

#include "vtkSmartPointer.h"

#include <filesystem>
#include <string>

class vtkPolyData;

namespace silhouette::program
{

/** "vtp, ply, stl or obj", for messages. */
constexpr const char* MeshFormats = "vtp, ply, stl or obj";

/** Whether the extension is one of MeshFormats, in upper or lower case. */
bool isMeshFile(const std::filesystem::path& file);

/** Whether the file's format keeps only single precision. */
bool keepsSinglePrecision(const std::filesystem::path& file);

/** Triangles only. Throws ProgramError (FileFailed) that names the file. */
vtkSmartPointer<vtkPolyData> readMesh(const std::filesystem::path& file);

/** Writes right away, in the format of the file's extension. Throws ProgramError (FileFailed). */
void writeMesh(vtkPolyData* mesh, const std::filesystem::path& file);

} // namespace silhouette::program
