// SPDX-License-Identifier: BSD-3-Clause
/**
 * Is a mesh what a closed surface of a solid has to be? Counts of what is wrong, and its genus, volume and
 * area.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"

#include <cstdint>
#include <optional>

namespace silhouette
{

struct MeshSoundness
{
  std::uint64_t points = 0;             ///< that at least one triangle uses
  std::uint64_t unusedPoints = 0;       ///< that no triangle uses; they count nowhere else
  std::uint64_t triangles = 0;
  std::uint64_t openEdges = 0;          ///< edges of one triangle
  std::uint64_t nonManifoldEdges = 0;   ///< edges of three or more triangles; edges from a point to itself
  std::uint64_t nonManifoldVertices = 0; ///< points whose triangles are not one fan, open or closed; so are
                                         ///< the ends of a non-manifold edge
  std::uint64_t inconsistentEdges = 0;  ///< edges of two triangles that both run the same way along it
  std::uint64_t selfIntersections = 0; ///< pairs of triangles, and degenerate triangles (SelfIntersections.h)
  std::uint64_t components = 0;         ///< sets of triangles connected by shared points
  /** Sum over components; empty where the mesh is empty, open, non-manifold or inconsistent. */
  std::optional<std::int64_t> genus;
  double volume = 0.0; ///< signed, cubic units; negative where triangles run clockwise seen from outside.
                       ///< Where the mesh is open, that of the cones from its bounding box's centre
  double area = 0.0;   ///< square units

  /** There are triangles, and each edge has at least two. */
  bool closed() const { return this->triangles > 0 && this->openEdges == 0; }
  /** Closed, manifold, consistent, free of self-intersections, and of positive volume: oriented outwards. */
  bool sound() const
  {
    return this->closed() && this->nonManifoldEdges == 0 && this->nonManifoldVertices == 0 &&
      this->inconsistentEdges == 0 && this->selfIntersections == 0 && this->volume > 0.0;
  }
};

/**
 * Judge a mesh; an empty one has all counts 0 and is not closed. Points count as one by index alone: weld
 * first what has no shared points. The result does not depend on the number of threads. Throws InvalidInput
 * for an invalid mesh, Cancelled. Cost: a sort of the edges, and selfIntersections.
 */
MeshSoundness assessMesh(const Mesh& mesh, Execution& execution);

/**
 * The mesh with points of exactly equal coordinates made one (0.0 and -0.0 are equal), for formats without
 * shared points. Points keep the order, and the coordinates, of their first appearance; triangles stay in
 * order, also those that have become degenerate. Cost: a sort of the points.
 */
Mesh weldCoincidentPoints(const Mesh& mesh);

} // namespace silhouette
