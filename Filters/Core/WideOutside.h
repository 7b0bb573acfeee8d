// SPDX-License-Identifier: BSD-3-Clause
/**
 * What of a solid's wide outside is connected: points along lattice edges, near the surface by parts of blocks of 4 x 4 x 4 points, far from it by
 * the octree's background octants.
 */
#pragma once

#include "ConcurrentUnionFind.h"
#include "NarrowOutside.h"

#include <vector>

namespace silhouette
{

/** Sets of narrow points, parts of blocks, octants and the world beyond the root cube. */
class WideOutside
{
public:
  /** `width` as that of the narrow outside, which has to outlive this. Cost: linear in the octants, and the points within 2 `width` of the surface. */
  WideOutside(const LatticeLabels& labels, const NarrowOutside& narrow, int width, Execution& execution);

  /** Stands for the set of a wide point near the surface; `Nowhere` for points that are in no block. */
  std::uint32_t setOf(const LatticePoint& wide);
  /** Stands for the set of a narrow point, by its index: alone until it is joined. */
  std::uint32_t setOf(std::size_t narrow) { return this->Sets.find(std::uint32_t(narrow)); }
  /** Join a narrow point to a wide point beside it. */
  void join(std::size_t narrow, const LatticePoint& wide);
  /** Join two narrow points. */
  void join(std::size_t narrow, std::size_t other) { this->Sets.unite(std::uint32_t(narrow), std::uint32_t(other)); }

  static constexpr std::uint32_t Nowhere = 0xffffffffu;

private:
  void findParts(const NarrowOutside& narrow, Execution& execution);
  std::uint32_t partOf(const LatticePoint& p) const;
  void joinBlocks(Execution& execution);
  void joinOctants(const LatticeLabels& labels, int width, Execution& execution);
  void joinPoints(std::size_t block, std::uint64_t points, std::uint32_t set);

  std::vector<std::uint64_t> Blocks;    ///< Morton codes, ascending
  std::vector<std::uint32_t> FirstPart; ///< of each block, and the end
  std::vector<std::uint64_t> Parts;     ///< points of a block that meet within it
  std::uint32_t Before = 0;             ///< sets before those of the parts: the narrow points'
  ConcurrentUnionFind Sets;
};

} // namespace silhouette
