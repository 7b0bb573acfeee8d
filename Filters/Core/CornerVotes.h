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

/** Whom to ask about the octants of the last generation. Octree and views have to outlive it. */
class LeafViews
{
public:
  /** Where the octree was carved from other views than these, or does not know any more, all of them are asked. */
  LeafViews(const Octree& octree, const LatticeViews& views);

  bool isKnown() const { return this->Source != nullptr; }
  ViewsToAsk all() const { return { this->All.data(), this->All.size(), 0, false }; }
  /** Of an octant, by its index, if it is known. */
  ViewsToAsk operator[](std::size_t leaf) const
  {
    const UndecidedViews& undecided = this->Source->undecided;
    const std::size_t parent = leaf / 8, first = undecided.first[parent];
    // Where nobody else is known to see the octant, those that look away from it must not go unheard. Of a carved one the views after the one that
    // carved it were not asked.
    const bool choose = undecided.seen[parent] != 0 && this->Source->backgroundVotes == 0 &&
      this->Source->last().state[leaf] != OctantState::Background;
    return { undecided.views.data() + first, undecided.first[parent + 1] - first, undecided.backgroundVotes[parent], undecided.seen[parent] != 0,
      choose ? undecided.among[leaf] : std::uint16_t(0xffff) };
  }
  /**
   * Who may call a lattice point background: all, unless it is a corner of a surviving octant that no view may dissent from and it is known who is
   * undecided about that; the others call it object, or say nothing.
   */
  ViewsToAsk around(const LatticePoint& p, OctantCursor& octants) const;

private:
  const Octree* Source; ///< or nothing
  std::vector<std::uint16_t> All;
};

/** Whom to ask about each cell of a shell. Octree, shell and views have to outlive it. */
class CellViews
{
public:
  CellViews(const Octree& octree, const CornerShell& shell, const LatticeViews& views, Execution& execution);

  ViewsToAsk operator[](std::size_t cell) const
  {
    const std::uint32_t leaf = this->Leaves.empty() ? Unknown : this->Leaves[cell];
    return leaf == Unknown ? this->Views.all() : this->Views[leaf];
  }

private:
  static constexpr std::uint32_t Unknown = 0xffffffffu;

  LeafViews Views;
  std::vector<std::uint32_t> Leaves; ///< of each cell its octant of the last generation; or nothing
};

/**
 * LatticeViews::insideVotes of all corners of the shell. Cost: a look-up for each corner and view that is undecided
 * about the parent of a cell at that corner.
 */
std::vector<std::uint16_t> cornerVotes(
  const CornerShell& shell, const CellViews& cellViews, const LatticeViews& views, Execution& execution);

/**
 * cornerVotes() of the shell of an octree's intersection octants. For the octree's own views they are counted once: `count()` is asked only where they are
 * not known.
 */
template <typename Count>
KnownVotes::Votes octreeVotes(const Octree& octree, const CornerShell& intersection, const LatticeViews& views, const Count& count)
{
  const bool isOwn = octree.fingerprint == views.prepared().fingerprint();
  KnownVotes::Votes votes = isOwn ? octree.votes.get() : nullptr;
  if (!votes || votes->size() != intersection.corners.size())
  {
    votes = std::make_shared<const std::vector<std::uint16_t>>(count());
    if (isOwn)
    {
      octree.votes.set(votes);
    }
  }
  return votes;
}

} // namespace silhouette
