// SPDX-License-Identifier: BSD-3-Clause
/**
 * The union of local hulls and of the solid they were made from, on the lattice: a corner is inside where any of them holds it, and
 * a lattice edge is crossed where it leaves the union.
 */
#pragma once

#include "LatticeSurface.h"
#include "LocalHulls.h"
#include "RowIntervals.h"

namespace silhouette
{

/** The union of the hulls and of what `surface` encloses. Cost: sorting the rows, of each hull its cross-sections. */
SolidRows combinedRows(const std::vector<LocalHull>& hulls, const SurfaceCrossings& surface, const Lattice& lattice,
  Execution& execution);

/** A surface on a shell of its own. */
struct CombinedSurface
{
  CornerShell shell;
  LatticeSurface surface;
  std::vector<double> fractions; ///< for each edge, from the inside end, within CrossingMargin
};

/** Contour a solid: all cells whose corners differ, corners on the root cube's border being outside. */
CombinedSurface contourRows(const SolidRows& rows, const Lattice& lattice, Execution& execution);

} // namespace silhouette
