// SPDX-License-Identifier: BSD-3-Clause
/**
 * Marching cubes on a shell of labelled corners: the one place where labels become triangles.
 */
#pragma once

#include "CornerShell.h"
#include "Mesh.h"

namespace silhouette
{

/** A lattice edge that the surface crosses; one point of the surface lies on each. */
struct CrossedEdge
{
  std::uint32_t inside = 0;  ///< index of the inside end among the shell's corners
  std::uint32_t outside = 0; ///< index of the outside end
  std::uint32_t cell = 0;    ///< the first of the shell's cells that have this edge
};

/** Triangles over crossed edges, before the points are placed. */
struct LatticeSurface
{
  std::vector<CrossedEdge> edges;      ///< ordered by the lower end's lattice code, then by axis
  std::vector<Triangle> triangles;     ///< indices into edges, in the order of the cells
  std::vector<std::uint32_t> cellEnd;  ///< for each shell cell the end of its triangles
  std::vector<std::uint8_t> cellCase;  ///< for each shell cell its case: bit c is set where corner c is inside
};

/** Least distance of a crossing from either end of its edge, in edges, so that no two points coincide. */
constexpr double CrossingMargin = 0.01;

/** Contour all cells of the shell. `inside` has a value 0 or 1 for each corner of it. Throws InvalidInput for more than 2^31 - 1 triangles. */
LatticeSurface contour(const CornerShell& shell, const std::vector<std::uint8_t>& inside, Execution& execution);

/** World position of the point at fraction t, from the inside end, of an edge. */
Eigen::Vector3d crossingPosition(const Lattice& lattice, const CornerShell& shell, const CrossedEdge& edge, double t);

} // namespace silhouette
