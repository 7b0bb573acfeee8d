// SPDX-License-Identifier: BSD-3-Clause
#include "RejectedCorners.h"

#include "Bits.h"
#include "BlockBits.h"
#include "CornerVotes.h"
#include "GrowingPoints.h"
#include "IndicesWhere.h"
#include "LatticeLabels.h"
#include "PointBlocks.h"
#include "RadixSort.h"
#include "RejectedCubes.h"
#include "SilhouetteDissent.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace silhouette
{
namespace
{

/** Those of `corners` that one view alone rejects. */
std::vector<Rejected> rejectedOf(const LatticeViews& views, const std::vector<std::uint64_t>& corners, Execution& execution)
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
  return selected(
    corners.size(), [&](std::size_t i) { return dissenter[i] >= 0; }, [&](std::size_t i) { return Rejected{corners[i], dissenter[i]}; }, execution);
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
std::vector<Rejected> rejectedOnce(const Octree& octree, const LatticeViews& views, const std::vector<std::uint64_t>& corners, Execution& execution)
{
  const LeafViews undecided(octree, views);
  // Then half of them call such a corner object.
  if (!undecided.isKnown() || 2 * (viewsThatSpeak(views) - 1) < views.size())
  {
    return rejectedOf(views, corners, execution);
  }
  std::vector<Rejected> rejected(corners.size());
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
  return selected(
    rejected.size(), [&](std::size_t i) { return rejected[i].view >= 0; }, [&](std::size_t i) { return rejected[i]; }, execution);
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
  radixSort(rejected, highestBit(std::uint64_t(views.size())) + 1, [](const Rejected& one) { return std::uint64_t(one.view); }, execution);
  return rejected;
}

/** What has been found and from which the search goes on. */
struct Front
{
  std::vector<Rejected> corners;   ///< ascending
  std::vector<RejectedCube> cubes; ///< ascending, none twice
};

void sortUnique(std::vector<RejectedCube>& cubes)
{
  std::sort(cubes.begin(), cubes.end(), [](const RejectedCube& a, const RejectedCube& b) { return a.cube.corner < b.cube.corner; });
  cubes.erase(std::unique(cubes.begin(), cubes.end(), [](const RejectedCube& a, const RejectedCube& b) { return a.cube == b.cube; }), cubes.end());
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

  /** `first`: of the shell's corners those that one view alone rejects, ascending. */
  RejectedCorners from(const CornerShell& shell, std::vector<Rejected> first)
  {
    Front front;
    front.corners = std::move(first);
    if (!front.corners.empty())
    {
      this->look(PointBlocks(shell.corners, this->Exec), front.corners);
      this->takeCubes(front);
    }
    while (!front.corners.empty() || !front.cubes.empty())
    {
      this->Exec.checkpoint(0.0);
      Front next = this->beside(front);
      this->Found.corners.insert(this->Found.corners.end(), front.corners.begin(), front.corners.end());
      this->Found.cubes.insert(this->Found.cubes.end(), front.cubes.begin(), front.cubes.end());
      front = std::move(next);
    }
    this->Found.corners = byView(std::move(this->Found.corners), this->Views, this->Exec);
    std::sort(this->Found.cubes.begin(), this->Found.cubes.end(),
      [](const RejectedCube& a, const RejectedCube& b) { return std::tie(a.view, a.cube.corner) < std::tie(b.view, b.cube.corner); });
    return std::move(this->Found);
  }

private:
  /** What is met beside cubes: other cubes, and corners to ask about. */
  struct Met
  {
    std::vector<RejectedCube> cubes;
    std::vector<std::uint64_t> corners;
  };

  Front beside(const Front& front)
  {
    Met met = this->besideCubes(front.cubes);
    PointBlocks asked = PointBlocks(this->codesOf(front.corners), this->Exec).beside(this->Views.lattice(), this->Exec);
    if (!met.corners.empty())
    {
      std::vector<std::uint64_t> codes = asked.points(this->Exec);
      codes.insert(codes.end(), met.corners.begin(), met.corners.end());
      radixSort(codes, 3 * (this->Views.lattice().depth + 1), [](std::uint64_t code) { return code; }, this->Exec);
      asked = PointBlocks(codes, this->Exec);
    }
    asked.remove(this->Alone, this->Exec);
    asked.remove(this->Others, this->Exec);
    std::vector<std::uint64_t> codes = asked.points(this->Exec);
    if (this->Largest > 0)
    {
      codes = selected(
        codes.size(), [&](std::size_t n) { return !this->isInCube(codes[n], LeastCube); }, [&](std::size_t n) { return codes[n]; }, this->Exec);
      asked = PointBlocks(codes, this->Exec);
    }
    Front next;
    next.corners = rejectedOf(this->Views, codes, this->Exec);
    this->look(std::move(asked), next.corners);
    this->takeCubes(next);
    next.cubes.insert(next.cubes.end(), met.cubes.begin(), met.cubes.end());
    sortUnique(next.cubes);
    return next;
  }

  /** Corners that have been asked about, and those of them that one view alone rejects, ascending. */
  void look(PointBlocks corners, const std::vector<Rejected>& rejected)
  {
    const PointBlocks alone(this->codesOf(rejected), this->Exec);
    corners.remove(alone, this->Exec);
    this->Alone.add(alone.words());
    this->Others.add(corners.words());
  }

  std::vector<std::uint64_t> codesOf(const std::vector<Rejected>& rejected) const
  {
    std::vector<std::uint64_t> codes(rejected.size());
    this->Exec.forRanges(codes.size(), 4096,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          codes[n] = rejected[n].corner;
        }
      });
    return codes;
  }

  /** Take out of a front's corners those that lie in cubes, for these. */
  void takeCubes(Front& front)
  {
    std::vector<Rejected>& corners = front.corners;
    auto starts = selected(
      corners.size(), [&](std::size_t n) { return n == 0 || corners[n - 1].corner >> 6 != corners[n].corner >> 6; }, [](std::size_t n) { return n; }, this->Exec);
    std::vector<RejectedCube> cubes(starts.size()); // of the corners of each block
    this->Exec.forRanges(cubes.size(), 64,
      [&](std::size_t first, std::size_t last)
      {
        RejectedCubes known(this->Views, this->Depth);
        for (std::size_t b = first; b < last; ++b)
        {
          const Rejected& one = corners[starts[b]];
          cubes[b] = { this->Others.ofBlock(one.corner >> 6) != 0 ? PointCube{ 0, 0 } : known.around(one.corner, one.view), one.view };
        }
      });
    const auto isNone = [](const RejectedCube& one) { return one.cube.side == 0; };
    if (std::all_of(cubes.begin(), cubes.end(), isNone))
    {
      return;
    }
    starts.push_back(corners.size());
    std::vector<Rejected> others;
    for (std::size_t b = 0; b < cubes.size(); ++b)
    {
      if (isNone(cubes[b]))
      {
        others.insert(others.end(), corners.begin() + std::ptrdiff_t(starts[b]), corners.begin() + std::ptrdiff_t(starts[b + 1]));
      }
    }
    corners.swap(others);
    cubes.erase(std::remove_if(cubes.begin(), cubes.end(), isNone), cubes.end());
    this->know(cubes);
    front.cubes.swap(cubes);
  }

  Met besideCubes(const std::vector<RejectedCube>& cubes)
  {
    std::vector<Met> ofCubes(cubes.size());
    this->Exec.forRanges(cubes.size(), 1,
      [&](std::size_t first, std::size_t last)
      {
        RejectedCubes known(this->Views, this->Depth);
        for (std::size_t n = first; n < last; ++n)
        {
          this->meet(cubes[n], known, ofCubes[n]);
        }
      });
    Met all;
    for (const Met& one : ofCubes)
    {
      all.cubes.insert(all.cubes.end(), one.cubes.begin(), one.cubes.end());
      all.corners.insert(all.corners.end(), one.corners.begin(), one.corners.end());
    }
    sortUnique(all.cubes);
    this->know(all.cubes);
    return all;
  }

  void meet(const RejectedCube& from, RejectedCubes& known, Met& met) const
  {
    const std::int32_t n = this->Views.lattice().cells();
    const auto isDone = [&](const PointCube& box)
    {
      const LatticePoint low = fromMorton(box.corner);
      if (std::max({ low.i, low.j, low.k }) > n || this->isInCube(box.corner, box.side))
      {
        return true;
      }
      const PointCube cube = known.around(box.corner, from.view);
      if (cube.side >= box.side)
      {
        met.cubes.push_back({ cube, from.view });
      }
      return cube.side >= box.side;
    };
    const auto addFacing = [&](const LatticePoint& low, const CubeFace& face)
    {
      const std::uint64_t block = mortonCode(low);
      for (std::uint64_t facing = blockSlab(face.axis, face.ahead ? 0 : BlockSide - 1); facing != 0; facing &= facing - 1)
      {
        const std::uint64_t corner = block + std::uint64_t(lowestBit(facing));
        if (isOfLattice(fromMorton(corner), n))
        {
          met.corners.push_back(corner);
        }
      }
    };
    forBlocksBeside(from.cube, isDone, addFacing);
  }

  void know(const std::vector<RejectedCube>& cubes)
  {
    for (const RejectedCube& one : cubes)
    {
      const int bits = lowestBit(one.cube.size());
      this->Known[std::size_t(bits / 3)].add(one.cube.corner >> bits);
      this->Largest = std::max(this->Largest, one.cube.side);
    }
  }

  /** Is a point in a known cube of so many points along an edge or more? */
  bool isInCube(std::uint64_t corner, std::int32_t side) const
  {
    for (; side <= this->Largest; side *= 2)
    {
      const int generation = lowestBit(std::uint64_t(side));
      if (this->Known[std::size_t(generation)].has(corner >> 3 * generation))
      {
        return true;
      }
    }
    return false;
  }

  const LatticeViews& Views;
  double Depth;
  Execution& Exec;
  GrowingPoints Alone, Others;                             ///< corners that have been asked about: whether one view alone rejects them
  std::array<GrowingPoints, MaximumDepth + 1> Known;       ///< cubes, by halvings of their sides to a point
  std::int32_t Largest = 0;                                ///< side of a known cube
  RejectedCorners Found;
};

} // namespace

RejectedCorners findRejected(const Octree& octree, const LatticeViews& views, const CornerShell& shell, double depth,
                             KnownVotes::Votes& votes, Execution& execution)
{
  const std::vector<std::uint64_t> first = onceDisputed(octree, views, shell, votes, execution);
  return Search(views, depth, execution).from(shell, votes ? rejectedOnce(octree, views, first, execution) : rejectedOf(views, first, execution));
}

} // namespace silhouette
