// SPDX-License-Identifier: BSD-3-Clause
/**
 * The progressive test of one octant in one view: what does the convex polygon of its eight projected corners
 * hold? First its bounding box against the view's tiles, then, only where that is undecided, the corners' pixels and
 * the exact polygon row by row. Cost linear in the polygon's rows.
 */
#pragma once

#include "PreparedViews.h"

namespace silhouette
{

/** What one view says of a whole octant. */
enum class ViewRelation : std::uint8_t
{
  Background, ///< every pixel of the octant is background
  Mixed,      ///< background and something else, or the octant straddles the camera's plane
  Inside,     ///< every pixel is object
  Abstain,    ///< the view says nothing about any of it
  Partial     ///< no background, but only part of it is seen
};

/** Pixels are taken from the polygon widened by this much, so that they hold every lattice point's own pixel. */
constexpr double OctantGuard = 1e-6;

/** An octant of edge `size` (in leaf octants) whose least corner is lattice point `lowest`. */
struct OctantBox
{
  LatticePoint lowest;
  std::int32_t size = 1;
};

ViewRelation relate(const PreparedView& view, const LatticeProjection& projection, const OctantBox& octant);

/**
 * The same for the eight children of an octant of edge 2 and more at once: relations[c] for each child c whose bit is
 * set in `children`. The 27 lattice points that they share are projected once.
 */
void relateChildren(const PreparedView& view, const LatticeProjection& projection, const OctantBox& parent,
  unsigned children, std::array<ViewRelation, 8>& relations);

/** The first stage alone: the bounding box of the polygon. For comparison; relate() decides more. */
ViewRelation relateBoundingBox(
  const PreparedView& view, const LatticeProjection& projection, const OctantBox& octant);

} // namespace silhouette
