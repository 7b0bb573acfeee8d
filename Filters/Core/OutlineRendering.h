// SPDX-License-Identifier: BSD-3-Clause
/**
 * The silhouettes of one closed mesh in many views, from its outlines: edges between a triangle that faces the camera and one that does not.
 * They bound the sheet of the triangles that face it, and how often an outline winds around a pixel is how many of these cover it.
 */
#pragma once

#include "Mesh.h"
#include "View.h"

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

class OutlineRenderer
{
public:
  /**
   * `mesh` is not copied and has to outlive this. Throws InvalidInput as renderSilhouette() does. Cost: a few
   * passes over the triangles.
   */
  explicit OutlineRenderer(const Mesh& mesh);

  /**
   * The silhouette as renderSilhouette() makes it, except that a pixel whose centre lies on an outline to within rounding may differ. The
   * mesh has to be closed and oriented; where some of it lies behind the camera or near its plane, renderSilhouette() is called. Errors as there. Cost:
   * a few operations for each triangle, the rows that outlines cross, and a pass over the pixels around them.
   */
  BinaryImage render(const Projection& projection, int width, int height) const;

private:
  /** An edge and the triangles along which it runs forwards and backwards, or the number of triangles for none. */
  struct Edge
  {
    std::int32_t from, to;
    std::uint32_t forwards, backwards;
  };

  const Mesh& TheMesh;
  std::vector<Edge> Edges;
  std::vector<std::array<double, 4>> Planes; ///< of each triangle: normal and its product with a corner
};

} // namespace silhouette
