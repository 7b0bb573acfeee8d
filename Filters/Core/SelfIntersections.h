// SPDX-License-Identifier: BSD-3-Clause
/**
 * All self-intersections of a mesh, by exact predicates (TriangleIntersection.h): pairs of triangles that
 * meet beyond what they share by index, and triangles without area, as a pair with themselves.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Triangle indices, first <= second; equal for a degenerate triangle. */
using TrianglePair = std::array<std::int32_t, 2>;

/**
 * All pairs, sorted, each once; the same for any number of threads. Throws InvalidInput for an invalid mesh,
 * Cancelled. Cost: n log n and the pairs of triangles whose boxes overlap; about 1.5 s for a million
 * triangles on one thread, some four times that where all neighbours lie in one plane; the square of the triangles where all boxes overlap, as in a fan of
 * long ones around a point; 200 bytes of memory a triangle.
 */
std::vector<TrianglePair> selfIntersections(const Mesh& mesh, Execution& execution);

/**
 * The pairs of which both triangles are in `subset` (triangle indices in any order; repeats do not count).
 * Throws InvalidInput for an index out of range. Cost: as above for the subset alone, and one pass over the
 * points.
 */
std::vector<TrianglePair> selfIntersectionsAmong(
  const Mesh& mesh, const std::vector<std::int32_t>& subset, Execution& execution);

/**
 * The pairs of which at least one triangle is in `subset`: what may have changed where only those triangles
 * moved. Cost: as above for the subset, and for all triangles one look at the subset's tree.
 */
std::vector<TrianglePair> selfIntersectionsWith(
  const Mesh& mesh, const std::vector<std::int32_t>& subset, Execution& execution);

} // namespace silhouette
