// SPDX-License-Identifier: BSD-3-Clause
/**
 * Digital topology of the lattice as our marching-cubes table sees it: inside corners are connected through lattice
 * edges and the diagonals of lattice squares (18-neighbourhood), outside corners through lattice edges
 * (6-neighbourhood). A corner is simple where changing its label changes neither components nor tunnels nor
 * cavities (Bertrand's topological numbers for the pair (18, 6+); Bertrand and Malandain 1994).
 */
#pragma once

#include <array>
#include <bitset>
#include <cstdint>

namespace silhouette
{

/** Labels of the 27 lattice points around a corner: index (dx + 1) + 3 (dy + 1) + 9 (dz + 1), true is inside. */
using Neighbourhood = std::bitset<27>;

/** The numbers of the 18 points around that an inside centre is connected with where they are inside, too. */
inline constexpr int SolidNeighbours[18] = { 1, 3, 4, 5, 7, 9, 10, 11, 12, 14, 15, 16, 17, 19, 21, 22, 23, 25 };

/** What labelling the centre inside would do. */
struct TopologicalNumbers
{
  int inside = 0;  ///< components of the solid around the centre that it would touch
  int outside = 0; ///< components of the outside around the centre that it touches
  /** For each of the 27 points the number of its inside component around the centre, or -1 where it is in none. */
  std::array<std::int8_t, 27> insideComponent{};
};

TopologicalNumbers topologicalNumbers(const Neighbourhood& labels);

/** The components that TopologicalNumbers::inside counts, the points of each as bits. Returns how many there are. */
int solidParts(const Neighbourhood& labels, std::array<std::uint32_t, 26>& parts);

/** True where both numbers are 1. */
bool isSimple(const TopologicalNumbers& numbers);

/**
 * By how much labelling the centre inside raises the solid's Euler number, components less tunnels plus cavities: half of what it does to the
 * surface's, counted on the table's loops in the eight cells around.
 */
int eulerChange(const Neighbourhood& labels);

} // namespace silhouette
