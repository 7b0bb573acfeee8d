// SPDX-License-Identifier: BSD-3-Clause
/**
 * Labels of lattice points by blocks of 4 x 4 x 4: those of a shell's corners, and of all others, by a field or the octree.
 */
#pragma once

#include "BlockIndex.h"
#include "BrickField.h"
#include "CornerShell.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace silhouette
{

/** The points of a block that touch an octant wholly inside, a bit each. */
std::uint64_t touchingInside(std::uint64_t block, OctantCursor& octants);

/** Labels of lattice points that are no corners of the shell: by a field where it has values, elsewhere by the octree and the cavities that were filled. */
class FarLabels
{
public:
  /** Octree and field, which may be null, are not copied and have to outlive this. */
  explicit FarLabels(const Octree& octree, const BrickField* field = nullptr)
    : TheOctree(&octree)
    , Field(field)
  {
  }

  const Octree& octree() const { return *this->TheOctree; }
  const BrickField* field() const { return this->Field; }
  /** A background octant's corners are inside, as part of a filled cavity. */
  void fillOctant(int generation, std::size_t index);

  bool insideAt(const LatticePoint& p) const;
  /** Of the points of a block, a bit each; of those on the root cube's border and beyond it as if it went on. */
  std::uint64_t insideOfBlock(std::uint64_t block, OctantCursor& octants) const;

private:
  bool isInside(const Octree::Location& octant) const;

  const Octree* TheOctree;
  const BrickField* Field;
  std::vector<std::pair<int, std::size_t>> Filled; ///< sorted
};

/** All blocks where labels differ from one point to the next, or may; elsewhere octants tell. The corners' labels are somebody else's, and may change. */
class LabelBlocks
{
public:
  /** Blocks with corners of the shell, with octants smaller than a block, and those where the field has values. Cost: linear in these. */
  LabelBlocks(const CornerShell& shell, const FarLabels& far, Execution& execution);

  const BlockIndex& blocks() const { return this->Blocks; }
  /** Labels of a block, by its place among these, a bit each; `corners`: those of the shell's. On the border all are outside. */
  std::uint64_t inside(std::size_t place, const std::vector<std::uint8_t>& corners) const;
  /** That of a point of a block. */
  bool inside(std::size_t place, int bit, const std::vector<std::uint8_t>& corners) const;

private:
  Lattice TheLattice;
  BlockIndex Blocks;
  std::vector<std::uint64_t> Corners;     ///< of each block, which points are corners
  std::vector<std::uint32_t> FirstCorner; ///< their first one's number
  std::vector<std::uint64_t> Others;      ///< labels of the other points
};

} // namespace silhouette
