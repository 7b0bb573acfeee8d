// SPDX-License-Identifier: BSD-3-Clause
/**
 * Are two corners near each other through a solid? Asked before anything is joined: what closes a short loop makes a tunnel, what
 * closes a long one mends a handle.
 */
#pragma once

#include "CodeCursor.h"
#include "CornerShell.h"
#include "SimplePoint.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

class ShellPaths
{
public:
  /** `shell` is not copied and has to outlive this. */
  explicit ShellPaths(const CornerShell& shell)
    : Shell(shell)
    , Cursor(shell.corners)
    , Met(shell.corners.size(), 0)
  {
  }

  /**
   * Is there a way of at most `steps` steps (18-neighbourhood) from a to b through corners that `isTaken(corner)` tells apart? It is not asked about a.
   * Cost: the corners within half that many steps of either, or those joined to one of them.
   */
  template <typename IsTaken>
  bool meet(std::uint32_t a, std::uint32_t b, int steps, const IsTaken& isTaken)
  {
    if (a == b || steps < 1 || !isTaken(b))
    {
      return a == b && steps >= 0;
    }
    this->Call += 2; // and one more for what is reached from b
    std::vector<std::uint32_t> ends[2] = { { a }, { b } }, next;
    this->Met[a] = this->Call;
    this->Met[b] = this->Call + 1;
    for (int step = 1; step <= steps && !ends[0].empty() && !ends[1].empty(); ++step)
    {
      const std::uint32_t side = ends[1].size() < ends[0].size() ? 1 : 0;
      next.clear();
      for (const std::uint32_t corner : ends[side])
      {
        const CodesAround codes(fromMorton(this->Shell.corners[corner])); // beyond the lattice they are no corner's
        for (const int n : SolidNeighbours)
        {
          const std::ptrdiff_t found = this->Cursor.find(codes[n]);
          const auto other = std::uint32_t(found);
          if (found < 0 || this->Met[other] == this->Call + side || !isTaken(other))
          {
            continue;
          }
          if (this->Met[other] == this->Call + 1 - side)
          {
            return true;
          }
          this->Met[other] = this->Call + side;
          next.push_back(other);
        }
      }
      ends[side].swap(next);
    }
    return false;
  }

private:
  const CornerShell& Shell;
  CodeCursor Cursor;
  std::vector<std::uint32_t> Met; ///< the last call that met the corner, and from which end
  std::uint32_t Call = 0;
};

} // namespace silhouette
