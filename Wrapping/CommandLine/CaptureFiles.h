// SPDX-License-Identifier: BSD-3-Clause
/**
 * A capture's files, as vtkSilhouetteCaptureReader reads them.
 */
#pragma once

#include <filesystem>

class vtkPartitionedDataSetCollection;

namespace silhouette::program
{

/** Each view's image as a PNG file of its name, in a folder that is made. Throws ProgramError, or Interrupted. */
void writeImages(vtkPartitionedDataSetCollection* views, const std::filesystem::path& folder);

/** A line a view: its image's name and the 12 numbers of its matrix, all digits. Throws ProgramError. */
void writeProjections(vtkPartitionedDataSetCollection* views, const std::filesystem::path& file);

} // namespace silhouette::program
