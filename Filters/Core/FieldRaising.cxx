// SPDX-License-Identifier: BSD-3-Clause
#include "FieldRaising.h"

#include "FieldSmoothing.h"
#include "IndicesWhere.h"
#include "LeastDistances.h"

#include <algorithm>
#include <cmath>

namespace silhouette
{
namespace
{

/** Octants: so far inside of the survivors' own surface the field is raised. Nearer few more are covered, and it all stands further out; see method.md. */
constexpr float Margin = 0.1f;
constexpr float LeastWeight = 0.01f; ///< below which nothing is raised

/** Those of some cells all of whose corners have values, none of them a positive one. */
std::vector<std::uint64_t> lostCells(const BrickField& field, const std::vector<std::uint64_t>& cells, Execution& execution)
{
  const auto makeTest = [&]
  {
    return [&, bricks = BrickCursor(field)](std::size_t n) mutable
    {
      const LatticePoint lowest = fromMorton(cells[n]);
      bool isLost = true;
      for (int corner = 0; corner < 8 && isLost; ++corner)
      {
        const std::ptrdiff_t at = bricks.find(mortonCode(lowest + cornerOffset(corner)));
        isLost = at >= 0 && !(field.values()[std::size_t(at)] > 0.0f);
      }
      return isLost;
    };
  };
  return codesWhere(cells, execution, makeTest);
}

/** How much of the raising is done at the points around some cells: 1 at their corners, then ever less. */
class Weights
{
public:
  /** `kernel`: along each axis, its weights at 0, 1, 2, ... octants. */
  Weights(const Lattice& lattice, const std::vector<std::uint64_t>& cells, const std::vector<float>& kernel, Execution& execution)
    : Field(lattice, cells, int(kernel.size()), execution)
  {
    BrickCursor bricks(this->Field);
    for (const std::uint64_t cell : cells)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        this->Field.values()[std::size_t(bricks.find(mortonCode(fromMorton(cell) + cornerOffset(corner))))] = 1.0f;
      }
    }
    FieldSmoother().blur(this->Field, kernel, execution);
    // What is left at the corners of a cell that is alone: nowhere less is left at a lost one's, but for rounding.
    const double alone = double(kernel[0]) + double(kernel[1]);
    this->Gain = float(1.001 / (alone * alone * alone));
  }

  const BrickField& field() const { return this->Field; }

  float at(std::size_t n) const
  {
    const float w = std::min(1.0f, this->Gain * this->Field.values()[n]);
    return w < LeastWeight ? 0.0f : w * w * (3.0f - 2.0f * w);
  }

  /** Where in a block there are any. */
  BlockGroups groups(std::size_t block) const
  {
    const float* const values = &this->Field.values()[block];
    return BlockGroups::where([&](std::size_t n) { return this->Gain * values[n] >= LeastWeight; });
  }

private:
  BrickField Field;
  float Gain;
};

} // namespace

void raiseToSurvivors(BrickField& field, const std::vector<std::uint64_t>& survivors, const FieldViews& views, int backgroundVotes, double width, Execution& execution)
{
  const std::vector<std::uint64_t> lost = lostCells(field, survivors, execution);
  if (lost.empty())
  {
    return;
  }
  const Weights weights(field.lattice(), lost, gaussianKernel(width), execution);
  const auto concerns = [&](std::size_t block) { return field.find(weights.field().code(block)) >= 0 ? weights.groups(block) : BlockGroups(0); };
  const auto valuesOf = [&](std::size_t block) { return &field.values()[std::size_t(field.find(weights.field().code(block)))]; };
  const auto isSettled = [&](std::size_t block, const BlockGroups& groups, const float* greatest)
  {
    const float* const values = valuesOf(block);
    std::size_t n = 0;
    while (n < groups.points() && (greatest[n] - Margin <= values[groups.point(n)] || weights.at(block + groups.point(n)) == 0.0f))
    {
      ++n;
    }
    return n == groups.points();
  };
  const auto raise = [&](std::size_t block, const BlockGroups& groups, const float* least)
  {
    float* const values = valuesOf(block);
    const float* const bound = least + std::size_t(backgroundVotes) * FieldViews::BlockPoints;
    for (std::size_t n = 0; n < groups.points(); ++n)
    {
      const std::size_t point = groups.point(n);
      values[point] += weights.at(block + point) * std::max(0.0f, bound[n] - Margin - values[point]);
    }
  };
  forLeastDistances(weights.field(), views, backgroundVotes + 1, concerns, isSettled, raise, execution);
}

} // namespace silhouette
