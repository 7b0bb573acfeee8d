// SPDX-License-Identifier: BSD-3-Clause
/**
 * The votes of a shell's corners, from what the carving already knows: a view that is settled for an octant need not
 * be asked about its corners and edges.
 */
#pragma once

#include "CornerShell.h"
#include "PreparedViews.h"

namespace silhouette
{

/** Whom to ask about each cell of a shell. Octree, shell and views have to outlive it. */
class CellViews
{
public:
  /** Where the octree was carved from other views than these, or does not know any more, all of them are asked. */
  CellViews(const Octree& octree, const CornerShell& shell, const LatticeViews& views, Execution& execution);

  ViewsToAsk operator[](std::size_t cell) const
  {
    const std::uint32_t parent = this->Parents.empty() ? Unknown : this->Parents[cell].rank;
    if (parent == Unknown)
    {
      return { this->All.data(), this->All.size(), 0, false };
    }
    const UndecidedViews& undecided = this->Source->undecided;
    const std::size_t first = undecided.first[parent];
    return { undecided.views.data() + first, undecided.first[parent + 1] - first, undecided.backgroundVotes[parent],
      undecided.seen[parent] != 0, this->Parents[cell].among };
  }

private:
  static constexpr std::uint32_t Unknown = 0xffffffffu;

  struct Parent
  {
    std::uint32_t rank = Unknown;  ///< among the intersection octants
    std::uint16_t among = 0xffff; ///< which of its views need be asked about the cell
  };

  const Octree* Source;
  std::vector<std::uint16_t> All;
  std::vector<Parent> Parents; ///< of each cell; or nothing
};

/**
 * LatticeViews::insideVotes of all corners of the shell. Cost: a look-up for each corner and view that is undecided
 * about the parent of a cell at that corner.
 */
std::vector<std::uint16_t> cornerVotes(
  const CornerShell& shell, const CellViews& cellViews, const LatticeViews& views, Execution& execution);

} // namespace silhouette
