// SPDX-License-Identifier: BSD-3-Clause
/**
 * The check that every function which judges a mesh makes first.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"

namespace silhouette
{

/**
 * Throws InvalidInput for a triangle that names no point of the mesh and for a coordinate that is not finite;
 * the message gives triangle or point. Cost: one pass.
 */
void checkMesh(const Mesh& mesh);
/** The same, side by side. */
void checkMesh(const Mesh& mesh, Execution& execution);

} // namespace silhouette
