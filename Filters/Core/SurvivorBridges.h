// SPDX-License-Identifier: BSD-3-Clause
/**
 * Bridges between components of the survivors that lie apart by no more than a few octants: debris of the pixel grid
 * beside a surface, or a stem that noise has cut.
 */
#pragma once

#include "BlockRegions.h"
#include "CornerShell.h"

#include <vector>

namespace silhouette
{

/** A chain of lattice points, each 18-neighbour of the next, between two components; its ends are survivors' corners. */
using Bridge = std::vector<std::uint64_t>;

/**
 * Bridges that join components of the survivors (26-neighbourhood) with a gap of at most `gap` octants, the smallest
 * component first, each to the nearest other one. None touches the root cube's border. `shell` is that of the
 * intersection octants, `survivors` what connectSurvivors() has found; what is bridged is one there afterwards. Cost: the
 * components' corners times the cube of the gap.
 */
std::vector<Bridge> bridgeSurvivors(
  const Lattice& lattice, const CornerShell& shell, BlockRegions& survivors, int gap, Execution& execution);

} // namespace silhouette
