// SPDX-License-Identifier: BSD-3-Clause
/**
 * A picture of a mesh, rendered in memory: three-quarter view from a little above, the object upright as the
 * capture's cameras see it.
 */
#pragma once

#include <filesystem>

class vtkPartitionedDataSetCollection;
class vtkPolyData;

namespace silhouette::program
{

/** Throws ProgramError (ProcessingFailed) where this build or machine renders nothing without a display. */
void checkPreview();

/**
 * Render `mesh` to a PNG file, right away. Up is the mean of the views' upward image directions. Throws
 * ProgramError: ProcessingFailed where nothing can be rendered, FileFailed where it cannot be written.
 */
void renderPreview(vtkPolyData* mesh, vtkPartitionedDataSetCollection* views, const std::filesystem::path& file);

} // namespace silhouette::program
