// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which octants that survived the carving has a surface lost? Decided from the mesh alone, without labels or
 * votes, and exactly: by comparisons with the lattice's planes and by exact predicates (ExactPredicates.h).
 *
 * An octant is crossed where the surface meets its open cube; a triangle in a face of the cube, or one that
 * touches it from outside, does not. It is enclosed where it is not crossed and its centre is inside: the ray
 * from the centre along +x passes the surface an odd number of times (a ray through an edge or a point is
 * moved aside symbolically). For a closed mesh that does not depend on the ray's direction; for an open one
 * it is what this ray says, and not more.
 */
#pragma once

#include "Execution.h"
#include "Lattice.h"
#include "Mesh.h"
#include "Octree.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** What the surface does to an octant. */
enum class Coverage : std::uint8_t
{
  Lost = 0,
  Crossed = 1,
  Enclosed = 2
};

/**
 * For each octant of the last generation, in its order, what the surface does to it; background octants are
 * told crossed or lost alone. The same for any number of threads. Throws InvalidInput for an invalid mesh or
 * an octree without generations, Cancelled. Cost: near-linear in triangles and octants, and for a triangle
 * larger than an octant the octants that it meets and the rows (along x) that it faces.
 */
std::vector<Coverage> survivorCoverage(const Octree& octree, const Mesh& mesh, Execution& execution);

/**
 * The number of last-generation survivors, inside ones too, that the surface neither crosses nor encloses.
 */
std::uint64_t lostSurvivors(const Octree& octree, const Mesh& mesh, Execution& execution);

/** Does the closed triangle meet the open cube of the cells [low, high) of the lattice? Exact. */
bool triangleMeetsOpenCells(const Lattice& lattice, const LatticePoint& low, const LatticePoint& high,
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

} // namespace silhouette
