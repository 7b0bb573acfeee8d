// SPDX-License-Identifier: BSD-3-Clause
#include "FieldRaising.h"

#include "IndicesWhere.h"
#include "LeastDistances.h"
#include "RaisingWeights.h"

#include <algorithm>
#include <cstddef>

namespace silhouette
{
namespace
{

/** Octants: so far inside of the survivors' own surface the field is raised. Nearer few more are covered, and it all stands further out; see method.md. */
constexpr float Margin = 0.1f;

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

/** What is asked about the blocks of some bricks, and their raising. */
class Raising
{
public:
  Raising(BrickField& field, const RaisingWeights& weights, const std::vector<std::uint8_t>& near, int backgroundVotes)
    : Field(field)
    , Near(near)
    , Weights(weights)
    , Bound(std::size_t(backgroundVotes) * FieldViews::BlockPoints)
  {
  }

  BlockGroups concerned(std::size_t block)
  {
    const std::size_t brick = block / BrickField::BrickPoints;
    if (this->Near[brick] == 0)
    {
      return BlockGroups(0);
    }
    this->Weights.moveTo(this->Field.bricks()[brick]);
    return this->Weights.groups(block % BrickField::BrickPoints);
  }

  std::size_t settled(std::size_t block, const BlockGroups& groups, std::size_t from, const float* greatest) const
  {
    const float* const values = &this->Field.values()[block];
    std::size_t n = from;
    while (n < groups.points() && (greatest[n] - Margin <= values[groups.point(n)] || this->weight(block, groups.point(n)) == 0.0f))
    {
      ++n;
    }
    return n;
  }

  void take(std::size_t block, const BlockGroups& groups, const float* least)
  {
    float* const values = &this->Field.values()[block];
    for (std::size_t n = 0; n < groups.points(); ++n)
    {
      const std::size_t point = groups.point(n);
      values[point] += this->weight(block, point) * std::max(0.0f, least[this->Bound + n] - Margin - values[point]);
    }
  }

private:
  float weight(std::size_t block, std::size_t point) const { return this->Weights.at(block % BrickField::BrickPoints + point); }

  BrickField& Field;
  const std::vector<std::uint8_t>& Near;
  RaisingWeights::Brick Weights;
  std::size_t Bound; ///< of the least distances, where those begin that the field is raised to
};

} // namespace

void raiseToSurvivors(BrickField& field, const std::vector<std::uint64_t>& survivors, const FieldViews& views, int backgroundVotes, double width, Execution& execution)
{
  const std::vector<std::uint64_t> lost = lostCells(field, survivors, execution);
  if (lost.empty())
  {
    return;
  }
  const RaisingWeights weights(lost, width, execution);
  const std::vector<std::uint8_t> near = weights.near(field);
  forLeastDistances(field, views, backgroundVotes + 1, [&] { return Raising(field, weights, near, backgroundVotes); }, execution);
}

} // namespace silhouette
