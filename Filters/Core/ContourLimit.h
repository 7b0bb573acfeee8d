// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far apart two contours may be and yet be each other's: what the field corrects, and what a carving need not keep for it.
 */
#pragma once

#include "Lattice.h"

#include <algorithm>

namespace silhouette
{

constexpr double ThoughtOutAt = 128.0; ///< cells a side of the lattice that lengths in octants are stated for
constexpr double ContourLimit = 3.0;   ///< octants times lengthScale(): contours that are further apart are not each other's

/** How many octants stand for one of the lattice that lengths are stated for; 1 at least, since nothing is told within an octant. */
inline double lengthScale(const Lattice& lattice)
{
  return std::max(1.0, lattice.cells() / ThoughtOutAt);
}

} // namespace silhouette
