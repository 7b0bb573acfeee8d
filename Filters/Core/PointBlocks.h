// SPDX-License-Identifier: BSD-3-Clause
/**
 * A set of lattice points, kept by blocks of 4 x 4 x 4: neighbours are found for 64 points at a time.
 */
#pragma once

#include "BlockWords.h"
#include "Execution.h"
#include "GrowingPoints.h"
#include "Lattice.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace silhouette
{

/** Everything is done side by side, with the same outcome whatever the threads. */
class PointBlocks
{
public:
  PointBlocks() = default;
  /** `points`: Morton codes, ascending. */
  PointBlocks(const std::vector<std::uint64_t>& points, Execution& execution);
  /** `words`: ascending, of a block one, none without points. */
  explicit PointBlocks(std::vector<BlockWord> words)
    : Blocks(std::move(words))
  {
  }

  bool empty() const { return this->Blocks.empty(); }
  /** The points by blocks, ascending, none without points. */
  const std::vector<BlockWord>& words() const { return this->Blocks; }
  /** Morton codes of the points, ascending. */
  std::vector<std::uint64_t> points(Execution& execution) const;
  /** The lattice's points one step along a lattice edge from one of these, among them such as are in this set. Cost: linear in the blocks. */
  PointBlocks beside(const Lattice& lattice, Execution& execution) const;
  /** These points and those one step before and behind on an axis, none of which is negative. Cost: as beside(). */
  PointBlocks spread(int axis, Execution& execution) const;
  /** These points and those one step behind: of a point's, on all axes one after another, come the cells around it. */
  PointBlocks spreadBehind(int axis, Execution& execution) const;
  /** Take the other set's points out. Cost: linear in the blocks. */
  void remove(const PointBlocks& other, Execution& execution);
  void remove(const GrowingPoints& other, Execution& execution);

private:
  void dropEmpty(Execution& execution);

  std::vector<BlockWord> Blocks; ///< ascending, none without points
};

/** The eight cells around each of some points (Morton codes, in any order), but for those beyond a point's coordinates of 0; by their lowest corners, ascending, each once. */
std::vector<std::uint64_t> cellsAround(std::vector<std::uint64_t> points, Execution& execution);

} // namespace silhouette
