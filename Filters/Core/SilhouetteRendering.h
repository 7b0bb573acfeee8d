// SPDX-License-Identifier: BSD-3-Clause
/**
 * The silhouette that a camera sees of a mesh: what a synthetic capture photographs, and what a
 * reconstruction is compared with.
 */
#pragma once

#include "Mesh.h"
#include "View.h"

#include <algorithm>
#include <vector>

namespace silhouette
{

/** Pixels from a first to a last column and row; none where a last one comes before the first. */
struct ImageBox
{
  int left, top, right, bottom;

  void include(const ImageBox& other)
  {
    this->left = std::min(this->left, other.left);
    this->top = std::min(this->top, other.top);
    this->right = std::max(this->right, other.right);
    this->bottom = std::max(this->bottom, other.bottom);
  }
};

/** Renders silhouettes, one after another, in memory that it keeps. */
class SilhouetteRenderer
{
public:
  /**
   * Render `mesh` in an image of `width` x `height` pixels, which holds until the next is rendered: a pixel is object iff its centre, (column, row),
   * lies in the projection of one of the triangles, whichever way that runs; triangles are closed, border
   * included.
   *
   * No cracks: where a triangle's edge crosses a row is computed from the edge alone, the same for both
   * triangles that share it. Where points lie behind the camera or so near its plane that w <= 1e-6 of the
   * greatest w of the mesh, triangles are cut there; what lies behind is not seen. Throws InvalidInput for a
   * width or height below 1, for a triangle that names no point of the mesh, and for a coordinate or a
   * projection that is not finite. Cost: the points, the triangles, and for each of them the rows that it covers; of small ones whose box is all object already,
   * the box.
   */
  const BinaryImage& render(const Mesh& mesh, const Projection& projection, int width, int height);

private:
  void fillSeen(const Mesh& mesh, const Projection& projection);
  void fillCut(const Mesh& mesh, const Projection& projection, double nearPlane);

  BinaryImage Image;
  std::vector<ImageBox> Boxes; ///< of the points where all are seen; perhaps more of them than there are points
};

/** One silhouette. */
inline BinaryImage renderSilhouette(const Mesh& mesh, const Projection& projection, int width, int height)
{
  return SilhouetteRenderer().render(mesh, projection, width, height);
}

} // namespace silhouette
