// SPDX-License-Identifier: BSD-3-Clause
/**
 * What of some lattice points, or of some leaf cells, is connected: near the surface by parts of blocks of 4 x 4 x 4, a bit for each point or cell, and
 * far from it by whole octants.
 */
#pragma once

#include "BlockIndex.h"
#include "BlockSteps.h"
#include "ConcurrentUnionFind.h"
#include "Octree.h"

#include <vector>

namespace silhouette
{

/** Sets of parts of blocks, octants, the world beyond the root cube, and other numbers that are the caller's to join. */
class BlockRegions
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  /**
   * `blocks`: Morton codes of blocks, ascending, those of subdividedBlocks() among them; `members`: of each the points that are to be joined, a bit each.
   * Elsewhere the points of octants of this state are members; among themselves octants are joined across faces alone, as is enough where an octree is
   * carved: those that meet elsewhere meet others there. What blocks leave of an octant is taken to be in one piece. Where the state is background, so is
   * the world beyond, and the members on the root cube's border or beyond it are part of that. Cost: linear in blocks and octants.
   */
  BlockRegions(const Octree& octree, OctantState state, Steps steps, BlockIndex blocks, const std::vector<std::uint64_t>& members,
    std::size_t others, Execution& execution);

  /** Number of a point's part or octant; None where it is no member. Cost: finding its block, or its octant. */
  std::uint32_t at(std::uint64_t point) const;
  /** Number of a part that holds a point, by the place of its block; None where it is no member. */
  std::uint32_t partAt(std::size_t block, int bit) const;
  /** at() of many points, ascending. Cost: linear. */
  std::vector<std::uint32_t> numbersOf(const std::vector<std::uint64_t>& points, Execution& execution) const;
  const BlockIndex& blocks() const { return this->Blocks; }
  /** The first part of a block; those of a block follow one another. */
  std::uint32_t firstPart(std::size_t block) const { return this->FirstPart[block]; }
  /** The points of a part, a bit each. */
  std::uint64_t part(std::uint32_t number) const { return this->Parts[number]; }
  /** Number of an octant no smaller than a block; None where it is no member. */
  std::uint32_t octant(int generation, std::size_t index) const;
  /** The last generation whose octants are numbered: they are no smaller than blocks. Below the trees' where there are no such. */
  int coarsest() const { return this->LastGeneration; }
  std::uint32_t beyond() const { return this->Beyond; }
  std::uint32_t other(std::size_t number) const { return this->Beyond + 1 + std::uint32_t(number); }

  /** How many numbers there are. */
  std::size_t size() const { return this->Sets.size(); }
  /** How many sets the parts and octants make. */
  std::size_t count();
  /** Stands for the set of a number. */
  std::uint32_t find(std::uint32_t number) { return this->Sets.find(number); }
  void unite(std::uint32_t a, std::uint32_t b) { this->Sets.unite(a, b); }

private:
  class BlocksAround;

  void findParts(Steps steps, const std::vector<std::uint64_t>& members, Execution& execution);
  void findOctants(OctantState state, Execution& execution);
  Octree::Location beside(int g, std::size_t known, std::uint64_t code, OctantCursor& cursor) const;
  void joinOctants(Execution& execution);
  void joinBlocks(Steps steps, Execution& execution);
  void joinElsewhere(std::size_t block, const BlocksAround& around, const BlockDirection& direction, OctantCursor& cursor);
  void joinPoints(std::size_t block, std::uint64_t points, std::uint32_t number);

  const Octree* Source;
  int LastGeneration;
  bool WithBeyond;
  BlockIndex Blocks;
  std::vector<std::uint32_t> FirstPart;   ///< of each block, and the end
  std::vector<std::uint64_t> Parts;       ///< points of a block that meet within it
  std::vector<std::size_t> FirstOctant;   ///< of each generation that is numbered, among these, and the end
  std::vector<std::uint8_t> IsMember;     ///< of each octant of these generations
  std::uint32_t Beyond = 0;
  ConcurrentUnionFind Sets;
};

/** Morton codes, ascending, of the blocks of 4 x 4 x 4 cells that hold octants smaller than a block. */
std::vector<std::uint64_t> subdividedBlocks(const Octree& octree);

} // namespace silhouette
