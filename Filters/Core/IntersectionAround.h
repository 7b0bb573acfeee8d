// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which of the eight cells around each corner of a shell are intersection octants.
 */
#pragma once

#include "CornerShell.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * For each corner of the shell a bit for each n of 0 to 7: is the cell whose lowest corner is the corner less cornerOffset(n) an intersection octant of
 * the last generation? Those have to be cells of the shell. Cost: linear, by words of 64 cells, and the binary searches of their neighbours.
 */
std::vector<std::uint8_t> intersectionAround(const Octree& octree, const CornerShell& shell, Execution& execution);

} // namespace silhouette
