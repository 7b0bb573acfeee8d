// SPDX-License-Identifier: BSD-3-Clause
/**
 * A field on lattice points, kept in bricks of 8 x 8 x 8 points where it is needed: a band around a surface.
 */
#pragma once

#include "Execution.h"
#include "Lattice.h"
#include "Mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace silhouette
{

/**
 * Morton codes, ascending, of the bricks that hold a point within `margin` octants of one of the given leaf cells (Morton codes). Cost: near-linear in
 * the cells, least where neighbours follow one another.
 */
std::vector<std::uint64_t> bricksAround(
  const Lattice& lattice, const std::vector<std::uint64_t>& cells, int margin, Execution& execution);

/** Values in octants, positive inside, in Morton order of the points. */
class BrickField
{
public:
  static constexpr int BrickSize = 8;
  static constexpr std::size_t BrickPoints = 512;

  BrickField() = default;
  /** In bricksAround(), 0 everywhere. */
  BrickField(const Lattice& lattice, const std::vector<std::uint64_t>& cells, int margin, Execution& execution);

  const Lattice& lattice() const { return this->TheLattice; }
  /** Morton codes of the bricks, ascending; a brick's points have the codes 512 b to 512 b + 511. */
  const std::vector<std::uint64_t>& bricks() const { return this->Bricks; }
  std::vector<float>& values() { return this->Values; }
  const std::vector<float>& values() const { return this->Values; }
  std::size_t size() const { return this->Values.size(); }
  /** Morton code of the n-th point. It may lie beyond the lattice, by less than a brick. */
  std::uint64_t code(std::size_t n) const { return this->Bricks[n / BrickPoints] * BrickPoints + n % BrickPoints; }
  /** Give up the bricks, in their order, that are marked 0. */
  void keepBricks(const std::vector<std::uint8_t>& keep);
  /** Index of a brick, or -1. */
  std::ptrdiff_t findBrick(std::uint64_t brick) const;
  /** Index of a point, or -1. */
  std::ptrdiff_t find(std::uint64_t point) const;

  /** Codes of the leaf cells that have corners of both signs, ascending; a value of 0 is outside, and so is every point on the root cube's border. */
  std::vector<std::uint64_t> mixedCells(Execution& execution) const;
  /** The surface where the field is 0, by marching cubes with linear interpolation. */
  Mesh contourMesh(Execution& execution) const;

private:
  Lattice TheLattice;
  std::vector<std::uint64_t> Bricks;
  std::vector<float> Values;
};

/**
 * BrickField::find() for points near one another: the bricks found last are remembered, 64: a brick and all around it have places of their
 * own. Not for several threads at once. The field has to outlive it.
 */
class BrickCursor
{
public:
  explicit BrickCursor(const BrickField& field)
    : Field(&field)
  {
    this->Brick.fill(~std::uint64_t(0));
  }

  std::ptrdiff_t find(std::uint64_t point)
  {
    const std::uint64_t brick = point / BrickField::BrickPoints;
    const std::size_t slot = brick % this->Brick.size(); // by its coordinates' two lowest bits
    if (this->Brick[slot] != brick)
    {
      this->Brick[slot] = brick;
      this->Index[slot] = this->Field->findBrick(brick);
    }
    const std::ptrdiff_t index = this->Index[slot];
    return index < 0 ? -1 : index * std::ptrdiff_t(BrickField::BrickPoints) + std::ptrdiff_t(point % BrickField::BrickPoints);
  }

private:
  const BrickField* Field;
  std::array<std::uint64_t, 64> Brick;
  std::array<std::ptrdiff_t, 64> Index{};
};

} // namespace silhouette
