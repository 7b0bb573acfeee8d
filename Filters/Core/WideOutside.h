// SPDX-License-Identifier: BSD-3-Clause
/**
 * What of a solid's wide outside is connected, points along lattice edges, and with which of it narrow points are joined.
 */
#pragma once

#include "BlockRegions.h"
#include "NarrowOutside.h"

namespace silhouette
{

/** Sets of narrow points, of the wide outside's points, and of the world beyond the root cube. */
class WideOutside
{
public:
  /** The narrow outside of the same labels. Cost: linear in the octants, and the points within some of its width of the surface. */
  WideOutside(const LatticeLabels& labels, const NarrowOutside& narrow, Execution& execution);

  /** Stands for the set of a wide point; the world beyond the root cube is wide. `Nowhere` for other points. */
  std::uint32_t setOf(const LatticePoint& wide);
  /** Stands for the set of a narrow point, by its index: alone until it is joined. */
  std::uint32_t setOf(std::size_t narrow) { return this->Regions.find(this->Regions.other(narrow)); }
  /** Join a narrow point to a wide point beside it. */
  void join(std::size_t narrow, const LatticePoint& wide);
  /** Join two narrow points. */
  void join(std::size_t narrow, std::size_t other) { this->Regions.unite(this->Regions.other(narrow), this->Regions.other(other)); }

  static constexpr std::uint32_t Nowhere = BlockRegions::None;

private:
  std::uint32_t numberOf(const LatticePoint& wide) const;

  BlockRegions Regions;
};

} // namespace silhouette
