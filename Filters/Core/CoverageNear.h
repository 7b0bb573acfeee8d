// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which survivors does a surface lose where some of it moves? SurvivorCoverage.h for the octants that the motion sweeps.
 */
#pragma once

#include "BoxTree.h"
#include "Execution.h"
#include "MeshPart.h"
#include "Octree.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

class CoverageNear
{
public:
  /**
   * `swept`, world coordinates: what moves stays in these boxes, whose union holds every triangle that moves, before and after. `mesh` is the surface
   * before; `cells`: cellsMet() of these boxes. Survivors of the last generation that no box meets are crossed and enclosed as before. `octree` is not copied
   * and has to outlive this. Cost: the boxes' octants, and a pass over the triangles.
   */
  CoverageNear(const Octree& octree, const Mesh& mesh, const std::vector<Box>& swept, const std::vector<std::uint64_t>& cells, Execution& execution);

  /** Morton codes, ascending, of the lost survivors that a box meets. `mesh` differs from the one before in points alone. Cost:
   * survivorCoverage() of those octants, with the triangles in their rows along x. */
  std::vector<std::uint64_t> lost(const Mesh& mesh, Execution& execution) const;
  /** Those of them that one of some boxes meets, or an octant beside it. Cost: a pass over the triangles in all rows, and those octants with what is in their rows. */
  std::vector<std::uint64_t> lostWithin(const std::vector<Box>& boxes, const Mesh& mesh, Execution& execution) const;

private:
  void findSurvivors(const Octree& octree, const std::vector<std::uint64_t>& cells);
  void findTriangles(const Mesh& mesh, const std::vector<Box>& swept, Execution& execution);

  Octree Part;        ///< the survivors, in a last generation of their own
  MeshPart Triangles; ///< that may lie in the survivors' rows
};

} // namespace silhouette
