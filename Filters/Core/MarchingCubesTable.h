// SPDX-License-Identifier: BSD-3-Clause
/**
 * The one case table of marching cubes. A case is the set of a cell's inside corners (bit c is corner c,
 * numbered as cornerOffset). On each face, walked counter-clockwise seen from outside, a crossing from inside
 * to outside is linked to the next crossing from outside to inside; the rule depends on that face alone, so that
 * neighbouring cells agree whatever the labels, and inside corners across an ambiguous face are joined. Reversal is not used.
 * Each loop is triangulated without a diagonal in a cube face.
 */
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** The edges of a cell: edge e joins corner edgeCorners[e][0] to the corner one lattice step further on its axis. */
inline constexpr std::array<std::array<std::uint8_t, 2>, 12> edgeCorners = { { { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 },
  { 0, 2 }, { 1, 3 }, { 4, 6 }, { 5, 7 }, { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } } };

/** Axis (0, 1, 2) of each edge; edges 0 to 3 run along x, 4 to 7 along y, 8 to 11 along z. */
inline int edgeAxis(int edge)
{
  return edge / 4;
}

struct MarchingCubesCase
{
  std::vector<std::vector<std::uint8_t>> loops;           ///< edges in order, outside on the right of the walk
  std::vector<std::array<std::uint8_t, 3>> triangles;     ///< edges; normals point from inside to outside
};

/** The 256 cases. */
const std::array<MarchingCubesCase, 256>& marchingCubesTable();

} // namespace silhouette
