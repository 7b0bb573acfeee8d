// SPDX-License-Identifier: BSD-3-Clause
#include "RejectedCorners.h"

#include "CornerVotes.h"
#include "IndicesWhere.h"
#include "LatticeLabels.h"
#include "PointBlocks.h"
#include "SilhouetteDissent.h"

#include <algorithm>
#include <numeric>

namespace silhouette
{
namespace
{

/** Append those of `corners` that one view alone rejects. */
void appendRejected(const LatticeViews& views, const std::vector<std::uint64_t>& corners,
                    std::vector<Rejected>& rejected, Execution& execution)
{
  std::vector<std::int32_t> dissenter(corners.size());
  execution.forRanges(corners.size(), 1024,
                      [&](std::size_t first, std::size_t last)
                      {
                        OnlyDissenter only(views);
                        for (std::size_t i = first; i < last; ++i)
                        {
                          dissenter[i] = only.at(fromMorton(corners[i]));
                        }
                      });
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (dissenter[i] >= 0)
    {
      rejected.push_back({corners[i], dissenter[i]});
    }
  }
}

/** Number of views that never abstain within the root cube. */
int viewsThatSpeak(const LatticeViews& views)
{
  int count = 0;
  const std::int32_t n = views.lattice().cells();
  for (int i = 0; i < views.size(); ++i)
  {
    const auto& open = views.view(i).open;
    bool speaks = std::none_of(open.begin(), open.end(), [](bool side) { return side; });
    for (int c = 0; c < 8; ++c)
    {
      const LatticePoint o = cornerOffset(c);
      const LatticeProjection& projection = views.projection(i);
      speaks = speaks && projection({n * o.i, n * o.j, n * o.k}).W > projection.minimumDepth;
    }
    count += speaks;
  }
  return count;
}

/** The same of corners of the octree's surviving octants, each of which one of its own views calls background. */
void appendRejectedOnce(const Octree& octree, const LatticeViews& views, const std::vector<std::uint64_t>& corners,
                        std::vector<Rejected>& rejected, Execution& execution)
{
  const LeafViews undecided(octree, views);
  // Then half of them call such a corner object.
  if (!undecided.isKnown() || 2 * (viewsThatSpeak(views) - 1) < views.size())
  {
    appendRejected(views, corners, rejected, execution);
    return;
  }
  rejected.resize(corners.size());
  execution.forRanges(corners.size(), 1024,
                      [&](std::size_t first, std::size_t last)
                      {
                        OctantCursor octants(octree);
                        for (std::size_t i = first; i < last; ++i)
                        {
                          const LatticePoint p = fromMorton(corners[i]);
                          rejected[i].corner = corners[i];
                          undecided.around(p, octants)
                              .forEach(
                                  [&](int view)
                                  {
                                    if (rejected[i].view < 0 && views.vote(view, p) == Vote::Background)
                                    {
                                      rejected[i].view = view;
                                    }
                                  });
                        }
                      });
  rejected.erase(std::remove_if(rejected.begin(), rejected.end(), [](const Rejected& one) { return one.view < 0; }), rejected.end());
}

/** The shell's corners that one view may alone reject: all where the octree was carved from other views; else `votes` are found as well. */
std::vector<std::uint64_t> onceDisputed(const Octree& octree, const LatticeViews& views, const CornerShell& shell,
                                        KnownVotes::Votes& votes, Execution& execution)
{
  if (octree.fingerprint != views.prepared().fingerprint())
  {
    return shell.corners;
  }
  votes = octreeVotes(octree, shell, views, [&] { return shellVotes(octree, shell, views, execution); });
  return selected(
    votes->size(), [&](std::size_t c) { return int((*votes)[c]) == views.size() - 1; }, [&](std::size_t c) { return shell.corners[c]; }, execution);
}

/** Sorted by view, then by code. */
std::vector<Rejected> byView(const std::vector<Rejected>& rejected, int views, Execution& execution)
{
  std::vector<std::size_t> end(std::size_t(views) + 1, 0);
  for (const Rejected& one : rejected)
  {
    ++end[std::size_t(one.view) + 1];
  }
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::size_t> next(end.begin(), end.end() - 1);
  std::vector<Rejected> sorted(rejected.size());
  for (const Rejected& one : rejected)
  {
    sorted[next[std::size_t(one.view)]++] = one;
  }
  execution.forRanges(std::size_t(views), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t view = first; view < last; ++view)
                        {
                          std::sort(sorted.begin() + std::ptrdiff_t(end[view]), sorted.begin() + std::ptrdiff_t(end[view + 1]),
                                    [](const Rejected& a, const Rejected& b) { return a.corner < b.corner; });
                        }
                      });
  return sorted;
}

} // namespace

std::vector<Rejected> findRejected(const Octree& octree, const LatticeViews& views, const CornerShell& shell,
                                   KnownVotes::Votes& votes, Execution& execution)
{
  std::vector<Rejected> rejected;
  const std::vector<std::uint64_t> first = onceDisputed(octree, views, shell, votes, execution);
  votes ? appendRejectedOnce(octree, views, first, rejected, execution) : appendRejected(views, first, rejected, execution);
  PointBlocks before, now(shell.corners, execution);
  for (std::size_t done = 0; done < rejected.size();)
  {
    execution.checkpoint(0.0);
    std::vector<std::uint64_t> latest;
    for (; done < rejected.size(); ++done)
    {
      latest.push_back(rejected[done].corner);
    }
    PointBlocks next = PointBlocks(latest, execution).beside(views.lattice(), execution);
    next.remove(before, execution);
    next.remove(now, execution);
    before = std::move(now);
    now = std::move(next);
    appendRejected(views, now.points(execution), rejected, execution);
  }
  return byView(rejected, views.size(), execution);
}

} // namespace silhouette
