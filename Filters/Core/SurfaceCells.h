// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which leaf cells do the points of a surface lie in?
 */
#pragma once

#include "Execution.h"
#include "Lattice.h"
#include "Mesh.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * The Morton codes, ascending, of the leaf cells that the points of a surface lie in, those beyond the lattice in its outermost ones; points that are not finite lie in none.
 * Cost: linear where the points come in the lattice's order, else n log n.
 */
std::vector<std::uint64_t> surfaceCells(const Mesh& surface, const Lattice& lattice, Execution& execution);

/** The cells of the lattice with `halvings` generations less that these, ascending, lie in; ascending. Cost: linear. */
std::vector<std::uint64_t> coarserCells(const std::vector<std::uint64_t>& cells, int halvings);

} // namespace silhouette
