// SPDX-License-Identifier: BSD-3-Clause
/**
 * The least distances over the views' observed silhouettes at the points of a field, a block at a time.
 */
#pragma once

#include "BlockBits.h"
#include "NearViews.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace silhouette
{

/** Sort the distances of a block's `points` into the `rank` least so far, FieldViews::BlockPoints places for each, the least first; `distances` is used up. */
void keepLeast(float* distances, std::size_t points, float* least, int rank);

/** What is asked about blocks, by functions that may be called side by side: see forLeastDistances(). */
template <typename Concerned, typename Settled, typename Take>
struct BlockQuestions
{
  Concerned concerned;
  Settled settled;
  Take take;
};
template <typename Concerned, typename Settled, typename Take>
BlockQuestions(Concerned, Settled, Take) -> BlockQuestions<Concerned, Settled, Take>;

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
    , Use(std::size_t(views.size()), 0.0f)
  {
  }

  BlockGroups concerned(std::size_t block) { return this->Asked.concerned(block); }

  void operator()(std::size_t block, const BlockGroups& groups, const std::vector<NearView>& near)
  {
    const LatticePoint lowest = fromMorton(this->Field.code(block));
    std::fill(this->Kept.begin(), this->Kept.end(), float(this->Views.reach()));
    const float* const greatest = &this->Kept[(this->Rank - 1) * Places];
    float distance[Places];
    std::size_t settled = this->Asked.settled(block, groups, 0, greatest);
    if (settled < groups.points())
    {
      this->order(near);
    }
    for (std::size_t i = 0; i < near.size() && settled < groups.points(); ++i)
    {
      const auto& [view, region] = near[this->Order[i]];
      if (i + 1 < near.size())
      {
        const NearView& next = near[this->Order[i + 1]];
        this->Views.fetch(this->Views.observed(next.view), next.region);
      }
      this->Views.insideBlock(view, lowest, region, groups, this->Views.observed(view), distance);
      keepLeast(distance, groups.points(), this->Kept.data(), int(this->Rank));
      const std::size_t before = settled;
      settled = this->Asked.settled(block, groups, before, greatest);
      this->Use[std::size_t(view)] += Forgetting * (float(settled - before) - this->Use[std::size_t(view)]);
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
  static constexpr float Forgetting = 0.25f;

  /** The views that have settled most of late come first, a few of them. */
  void order(const std::vector<NearView>& near)
  {
    constexpr std::size_t few = 4;
    this->Order.resize(near.size());
    std::iota(this->Order.begin(), this->Order.end(), std::uint32_t(0));
    for (std::size_t first = 0; first < std::min(few, near.size()); ++first)
    {
      const auto least = [&](std::uint32_t a, std::uint32_t b) { return this->Use[std::size_t(near[a].view)] < this->Use[std::size_t(near[b].view)]; };
      std::iter_swap(this->Order.begin() + std::ptrdiff_t(first), std::max_element(this->Order.begin() + std::ptrdiff_t(first), this->Order.end(), least));
    }
  }

  const BrickField& Field;
  const FieldViews& Views;
  std::size_t Rank;
  Questions Asked;
  std::vector<float> Kept; ///< the least so far, Places for each rank
  std::vector<float> Use;  ///< of each view: points that it has settled of late
  std::vector<std::uint32_t> Order; ///< in which a block's views are asked
};

/**
 * `makeQuestions()` makes what is asked about each range of bricks, perhaps side by side: `take(block, groups, least)` is called for each block of the field's of which `concerned(block)` names
 * any groups, with its first point's index, these groups and the `rank` least distances of their points, octants, one group's after another's, FieldViews::BlockPoints places for each rank, the
 * least first: the whole reach outside, all of them, at points on the root cube's border. `settled(block, groups, from, greatest)`
 * tells the first of their points, from the `from`-th on, for which the greatest does not suffice, and how many points there are where there is none: then no further view is asked about the
 * block, and the distances may be greater than they would be. A point that suffices has to go on sufficing as the greatest falls. `views` have to be observed, all of them, on the field's lattice.
 */
template <typename MakeQuestions>
void forLeastDistances(const BrickField& field, const FieldViews& views, int rank, const MakeQuestions& makeQuestions, Execution& execution)
{
  forBlocks(field, views, nullptr, [&] { return LeastOfBlocks(field, views, rank, makeQuestions()); }, execution);
}

} // namespace silhouette
