// SPDX-License-Identifier: BSD-3-Clause
/**
 * Are two corners near each other through a solid? Asked before anything is joined: what closes a short loop makes a tunnel, what
 * closes a long one mends a handle.
 */
#pragma once

#include "CornerShell.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

/** Are two of the 27 points around a corner, by their numbers, joined by a lattice edge or the diagonal of a lattice square? */
bool isBesideCentre(int n);

class ShellPaths
{
public:
  /** `taken` is told apart from the rest by not being 0, a value for each corner of the shell. Both have to stay while this is used. */
  ShellPaths(const CornerShell& shell, const std::vector<std::uint8_t>& taken);

  /** Is there a way of at most `steps` steps (18-neighbourhood) through taken corners? Cost: the corners within that many steps. */
  bool meet(std::uint32_t a, std::uint32_t b, int steps);

private:
  const CornerShell& Shell;
  const std::vector<std::uint8_t>& Taken;
  std::vector<std::uint32_t> Seen; ///< the last call that met the corner
  std::uint32_t Call = 0;
};

} // namespace silhouette
