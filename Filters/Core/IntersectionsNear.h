// SPDX-License-Identifier: BSD-3-Clause
/**
 * The intersections of a mesh near where it moves, looked for again only where something has changed: SelfIntersections.h for some triangles.
 */
#pragma once

#include "Execution.h"
#include "MeshPart.h"
#include "SelfIntersections.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace silhouette
{

class IntersectionsNear
{
public:
  IntersectionsNear() = default;
  /** Among the triangles of these numbers, ascending. */
  IntersectionsNear(const Mesh& mesh, std::vector<std::int32_t> triangles);

  /**
   * The pairs of these triangles that meet, by their numbers in the mesh, in any order; the mesh has the triangles that it had before. `hasChanged(triangle)`:
   * may a triangle lie elsewhere than at the last call? The first call does not ask. Throws Cancelled. Cost: the first time selfIntersections() of these
   * triangles, then that of those that have changed and a pass over the rest.
   */
  const std::vector<TrianglePair>& pairs(const Mesh& mesh, const std::function<bool(std::size_t)>& hasChanged, Execution& execution);

private:
  MeshPart Part;
  bool IsKnown = false;
  std::vector<TrianglePair> Met; ///< by numbers in the mesh
};

} // namespace silhouette
