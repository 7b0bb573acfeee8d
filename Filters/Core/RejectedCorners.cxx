// SPDX-License-Identifier: BSD-3-Clause
#include "RejectedCorners.h"

#include "CornerVotes.h"
#include "GrowingPoints.h"
#include "IndicesWhere.h"
#include "LatticeLabels.h"
#include "PointBlocks.h"
#include "RadixSort.h"
#include "RejectedCubes.h"
#include "SilhouetteDissent.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

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
std::vector<Rejected> byView(std::vector<Rejected> rejected, const LatticeViews& views, Execution& execution)
{
  radixSort(rejected, 3 * (views.lattice().depth + 1), [](const Rejected& one) { return one.corner; }, execution);
  std::vector<std::size_t> next(std::size_t(views.size()) + 1, 0);
  for (const Rejected& one : rejected)
  {
    ++next[std::size_t(one.view) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Rejected> sorted(rejected.size());
  for (const Rejected& one : rejected)
  {
    sorted[next[std::size_t(one.view)]++] = one;
  }
  return sorted;
}

/** The search from the shell on. */
class Search
{
public:
  Search(const LatticeViews& views, double depth, Execution& execution)
    : Views(views)
    , Depth(depth)
    , Exec(execution)
  {
  }

  /** `latest`: of the shell's corners those that one view alone rejects, ascending. */
  RejectedCorners from(const CornerShell& shell, std::vector<Rejected> latest)
  {
    for (std::size_t c = 0; c < shell.corners.size() && !latest.empty(); ++c)
    {
      this->Seen.add(shell.corners[c]);
    }
    while (!latest.empty())
    {
      this->Exec.checkpoint(0.0);
      const std::vector<RejectedCube> cubes = this->takeCubes(latest);
      const std::vector<std::uint64_t> next = this->notSeenBeside(latest, cubes);
      std::for_each(next.begin(), next.end(), [this](std::uint64_t corner) { this->Seen.add(corner); });
      this->Found.corners.insert(this->Found.corners.end(), latest.begin(), latest.end());
      this->Found.cubes.insert(this->Found.cubes.end(), cubes.begin(), cubes.end());
      latest.clear();
      appendRejected(this->Views, next, latest, this->Exec);
    }
    this->Found.corners = byView(std::move(this->Found.corners), this->Views, this->Exec);
    std::sort(this->Found.cubes.begin(), this->Found.cubes.end(),
      [](const RejectedCube& a, const RejectedCube& b) { return std::tie(a.view, a.cube.corner) < std::tie(b.view, b.cube.corner); });
    return std::move(this->Found);
  }

private:
  /** The cubes around corners that have just been found; what they hold is taken from these, and their outermost points have been seen and found. */
  std::vector<RejectedCube> takeCubes(std::vector<Rejected>& latest)
  {
    auto starts = selected(
      latest.size(), [&](std::size_t n) { return n == 0 || latest[n - 1].corner >> 6 != latest[n].corner >> 6; }, [](std::size_t n) { return n; }, this->Exec);
    std::vector<RejectedCube> cubes(starts.size());
    this->Exec.forRanges(cubes.size(), 64,
      [&](std::size_t first, std::size_t last)
      {
        RejectedCubes known(this->Views, this->Depth);
        for (std::size_t b = first; b < last; ++b)
        {
          const Rejected& one = latest[starts[b]];
          cubes[b] = { known.around(one.corner, one.view), one.view };
        }
      });
    starts.push_back(latest.size());
    std::vector<Rejected> others;
    for (std::size_t b = 0; b < cubes.size(); ++b)
    {
      if (cubes[b].cube.side == 0)
      {
        others.insert(others.end(), latest.begin() + std::ptrdiff_t(starts[b]), latest.begin() + std::ptrdiff_t(starts[b + 1]));
      }
    }
    latest.swap(others);
    const auto isNone = [](const RejectedCube& one) { return one.cube.side == 0; };
    cubes.erase(std::remove_if(cubes.begin(), cubes.end(), isNone), cubes.end());
    cubes.erase(std::unique(cubes.begin(), cubes.end(), [](const RejectedCube& a, const RejectedCube& b) { return a.cube == b.cube; }), cubes.end());
    this->addOutermost(cubes);
    return cubes;
  }

  void addOutermost(const std::vector<RejectedCube>& cubes)
  {
    for (const RejectedCube& one : cubes)
    {
      forOutermost(one.cube,
        [&](const LatticePoint& p)
        {
          this->Seen.add(mortonCode(p));
          this->Found.corners.push_back({ mortonCode(p), one.view });
        });
    }
  }

  /** The corners one step from some and from cubes that have not been seen, ascending. */
  std::vector<std::uint64_t> notSeenBeside(const std::vector<Rejected>& some, const std::vector<RejectedCube>& cubes)
  {
    std::vector<std::uint64_t> codes(some.size());
    std::transform(some.begin(), some.end(), codes.begin(), [](const Rejected& one) { return one.corner; });
    codes = PointBlocks(codes, this->Exec).beside(this->Views.lattice(), this->Exec).points(this->Exec);
    const auto forParts = [&](std::size_t n, const auto& add)
    {
      forBeside(cubes[n].cube,
        [&](const LatticePoint& p)
        {
          if (isOfLattice(p, this->Views.lattice().cells()))
          {
            add(mortonCode(p));
          }
        });
    };
    const auto faces = collectParts<std::uint64_t>(cubes.size(), forParts, this->Exec);
    if (!faces.empty())
    {
      codes.insert(codes.end(), faces.begin(), faces.end());
      radixSort(codes, 3 * (this->Views.lattice().depth + 1), [](std::uint64_t code) { return code; }, this->Exec);
    }
    const auto isNew = [&](std::size_t n) { return (n == 0 || codes[n - 1] != codes[n]) && !this->Seen.has(codes[n]); };
    return selected(codes.size(), isNew, [&](std::size_t n) { return codes[n]; }, this->Exec);
  }

  const LatticeViews& Views;
  double Depth;
  Execution& Exec;
  GrowingPoints Seen; ///< that need not be asked about again; of cubes the outermost, which alone can be met
  RejectedCorners Found;
};

} // namespace

RejectedCorners findRejected(const Octree& octree, const LatticeViews& views, const CornerShell& shell, double depth,
                             KnownVotes::Votes& votes, Execution& execution)
{
  std::vector<Rejected> rejected;
  const std::vector<std::uint64_t> first = onceDisputed(octree, views, shell, votes, execution);
  votes ? appendRejectedOnce(octree, views, first, rejected, execution) : appendRejected(views, first, rejected, execution);
  return Search(views, depth, execution).from(shell, std::move(rejected));
}

} // namespace silhouette
