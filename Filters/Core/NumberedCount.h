// SPDX-License-Identifier: BSD-3-Clause
/**
 * Guards what is numbered by 32 bits, with a sign or without: corners, octants, triangles.
 */
#pragma once

#include "Error.h"

#include <cstddef>
#include <string>

namespace silhouette
{

/** `count`; throws InvalidInput where there are more than numbers of 31 bits tell apart. */
inline std::size_t numberedCount(std::size_t count, const char* what)
{
  constexpr std::size_t most = 0x7fffffff;
  if (count > most)
  {
    throw InvalidInput(std::to_string(count) + " " + what + " are more than 2^31 - 1; a piece of the lattice, or a smaller depth, has fewer");
  }
  return count;
}

} // namespace silhouette
