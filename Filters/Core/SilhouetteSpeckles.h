// SPDX-License-Identifier: BSD-3-Clause
/**
 * Speckles of silhouettes: small regions that salt and pepper leaves.
 */
#pragma once

#include "SilhouetteDissent.h"
#include "SilhouetteRepair.h"

#include <optional>
#include <vector>

namespace silhouette
{

/**
 * The views without their speckles, or nothing where these are too few or the other views do not dispute
 * them; `flipped` is given their pixels by view. Options are taken as checked. Cost: a pass over the pixels.
 */
std::optional<PreparedViews> withoutSpeckles(const LatticeViews& lattice, const SurvivorBox& box,
  const SilhouetteRepairOptions& options, std::vector<std::uint64_t>& flipped, Execution& execution);

} // namespace silhouette
