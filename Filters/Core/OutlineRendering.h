// SPDX-License-Identifier: BSD-3-Clause
/**
 * The silhouettes of one closed mesh in many views, from its outlines: edges between a triangle that faces the camera and one that does not.
 * They bound the sheet of the triangles that face it, and how often an outline winds around a pixel is how many of these cover it.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"
#include "SilhouetteRuns.h"
#include "View.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** A camera and the size of its image, px. */
struct ImageCamera
{
  Projection projection = Projection::Zero();
  int width = 0;
  int height = 0;
};

/** An edge of an outline, points of the mesh, and by how much it changes the winding of what it is left or right of: 1 or -1. */
struct OutlineSegment
{
  std::int32_t from, to;
  int sign;
};

/** Segments as they were found side by side, lists of them. */
using OutlineLists = std::vector<std::vector<OutlineSegment>>;

class OutlineRenderer
{
public:
  /**
   * `mesh` is not copied and has to outlive this. Throws InvalidInput as renderSilhouette() does. Cost: a few
   * passes over the triangles, in them a few operations for each triangle and camera; 32 bytes a triangle, which are given back, and the outlines.
   */
  OutlineRenderer(const Mesh& mesh, std::vector<ImageCamera> cameras, Execution& execution);

  std::size_t size() const { return this->Cameras.size(); }
  /**
   * What the n-th camera sees: the silhouette as renderSilhouette() makes it, except that a pixel whose centre lies on an outline to within rounding may
   * differ. The mesh has to be closed and oriented; where some of it lies behind the camera or near its plane, renderSilhouette() is called. Cost: the
   * outlines' segments, and the rows that they cross. Several may be rendered at a time.
   */
  SilhouetteRuns render(std::size_t n) const;

private:
  void requireProjectable();
  void findOutlines(std::size_t first, std::size_t last, Execution& execution);

  const Mesh& TheMesh;
  std::vector<ImageCamera> Cameras;
  std::vector<std::uint8_t> InFront; ///< for each camera 1 where all points are in front of it, and not near its plane
  std::vector<OutlineLists> Outlines; ///< of each camera
};

} // namespace silhouette
