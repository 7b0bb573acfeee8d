// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which views have to be asked in which blocks of a field: those whose silhouettes' contours are not out of reach.
 */
#pragma once

#include "BrickField.h"
#include "Execution.h"
#include "FieldViews.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <vector>

namespace silhouette
{

/** A view that says anything but the whole reach in a cube of points, and where it sees the cube. */
struct NearView
{
  int view;
  FieldViews::Region region;
};

/**
 * Of some views those that have to be asked in a cube of `size` lattice points a side, about the observed silhouettes or about `maps`, which may be null: one of
 * each view. Some of them may say the whole reach.
 */
inline void findNear(const FieldViews& views, const LatticePoint& lowest, int size, const std::vector<int>& among,
  const std::vector<DistanceMap>* maps, std::vector<NearView>& near)
{
  near.clear();
  for (const int view : among)
  {
    const FieldViews::Region region = views.region(view, lowest, size);
    if (!views.wholeReach(views.observed(view), region) || (maps && !views.wholeReach((*maps)[std::size_t(view)], region)))
    {
      near.push_back({ view, region });
    }
  }
}

/** Work whose blocks one function names and another one does. */
template <typename Concerned, typename Work>
struct BlockWork
{
  Concerned concerned;
  Work work;

  void operator()(std::size_t block, const BlockGroups& groups, const std::vector<NearView>& near) { this->work(block, groups, near); }
};
template <typename Concerned, typename Work>
BlockWork(Concerned, Work) -> BlockWork<Concerned, Work>;

/**
 * `makeWork()` makes the work of each range of bricks: `work(block, groups, near)` is called for each block of FieldViews::BlockPoints of the field's of which `work.concerned(block)` names any
 * groups, perhaps side by side, with its first point's index, these groups and the views that have to be asked there, ascending. Views that are far from a brick are far from all of its
 * blocks, and are not asked about them.
 */
template <typename MakeWork>
void forBlocks(const BrickField& field, const FieldViews& views, const std::vector<DistanceMap>* maps, const MakeWork& makeWork, Execution& execution)
{
  std::vector<int> all(std::size_t(views.size()));
  std::iota(all.begin(), all.end(), 0);
  execution.forRanges(field.bricks().size(), 1,
    [&](std::size_t firstBrick, std::size_t lastBrick)
    {
      auto work = makeWork();
      std::vector<NearView> near;
      std::vector<int> nearBrick;
      for (std::size_t brick = firstBrick; brick < lastBrick; ++brick)
      {
        bool isBrickKnown = false;
        for (std::size_t block = brick * BrickField::BrickPoints; block < (brick + 1) * BrickField::BrickPoints; block += FieldViews::BlockPoints)
        {
          const BlockGroups groups = work.concerned(block);
          if (groups.empty())
          {
            continue;
          }
          if (!isBrickKnown)
          {
            findNear(views, fromMorton(field.code(brick * BrickField::BrickPoints)), BrickField::BrickSize, all, maps, near);
            nearBrick.clear();
            std::transform(near.begin(), near.end(), std::back_inserter(nearBrick), [](const NearView& one) { return one.view; });
            isBrickKnown = true;
          }
          findNear(views, fromMorton(field.code(block)), FieldViews::BlockSize, nearBrick, maps, near);
          work(block, groups, near);
        }
      }
    });
}

} // namespace silhouette
