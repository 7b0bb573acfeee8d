// SPDX-License-Identifier: BSD-3-Clause
/**
 * The octants that touch a lattice point, for many points in the order of the lattice.
 */
#pragma once

#include "CornerShell.h"

#include <array>
#include <cstdint>

namespace silhouette
{

/** One for each cell around a corner: going through corners in Morton order, each stays in the same octants for long. */
using CursorsAround = std::array<OctantCursor, 8>;

CursorsAround cursorsAround(const Octree& octree);

/**
 * Of the cells around a point that are no intersection octants, those that tell of all. Where an octree is carved inside and background octants share no
 * point, so that what meets across faces has one state; and in that state it has been joined, unless some of it is refuted or an octree has no octant
 * there.
 */
std::uint8_t tellingCells(std::uint8_t intersection);

/** Has the octree all its trees? */
bool isWhole(const Octree& octree);

/**
 * Call `meet(location)` for the octants of one state that touch a lattice point, of those in the `asked` cells around it, a bit each; returns
 * which of these have another state. Cells of one parent are looked for once.
 */
template <typename Meet>
std::uint8_t forOctantsAround(
  CursorsAround& octants, const Octree& octree, std::uint64_t corner, std::uint8_t asked, OctantState state, const Meet& meet)
{
  const Lattice& lattice = octree.lattice;
  std::uint8_t others = 0;
  if (asked == 0)
  {
    return others;
  }
  const LatticePoint p = fromMorton(corner);
  const bool onBorder = lattice.onBorder(p);
  const unsigned odd = unsigned(corner & 7); // on these axes the cells on either side have one parent
  std::array<Octree::Location, 8> firsts;
  unsigned known = 0;
  for (unsigned n = 0; n < 8; ++n)
  {
    if ((asked >> n & 1) == 0)
    {
      continue;
    }
    const unsigned first = n | odd;
    if (!(known >> first & 1))
    {
      known |= 1u << first;
      const LatticePoint o = cornerOffset(int(first));
      const LatticePoint cell{ p.i - o.i, p.j - o.j, p.k - o.k };
      firsts[first] = onBorder ? octants[first].locate(cell) : octants[first].locate(mortonCode(cell));
    }
    Octree::Location location = firsts[first];
    if (location.generation == lattice.depth)
    {
      location.index += first & ~n;
      location.state = octree.last().state[location.index];
    }
    if (location.generation >= 0 && location.state == state)
    {
      meet(location);
    }
    else if (location.generation >= 0)
    {
      others |= std::uint8_t(1u << n);
    }
  }
  return others;
}

/**
 * Call `worker(corner, cursors)` for every corner of the shell, perhaps side by side, with cursors for the cells around it; each range by a worker that
 * `makeWorker` makes.
 */
template <typename MakeWorker>
void forCorners(const Octree& octree, const CornerShell& shell, Execution& execution, const MakeWorker& makeWorker)
{
  execution.forRanges(shell.corners.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      CursorsAround octants = cursorsAround(octree);
      auto work = makeWorker();
      for (std::size_t c = first; c < last; ++c)
      {
        work(c, octants);
      }
    });
}

} // namespace silhouette
