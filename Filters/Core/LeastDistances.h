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

/** Sort a block of distances into the `rank` least so far, a block each, the least first; `distances` is used up. */
void keepLeast(float* distances, float* least, int rank);

/**
 * Call `take(block, least)` for each block of the field's for which `concerns(block)` holds, perhaps side by side, with its first point's index and the `rank` least
 * distances of its points, octants, FieldViews::BlockPoints of each, the least first: the whole reach outside, all of them, at points on the root cube's border.
 * No further view is asked about a block once `isSettled(block, greatest)` holds for the greatest of each point's: they may be greater then than they would be. `views` have to be observed, all of them, on the field's
 * lattice.
 */
template <typename Concerns, typename IsSettled, typename Take>
void forLeastDistances(const BrickField& field, const FieldViews& views, int rank, const Concerns& concerns, const IsSettled& isSettled, const Take& take, Execution& execution)
{
  constexpr std::size_t points = FieldViews::BlockPoints;
  const float far = float(views.reach());
  const auto makeWork = [&]
  {
    return [&, kept = std::vector<float>(std::size_t(rank) * points)](std::size_t block, const std::vector<NearView>& near) mutable
    {
      const LatticePoint lowest = fromMorton(field.code(block));
      std::fill(kept.begin(), kept.end(), far);
      const float* const greatest = &kept[std::size_t(rank - 1) * points];
      float distance[points];
      for (std::size_t i = 0; i < near.size() && !isSettled(block, greatest); ++i)
      {
        const auto& [view, region] = near[i];
        if (i + 1 < near.size())
        {
          views.fetch(views.observed(near[i + 1].view), near[i + 1].region);
        }
        views.insideBlock(view, lowest, region, { { views.observed(view), distance } });
        keepLeast(distance, kept.data(), rank);
      }
      const bool atBorder = touchesBorder(views.lattice(), lowest);
      for (std::size_t n = 0; n < kept.size() && atBorder; ++n)
      {
        kept[n] = views.lattice().onBorder(lowest + fromMorton(n % points)) ? -far : kept[n];
      }
      take(block, static_cast<const float*>(kept.data()));
    };
  };
  forBlocks(field, views, nullptr, concerns, makeWork, execution);
}

} // namespace silhouette
