// SPDX-License-Identifier: BSD-3-Clause
/**
 * Labels of lattice points for whoever asks about many near one another: the blocks of 4 x 4 x 4 points asked for last are remembered.
 */
#pragma once

#include "LatticeLabels.h"
#include "SimplePoint.h"

#include <vector>

namespace silhouette
{

/** Not for several threads at once. The labels have to outlive it, and whoever labels a point inside has to say so. */
class LabelCache
{
public:
  explicit LabelCache(const LatticeLabels& labels)
    : Labels(&labels)
    , Remembered(Slots)
  {
  }

  /** LatticeLabels::insideAt() of a point with coordinates of 0 and more. */
  bool insideAt(const LatticePoint& p)
  {
    return this->insideAt(mortonCode(p));
  }

  /** The same by its Morton code. */
  bool insideAt(std::uint64_t code)
  {
    Block& block = this->Remembered[(code >> 6) % Slots];
    if (block.code != code >> 6)
    {
      block = { code >> 6, this->Labels->insideOfBlock(code >> 6) };
    }
    return (block.inside >> (code & 63) & 1) != 0;
  }

  /** Labels of the 27 points around one whose coordinates are 1 and more, by neighbourOf(); its own is false. */
  Neighbourhood insideAround(const LatticePoint& p)
  {
    const CodesAround codes(p);
    Neighbourhood labels;
    for (int n = 0; n < 27; ++n)
    {
      labels[std::size_t(n)] = n != 13 && this->insideAt(codes[n]);
    }
    return labels;
  }

  /** The point of this Morton code is inside now. */
  void setInside(std::uint64_t point)
  {
    Block& block = this->Remembered[(point >> 6) % Slots];
    block.inside |= block.code == point >> 6 ? std::uint64_t(1) << (point & 63) : 0;
  }

private:
  static constexpr std::size_t Slots = 4096;

  struct Block
  {
    std::uint64_t code = ~std::uint64_t(0); ///< no block's
    std::uint64_t inside = 0;
  };

  const LatticeLabels* Labels;
  std::vector<Block> Remembered;
};

} // namespace silhouette
