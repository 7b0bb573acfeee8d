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

/**
 * Those of some points that one view alone rejects, by block, then by view. `makeDissenter()` makes what is asked about a run of points, `dissenter(p)`: that view, or
 * -1.
 */
template <typename MakeDissenter>
std::vector<RejectedWord> rejectedBy(const std::vector<BlockWord>& asked, const MakeDissenter& makeDissenter, Execution& execution)
{
  constexpr std::size_t RunSize = 128; // blocks
  std::vector<std::vector<RejectedWord>> ofRuns((asked.size() + RunSize - 1) / RunSize);
  const auto askRun = [&](std::size_t run)
  {
    auto dissenter = makeDissenter();
    std::vector<RejectedWord>& found = ofRuns[run];
    for (std::size_t b = run * RunSize; b < std::min((run + 1) * RunSize, asked.size()); ++b)
    {
      const std::size_t first = found.size(); // of this block
      const auto ask = [&](std::uint64_t code)
      {
        const int view = dissenter(fromMorton(code));
        if (view < 0)
        {
          return;
        }
        std::size_t own = first;
        while (own < found.size() && found[own].view != view)
        {
          ++own;
        }
        if (own == found.size())
        {
          found.push_back({ { asked[b].block, 0 }, view });
        }
        found[own].corners.bits |= std::uint64_t(1) << (code & 63);
      };
      forCodes(asked[b], ask);
      std::sort(found.begin() + std::ptrdiff_t(first), found.end(), [](const RejectedWord& one, const RejectedWord& other) { return one.view < other.view; });
    }
  };
  execution.forRanges(ofRuns.size(), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t run = first; run < last; ++run)
                        {
                          askRun(run);
                        }
                      });
  return concatenated(ofRuns, execution);
}

