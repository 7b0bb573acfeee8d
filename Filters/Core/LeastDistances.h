// SPDX-License-Identifier: BSD-3-Clause
/**
 * The least distances over the views' observed silhouettes at the points of a field, a block at a time.
 */
#pragma once

#include "BlockBits.h"
#include "NearViews.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace silhouette
{

/** Sort the distances of a block's `points` into the `rank` least so far, FieldViews::BlockPoints places for each, the least first; `distances` is used up. */
void keepLeast(float* distances, std::size_t points, float* least, int rank);

/** What is asked about blocks, by functions that may be called side by side: see forLeastDistances(). */
template <typename Concerned, typename IsSettled, typename Take>
struct BlockQuestions
{
  Concerned concerned;
  IsSettled isSettled;
  Take take;
};
template <typename Concerned, typename IsSettled, typename Take>
BlockQuestions(Concerned, IsSettled, Take) -> BlockQuestions<Concerned, IsSettled, Take>;

/** The work of forLeastDistances() on some blocks. */
template <typename Questions>
class LeastOfBlocks
{
public:
  LeastOfBlocks(const BrickField& field, const FieldViews& views, int rank, Questions questions)
    : Field(field)
    , Views(views)
    , Rank(std::size_t(rank))
    , Asked(std::move(questions))
    , Kept(std::size_t(rank) * Places)
  {
  }

  BlockGroups concerned(std::size_t block) { return this->Asked.concerned(block); }

  void operator()(std::size_t block, const BlockGroups& groups, const std::vector<NearView>& near)
  {
    const LatticePoint lowest = fromMorton(this->Field.code(block));
    std::fill(this->Kept.begin(), this->Kept.end(), float(this->Views.reach()));
    const float* const greatest = &this->Kept[(this->Rank - 1) * Places];
    float distance[Places];
    for (std::size_t i = 0; i < near.size() && !this->Asked.isSettled(block, groups, greatest); ++i)
    {
      const auto& [view, region] = near[i];
      if (i + 1 < near.size())
      {
        this->Views.fetch(this->Views.observed(near[i + 1].view), near[i + 1].region);
      }
      this->Views.insideBlock(view, lowest, region, groups, this->Views.observed(view), distance);
      keepLeast(distance, groups.points(), this->Kept.data(), int(this->Rank));
    }
    const bool atBorder = touchesBorder(this->Views.lattice(), lowest);
    for (std::size_t n = 0; n < groups.points() && atBorder; ++n)
    {
      for (std::size_t k = 0; k < this->Rank && this->Views.lattice().onBorder(lowest + fromMorton(groups.point(n))); ++k)
      {
        this->Kept[k * Places + n] = -float(this->Views.reach());
      }
    }
    this->Asked.take(block, groups, static_cast<const float*>(this->Kept.data()));
  }

private:
  static constexpr std::size_t Places = FieldViews::BlockPoints;

  const BrickField& Field;
  const FieldViews& Views;
  std::size_t Rank;
  Questions Asked;
  std::vector<float> Kept; ///< the least so far, Places for each rank
};

/**
 * `makeQuestions()` makes what is asked about each range of bricks, perhaps side by side: `take(block, groups, least)` is called for each block of the field's of which `concerned(block)` names
 * any groups, with its first point's index, these groups and the `rank` least distances of their points, octants, one group's after another's, FieldViews::BlockPoints places for each rank, the
 * least first: the whole reach outside, all of them, at points on the root cube's border. No further view is asked about a block once `isSettled(block, groups, greatest)` holds for the
 * greatest of each point's: they may be greater then than they would be. `views` have to be observed, all of them, on the field's lattice.
 */
template <typename MakeQuestions>
void forLeastDistances(const BrickField& field, const FieldViews& views, int rank, const MakeQuestions& makeQuestions, Execution& execution)
{
  forBlocks(field, views, nullptr, [&] { return LeastOfBlocks(field, views, rank, makeQuestions()); }, execution);
}

} // namespace silhouette
