// SPDX-License-Identifier: BSD-3-Clause
/**
 * Do two triangles of a mesh meet where they should not? Decided by exact predicates alone, so that it holds
 * for the coordinates as stored, to the last bit (see ExactPredicates.h for their range).
 */
#pragma once

#include "Mesh.h"

#include <vector>

namespace silhouette
{

/** True where the triangle's three corners lie on a line, or coincide: its area is exactly 0. */
bool isDegenerate(const std::vector<Eigen::Vector3d>& points, const Triangle& triangle);

/**
 * True where the closed triangles have a point in common beyond what they share by index:
 * - no index shared: any common point, a mere touch too;
 * - one: any common point but that corner;
 * - two: only if they lie in one plane and are folded onto each other; their other corners' coincidence too;
 * - three: always.
 * A degenerate triangle is taken as its three edges where no index is shared, and never meets a triangle with
 * which it shares an index: it is to be reported on its own (isDegenerate). Indices must be valid.
 * Cost: 10 to 50 ns for neighbours and for triangles that one of their planes separates.
 */
bool trianglesIntersect(const std::vector<Eigen::Vector3d>& points, const Triangle& a, const Triangle& b);

} // namespace silhouette
