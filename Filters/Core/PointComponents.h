// SPDX-License-Identifier: BSD-3-Clause
/**
 * Connected components of lattice points.
 */
#pragma once

#include "BlockSteps.h"
#include "BlockWords.h"
#include "PointCubes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Points and cubes that meet; both ascending. */
struct PointComponent
{
  std::vector<BlockWord> words; ///< the points, but those within the cubes; of a block one
  std::vector<PointCube> cubes;
  std::uint64_t size = 0; ///< points, those within the cubes among them

  /** The lowest code of a point. */
  std::uint64_t first() const
  {
    const bool isPoint = !this->words.empty() && (this->cubes.empty() || this->words.front().block < this->cubes.front().corner >> 6);
    return isPoint ? 64 * this->words.front().block + std::uint64_t(lowestBit(this->words.front().bits)) : this->cubes.front().corner;
  }
};

/**
 * Those components of the points of `words` (of a block one, none without points) and `cubes` (both ascending, no block in both) that have `least` points or more. Points are joined that are
 * neighbours by `steps`. Cost: linear in the points, and in the cubes whatever they hold; what is looked for is blocks of 4 x 4 x 4 and cubes.
 */
std::vector<PointComponent> pointComponents(const std::vector<BlockWord>& words, const std::vector<PointCube>& cubes, Steps steps, std::size_t least);

} // namespace silhouette
