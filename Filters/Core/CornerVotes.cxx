// SPDX-License-Identifier: BSD-3-Clause
#include "CornerVotes.h"

#include "FirstTouch.h"
#include "LargePages.h"
#include "LeastNumbers.h"

#include <algorithm>
#include <numeric>

namespace silhouette
{

LeafViews::LeafViews(const Octree& octree, const LatticeViews& views)
  : Source(octree.undecided.first.empty() || octree.fingerprint != views.prepared().fingerprint() ? nullptr : &octree)
  , All(std::size_t(views.size()))
{
  std::iota(this->All.begin(), this->All.end(), std::uint16_t(0));
}

ViewsToAsk LeafViews::around(const LatticePoint& p, OctantCursor& octants) const
{
  for (int n = 0; n < 8 && this->isKnown() && this->Source->backgroundVotes == 0; ++n)
  {
    const LatticePoint o = cornerOffset(n);
    const auto octant = octants.locate(LatticePoint{ p.i - o.i, p.j - o.j, p.k - o.k });
    if (octant.generation == this->Source->lattice.depth && octant.state == OctantState::Intersection)
    {
      return (*this)[octant.index];
    }
  }
  return this->all();
}

CellViews::CellViews(
  const Octree& octree, const CornerShell& shell, const LatticeViews& views, Execution& execution)
  : Views(octree, views)
{
  if (!this->Views.isKnown())
  {
    return;
  }
  const Generation& parents = octree.generations[std::size_t(octree.lattice.depth) - 1];
  resizeSideBySide(this->Leaves, shell.cells.size(), execution);
  execution.forRanges(shell.cells.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      auto at = std::lower_bound(parents.code.begin(), parents.code.end(), shell.cells[first] >> 3);
      for (std::size_t cell = first; cell < last; ++cell)
      {
        const std::uint64_t code = shell.cells[cell] >> 3;
        while (at != parents.code.end() && *at < code)
        {
          ++at;
        }
        const auto parent = std::size_t(at - parents.code.begin());
        const bool isThere = at != parents.code.end() && *at == code && parents.state[parent] == OctantState::Intersection;
        this->Leaves[cell] = isThere ? std::uint32_t(8 * std::size_t(parents.childBlock[parent]) + (shell.cells[cell] & 7)) : Unknown;
      }
    });
}

std::vector<std::uint16_t> cornerVotes(
  const CornerShell& shell, const CellViews& cellViews, const LatticeViews& views, Execution& execution)
{
  LeastNumbers lowestCell(shell.corners.size(), execution);
  execution.forRanges(shell.cells.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t cell = first; cell < last; ++cell)
      {
        for (const std::uint32_t corner : shell.cellCorners[cell])
        {
          lowestCell.lower(corner, std::uint32_t(cell));
        }
      }
    });
  auto votes = largeVector<std::uint16_t>(shell.corners.size());
  constexpr std::size_t Steps = 16;
  for (std::size_t step = 0; step < Steps; ++step)
  {
    const std::size_t from = votes.size() * step / Steps, to = votes.size() * (step + 1) / Steps;
    execution.forRanges(to - from, 1024,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t c = from + first; c < from + last; ++c)
        {
          votes[c] =
            std::uint16_t(views.insideVotes(fromMorton(shell.corners[c]), cellViews[lowestCell[c]]));
        }
      });
    execution.checkpoint(double(step + 1) / Steps);
  }
  return votes;
}

} // namespace silhouette
