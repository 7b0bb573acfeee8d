// SPDX-License-Identifier: BSD-3-Clause
/**
 * Local hulls: the 3D convex hulls of the local convexities of a surface (Documentation/method.md, section 4).
 *
 * Seeds are the connected patches of the surface within blocks of octants; neighbouring parts are merged, the pair
 * with the smallest joint box first, as long as the hull of both holds no outside corner of the lattice deeper than a tolerance. A pair that fails
 * is not tried again: a larger hull holds what a smaller one did.
 */
#pragma once

#include "Execution.h"
#include "LatticeLabels.h"
#include "Mesh.h"

#include <vector>

namespace silhouette
{

/** One convex part: a closed convex mesh, oriented outwards, and the surface points it was made from. */
struct LocalHull
{
  Mesh mesh;
  std::vector<std::int32_t> surfacePoints; ///< indices into the surface's points, ascending
};

struct LocalHullsOptions
{
  /** Octants, 0 or more: how deep an outside corner may lie in a hull; larger merges more, and bridges more of a concavity. */
  double tolerance = 0.5;
  int seedBlock = 4; ///< octants a side of the blocks that seeds lie in, at least 1; larger is fewer, coarser seeds
};

/**
 * The hulls of `surface`, in the order of their first triangles; parts whose points lie in a plane have none.
 * Cost: a Qhull run, and a look at the lattice corners in the hull, for each merge that is tried.
 */
std::vector<LocalHull> localHulls(
  const Mesh& surface, const LatticeLabels& labels, const LocalHullsOptions& options, Execution& execution);

} // namespace silhouette
