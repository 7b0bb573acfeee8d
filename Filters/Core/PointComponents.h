// SPDX-License-Identifier: BSD-3-Clause
/**
 * Connected components of lattice points.
 */
#pragma once

#include "BlockSteps.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * Those components of `points` (Morton codes, ascending, no code twice) that have `least` points or more, the points of each ascending, the components in the
 * order of their first points. Points are joined that are neighbours by `steps`. Cost: linear in the points; what is looked for is blocks of 4 x 4 x 4.
 */
std::vector<std::vector<std::uint64_t>> pointComponents(const std::vector<std::uint64_t>& points, Steps steps, std::size_t least);

} // namespace silhouette
