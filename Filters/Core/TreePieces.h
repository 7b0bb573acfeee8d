// SPDX-License-Identifier: BSD-3-Clause
/**
 * Pieces of an octree: its trees divided among machines, or carved one after another to bound the memory. Every piece's trees
 * are known from the views alone, without asking the others; and since corners, edges and vertices are
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
 * What each tree of an octree will cost, about: octants that a coarse carve, of generation 6 at most, leaves on its surface, and a little for the tree itself. Of no
 * meaning but to treesOfPiece(). Throws what carve() throws, NothingSurvives where the coarse carve leaves nothing. Cost: that of the coarse carve.
 */
std::vector<std::uint64_t> weighTrees(const LatticeViews& views, int backgroundVotes, Execution& execution);

/**
 * The trees of a piece: Morton codes within the generation of the tree roots, ascending; empty where there are more
 * pieces than work. All pieces together have each tree once, and a piece's trees follow those of the piece before. Throws
 * InvalidInput for a piece out of range.
 */
std::vector<std::uint64_t> treesOfPiece(const std::vector<std::uint64_t>& weights, const Piece& piece);

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
