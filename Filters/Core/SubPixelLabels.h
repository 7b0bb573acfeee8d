// SPDX-License-Identifier: BSD-3-Clause
/**
 * Labels of corners by distances between pixels, wherever the surface stays closed with them
 * (Documentation/method.md, section 2).
 */
#pragma once

#include "CornerShell.h"
#include "Octree.h"
#include "SubPixelCrossing.h"

#include <vector>

namespace silhouette
{

/**
 * The labels `inside` (1 or 0 for each corner of the shell), with those of SubPixelCrossing::inside() at the corners
 * all of whose eight octants are intersection octants of the last generation: no other octant has such a corner, so
 * that every octant with corners of both labels is still one of the shell's. Octants of trees that the octree does
 * not have are judged by leafState(); so a corner's label depends on its position alone, and is the same in every
 * piece. `shell` is that of the octree's intersection octants. Cost: linear in them, and that of inside() at the
 * corners in question: some in a hundred, more where parts are thin. Memory: eight bytes a corner.
 */
std::vector<std::uint8_t> subPixelLabels(const Octree& octree, const CornerShell& shell, const LatticeViews& views,
  const SubPixelCrossing& distances, const std::vector<std::uint8_t>& inside, Execution& execution);

} // namespace silhouette