/** The same, of any points. */
std::vector<RejectedWord> rejectedOf(const LatticeViews& views, const std::vector<BlockWord>& asked, Execution& execution)
{
  const auto makeDissenter = [&] { return [only = OnlyDissenter(views)](const LatticePoint& p) mutable { return only.at(p); }; };
  return rejectedBy(asked, makeDissenter, execution);
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

/** The same, of corners of the octree's surviving octants, each of which one of its own views calls background. */
std::vector<RejectedWord> rejectedOnce(const Octree& octree, const LatticeViews& views, const std::vector<BlockWord>& asked, Execution& execution)
{
  const LeafViews undecided(octree, views);
  // Then half of them call such a corner object.
  if (!undecided.isKnown() || 2 * (viewsThatSpeak(views) - 1) < views.size())
  {
    return rejectedOf(views, asked, execution);
  }
  const auto makeDissenter = [&]
  {
    return [&, octants = OctantCursor(octree)](const LatticePoint& p) mutable
    {
      int only = -1;
      undecided.around(p, octants).forEach([&](int view) { only = only < 0 && views.vote(view, p) == Vote::Background ? view : only; });
      return only;
    };
  };
  return rejectedBy(asked, makeDissenter, execution);
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

/** Sorted by view, then by block, of both one. */
std::vector<RejectedWord> byView(std::vector<RejectedWord> words, const LatticeViews& views, Execution& execution)
{
  radixSort(words, 3 * (views.lattice().depth + 1), [](const RejectedWord& one) { return one.corners.block; }, execution);
  radixSort(words, highestBit(std::uint64_t(views.size())) + 1, [](const RejectedWord& one) { return std::uint64_t(one.view); }, execution);
  std::size_t kept = 0;
  for (const RejectedWord& word : words)
  {
    if (kept > 0 && words[kept - 1].view == word.view && words[kept - 1].corners.block == word.corners.block)
    {
      words[kept - 1].corners.bits |= word.corners.bits;
    }
    else
    {
      words[kept++] = word;
    }
  }
  words.resize(kept);
  return words;
}

/** All corners of words, ascending, of a block one. */
std::vector<BlockWord> cornersOf(const std::vector<RejectedWord>& words)
{
  std::vector<BlockWord> corners;
  for (const RejectedWord& word : words)
  {
    append(corners, word.corners);
  }
  return corners;
}

/** What has been found and from which the search goes on. */
struct Front
{
  std::vector<RejectedWord> words; ///< by block, then by view
  std::vector<RejectedCube> cubes; ///< ascending, none twice

  bool empty() const { return this->words.empty() && this->cubes.empty(); }
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

  /** `first`: of the shell's corners those that one view alone rejects, by block, then by view. */
  RejectedCorners from(const CornerShell& shell, std::vector<RejectedWord> first)
  {
    Front front;
    front.words = std::move(first);
    if (!front.words.empty())
    {
      this->look(PointBlocks(shell.corners, this->Exec), front.words);
      this->takeCubes(front);
    }
    while (!front.empty())
    {
      this->Exec.checkpoint(0.0);
      Front next = this->beside(front);
      this->Found.words.insert(this->Found.words.end(), front.words.begin(), front.words.end());
      this->Found.cubes.insert(this->Found.cubes.end(), front.cubes.begin(), front.cubes.end());
      front = std::move(next);
    }
    this->Found.words = byView(std::move(this->Found.words), this->Views, this->Exec);
    std::sort(this->Found.cubes.begin(), this->Found.cubes.end(),
      [](const RejectedCube& a, const RejectedCube& b) { return std::tie(a.view, a.cube.corner) < std::tie(b.view, b.cube.corner); });
    return std::move(this->Found);
  }

private:
  /** What is met beside cubes: other cubes, and corners to ask about. */
  struct Met
  {
    std::vector<RejectedCube> cubes;
    std::vector<BlockWord> corners; ///< some of a block
  };

  Front beside(const Front& front)
  {
    Met met = this->besideCubes(front.cubes);
    PointBlocks asked = PointBlocks(cornersOf(front.words)).beside(this->Views.lattice(), this->Exec);
    if (!met.corners.empty())
    {
      std::sort(met.corners.begin(), met.corners.end(), [](const BlockWord& a, const BlockWord& b) { return a.block < b.block; });
      asked = PointBlocks(unitedWords(asked.words(), met.corners));
    }
    asked.remove(this->Alone, this->Exec);
    asked.remove(this->Others, this->Exec);
    if (this->Largest > 0)
    {
      const std::vector<BlockWord>& all = asked.words();
      asked = PointBlocks(selected(
        all.size(), [&](std::size_t n) { return !this->isInCube(64 * all[n].block, LeastCube); }, [&](std::size_t n) { return all[n]; }, this->Exec));
    }
    Front next;
    next.words = rejectedOf(this->Views, asked.words(), this->Exec);
    this->look(std::move(asked), next.words);
    this->takeCubes(next);
    next.cubes.insert(next.cubes.end(), met.cubes.begin(), met.cubes.end());
    sortUnique(next.cubes);
    return next;
  }

  /** Corners that have been asked about, and those of them that one view alone rejects. */
  void look(PointBlocks corners, const std::vector<RejectedWord>& rejected)
  {
    const PointBlocks alone(cornersOf(rejected));
    corners.remove(alone, this->Exec);
    this->Alone.add(alone.words());
    this->Others.add(corners.words());
  }

  /** Take out of a front the words of blocks that lie in cubes, for these. */
  void takeCubes(Front& front)
  {
    std::vector<RejectedWord>& words = front.words;
    const auto isOfBlock = [&](std::size_t n, std::uint64_t block) { return n < words.size() && words[n].corners.block == block; };
    std::vector<RejectedCube> cubes(words.size()); // of the block of each word
    this->Exec.forRanges(cubes.size(), 64,
      [&](std::size_t first, std::size_t last)
      {
        RejectedCubes known(this->Views, this->Depth);
        for (std::size_t n = first; n < last; ++n)
        {
          const std::uint64_t block = words[n].corners.block;
          const bool isOneViews = !isOfBlock(n + 1, block) && (n == 0 || !isOfBlock(n - 1, block));
          if (isOneViews && this->Others.ofBlock(block) == 0)
          {
            cubes[n] = { known.around(64 * block, words[n].view), words[n].view };
          }
        }
      });
    const auto isInCube = [&](std::size_t n) { return cubes[n].cube.side != 0; };
    const auto taken = selected(cubes.size(), isInCube, [&](std::size_t n) { return cubes[n]; }, this->Exec);
    if (!taken.empty())
    {
      words = selected(words.size(), [&](std::size_t n) { return !isInCube(n); }, [&](std::size_t n) { return words[n]; }, this->Exec);
      this->know(taken);
      front.cubes = taken;
      sortUnique(front.cubes);
    }
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
      const std::uint64_t block = mortonCode(low) >> 6;
      const std::uint64_t facing = blockSlab(face.axis, face.ahead ? 0 : BlockSide - 1) & withinLattice(this->Views.lattice(), block);
      if (facing != 0)
      {
        met.corners.push_back({ block, facing });
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
  const std::vector<std::uint64_t> corners = onceDisputed(octree, views, shell, votes, execution);
  const std::vector<BlockWord> first = PointBlocks(corners, execution).words();
  return Search(views, depth, execution).from(shell, votes ? rejectedOnce(octree, views, first, execution) : rejectedOf(views, first, execution));
}

} // namespace silhouette
