// SPDX-License-Identifier: BSD-3-Clause
/**
 * Placing a lattice surface's points, and the guarantee that it does not intersect itself.
 *
 * The patches of different cells meet only in the faces between the cells, where both have the same segments; so
 * only triangles of one cell can intersect each other. With all of a cell's points in the middle of their edges no case of the table
 * does (a test tries all 256). Whatever the crossings, moving the points of an offending cell there ends it.
 */
#pragma once

#include "LatticeSurface.h"

namespace silhouette
{

/**
 * The mesh of a surface: its points at the given fractions from the inside ends. With `singlePrecision` they are rounded to float;
 * throws InvalidInput where float is too coarse to keep points of one lattice edge apart.
 */
Mesh placePoints(const Lattice& lattice, const CornerShell& shell, const LatticeSurface& surface,
  const std::vector<double>& fractions, bool singlePrecision, Execution& execution);

/** Throws InvalidInput where float cannot hold the lattice's surfaces: it must resolve 1/1024 of a leaf. */
void requireSinglePrecision(const Lattice& lattice);

/**
 * Find cells whose triangles intersect each other (exact predicates) and move their points to the middle of their
 * edges, until there is none; returns the number of points moved. Cost: linear in the triangles.
 */
std::uint64_t removeCellIntersections(const Lattice& lattice, const CornerShell& shell,
  const LatticeSurface& surface, bool singlePrecision, Mesh& mesh, Execution& execution);

} // namespace silhouette
