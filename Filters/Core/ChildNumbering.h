// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where the children of a generation's octants are.
 */
#pragma once

#include "Execution.h"
#include "Octree.h"

namespace silhouette
{

/** Fill Generation::childBlock from the states. Cost: two passes, side by side. */
void numberChildren(Generation& generation, Execution& execution);

} // namespace silhouette
