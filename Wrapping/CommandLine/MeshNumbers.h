// SPDX-License-Identifier: BSD-3-Clause
/**
 * Numbers of a mesh that somebody else has written.
 */
#pragma once

#include <string>

class vtkPolyData;

namespace silhouette::program
{

/** Which point is the first that is not finite, in words; empty where all are. */
std::string pointsFault(vtkPolyData* mesh);

/** Which face is the first that names a point that there is not, in words; empty where there is none. */
std::string cornersFault(vtkPolyData* mesh);

} // namespace silhouette::program
