// SPDX-License-Identifier: BSD-3-Clause
/**
 * How much of a field's raising is done where (FieldRaising.h): 1 at the corners of some cells, then ever less, as a Gaussian falls off.
 */
#pragma once

#include "BlockGroups.h"
#include "BrickField.h"
#include "Execution.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

constexpr double WidestRaising = 8.0; ///< octants: a window of bits is a word wide

class RaisingWeights
{
public:
  /**
   * `cells`: Morton codes of leaf cells; `width`: octants, above 0 and up to WidestRaising, the standard deviation of the Gaussian, which ends at three of them. Memory: 72 bytes a brick
   * that holds corners of the cells.
   */
  RaisingWeights(const std::vector<std::uint64_t>& cells, double width, Execution& execution);

  /** For each of the field's bricks, 1 where there may be weights above 0. */
  std::vector<std::uint8_t> near(const BrickField& field) const;

  /** The weights in one brick after another, of one thread. What it was made of has to outlive it. */
  class Brick
  {
  public:
    explicit Brick(const RaisingWeights& weights);

    /** Cost: 3 (8 + 6 width)^2 sums of eight values, about; none where it is there already. */
    void moveTo(std::uint64_t brick);
    /** At the n-th point of the brick, 0 to 1; nothing between 0 and some 3e-4. */
    float at(std::size_t n) const { return this->Weights[n]; }
    /** Where in the block that begins at its n-th point there are any. */
    BlockGroups groups(std::size_t n) const
    {
      return BlockGroups::where([&](std::size_t point) { return this->Weights[n + point] > 0.0f; });
    }

  private:
    void collect();

    const RaisingWeights& All;
    std::uint64_t Code = ~std::uint64_t(0);
    std::vector<std::uint64_t> Rows;  ///< of the window around the brick, a bit a point
    std::vector<float> Along, Across; ///< sums along the first axis, and along the second too
    std::array<float, BrickField::BrickPoints> Weights{}; ///< in Morton order
  };

private:
  static constexpr int Side = BrickField::BrickSize;
  using Bits = std::array<std::uint8_t, std::size_t(Side* Side)>; ///< of a brick's points: for each row along the first axis a bit each

  const Bits* bitsOf(std::uint64_t brick) const;

  std::vector<float> Kernel;          ///< at 0, 1, 2, ... octants
  std::vector<float> Steps;           ///< for each place in a window's row what a corner there gives to the eight points of the brick's
  int Radius;                         ///< octants
  float Gain;                         ///< to 1 at the corners of a cell that is alone
  std::vector<std::uint64_t> Bricks;  ///< that hold corners, ascending
  std::vector<Bits> Corners;          ///< of each
};

} // namespace silhouette
