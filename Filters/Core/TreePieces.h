// SPDX-License-Identifier: BSD-3-Clause
/**
 * Pieces of an octree: its trees divided among machines, or carved one after another to bound the memory. Every piece
 * knows its trees from the views alone, without asking the others; and since corners, edges and vertices are
 * computed from their lattice coordinates alone, surfaces of the pieces fit together without ghost octants.
 */
#pragma once

#include "Mesh.h"
#include "Octree.h"
#include "PreparedViews.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** One of several parts of a whole: number 0 to count - 1. */
struct Piece
{
  int number = 0;
  int count = 1;
};

/**
 * The trees of a piece: Morton codes within the generation of the tree roots, ascending; empty where there are more
 * pieces than work. All pieces together have each tree once, and a piece's trees follow those of the piece before.
 * The trees are weighed by the octants that a coarse carve, of generation 6 at most, leaves on the surface. Throws
 * InvalidInput for a piece out of range or what carve() does not take, NothingSurvives where the coarse carve leaves
 * nothing, Cancelled. Cost: that of the coarse carve, the same for every piece.
 */
std::vector<std::uint64_t> treesOfPiece(
  const LatticeViews& views, int backgroundVotes, const Piece& piece, Execution& execution);

/** The octree with the given trees alone (ascending); its statistics stay those of the whole. Cost: linear in what is left. */
Octree selectTrees(const Octree& octree, const std::vector<std::uint64_t>& trees);

/** Carve parts of the root lattice put together again: the trees of all of them, in order. */
Octree mergeTrees(const std::vector<Octree>& parts);

/** The items of a piece where `items` are divided evenly, in order: [first, last). */
struct PieceRange
{
  std::size_t first = 0;
  std::size_t last = 0;
};
PieceRange rangeOfPiece(std::size_t items, const Piece& piece);

/** Triangles of a mesh with the points that they use, both in the mesh's order. Cost: linear in the mesh. */
Mesh selectTriangles(const Mesh& mesh, const PieceRange& range);

} // namespace silhouette
