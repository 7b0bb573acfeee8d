// SPDX-License-Identifier: BSD-3-Clause
/**
 * The silhouette that a camera sees of a mesh: what a synthetic capture photographs, and what a
 * reconstruction is compared with.
 */
#pragma once

#include "Mesh.h"
#include "View.h"

namespace silhouette
{

/**
 * Render `mesh` in an image of `width` x `height` pixels: a pixel is object iff its centre, (column, row),
 * lies in the projection of one of the triangles, whichever way that runs; triangles are closed, border
 * included.
 *
 * No cracks: where a triangle's edge crosses a row is computed from the edge alone, the same for both
 * triangles that share it. Where points lie behind the camera or so near its plane that w <= 1e-6 of the
 * greatest w of the mesh, triangles are cut there; what lies behind is not seen. Throws InvalidInput for a
 * width or height below 1, for a triangle that names no point of the mesh, and for a coordinate or a
 * projection that is not finite. Cost: the points, and for each triangle the rows that it covers and the
 * pixels that it sets.
 */
BinaryImage renderSilhouette(const Mesh& mesh, const Projection& projection, int width, int height);

} // namespace silhouette
