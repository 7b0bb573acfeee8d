// SPDX-License-Identifier: BSD-3-Clause
/**
 * The least distances over the views' observed silhouettes at the points of a field, a block at a time.
 */
#pragma once

#include "BlockBits.h"
#include "NearViews.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace silhouette
{

/** Sort the distances of a block's `points` into the `rank` least so far, FieldViews::BlockPoints places for each, the least first; `distances` is used up. */
void keepLeast(float* distances, std::size_t points, float* least, int rank);

/**
 * Call `take(block, groups, least)` for each block of the field's of which `concerns(block)` names any groups, perhaps side by side, with its first point's index, these groups and the
 * `rank` least distances of their points, octants, one group's after another's, FieldViews::BlockPoints places for each rank, the least first: the whole reach outside, all of
 * them, at points on the root cube's border. No further view is asked about a block once `isSettled(block, groups, greatest)` holds for the greatest of each point's: they may be greater then
 * than they would be. `views` have to be observed, all of them, on the field's lattice.
 */
template <typename Concerns, typename IsSettled, typename Take>
void forLeastDistances(const BrickField& field, const FieldViews& views, int rank, const Concerns& concerns, const IsSettled& isSettled, const Take& take, Execution& execution)
{
  constexpr std::size_t places = FieldViews::BlockPoints;
  const float far = float(views.reach());
  const auto makeWork = [&]
  {
    return [&, kept = std::vector<float>(std::size_t(rank) * places)](std::size_t block, const BlockGroups& groups, const std::vector<NearView>& near) mutable
    {
      const LatticePoint lowest = fromMorton(field.code(block));
      std::fill(kept.begin(), kept.end(), far);
      const float* const greatest = &kept[std::size_t(rank - 1) * places];
      float distance[places];
      for (std::size_t i = 0; i < near.size() && !isSettled(block, groups, greatest); ++i)
      {
        const auto& [view, region] = near[i];
        if (i + 1 < near.size())
        {
          views.fetch(views.observed(near[i + 1].view), near[i + 1].region);
        }
        views.insideBlock(view, lowest, region, groups, views.observed(view), distance);
        keepLeast(distance, groups.points(), kept.data(), rank);
      }
      const bool atBorder = touchesBorder(views.lattice(), lowest);
      for (std::size_t n = 0; n < groups.points() && atBorder; ++n)
      {
        for (std::size_t k = 0; k < std::size_t(rank) && views.lattice().onBorder(lowest + fromMorton(groups.point(n))); ++k)
        {
          kept[k * places + n] = -far;
        }
      }
      take(block, groups, static_cast<const float*>(kept.data()));
    };
  };
  forBlocks(field, views, nullptr, concerns, makeWork, execution);
}

} // namespace silhouette
