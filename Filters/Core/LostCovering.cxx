// SPDX-License-Identifier: BSD-3-Clause
#include "LostCovering.h"

#include "CornerEffects.h"
#include "LabelCache.h"
#include "LatticeRegions.h"
#include "PointClusters.h"
#include "SomeCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace silhouette
{
namespace
{

constexpr std::size_t LooksApart = 64;       ///< octants after which whoever covers them one after another asks whether it is cancelled
constexpr std::size_t ClustersAtOnce = 4096; ///< after which whoever covers clusters does

/** The solid's components, for whoever labels corners inside that change them. */
class Components
{
public:
  Components(const LatticeLabels& labels, Execution& execution)
    : Solid(labels, execution)
    , Corners(labels.shell().corners)
    , Run(execution)
  {
  }

  /** They are given only to who works on the calling thread. */
  void stopIfCancelled() { Unannounced(this->Run).checkpoint(1.0); }

  bool areJoinedAt(const LatticePoint& p, const TopologicalNumbers& numbers) { return joinsComponents(p, numbers, this->Corners, this->Solid); }

  void add(const LatticePoint& p)
  {
    const CodesAround codes(p);
    std::array<std::ptrdiff_t, 27> around;
    for (int n = 0; n < 27; ++n)
    {
      around[std::size_t(n)] = n != 13 ? this->Corners.find(codes[n]) : -1;
    }
    this->Solid.add(std::uint32_t(this->Corners.find(mortonCode(p))), around);
  }

private:
  SolidComponents Solid;
  CodeCursor Corners;
  Execution& Run;
};

/** Covers some of the lost octants, none of which is near any other. Labels nothing itself. For one thread at a time. */
class Cover
{
public:
  /** `lost`: all lost octants. */
  Cover(const LatticeLabels& labels, const SomeCells& lost, const CornerDepth* depth)
    : Labels(labels)
    , Lost(lost)
    , Depth(depth)
    , Cache(labels)
    , Octants(labels.octree())
  {
  }

  /** Of the shell's cells, ascending. False where it takes the components to tell, and these are not given: then nothing is added to `result`. */
  bool run(std::vector<std::uint32_t> cells, Components* components, LostCovering& result)
  {
    this->Solid = components;
    this->Cells = std::move(cells);
    this->prepare();
    if (!this->coverAll())
    {
      return false;
    }
    result.corners.insert(result.corners.end(), this->Labelled.begin(), this->Labelled.end());
    result.mayEnclose = result.mayEnclose || this->MayEnclose;
    return true;
  }

private:
  static constexpr std::uint32_t None = 0xffffffffu;

  /** A corner of the cells; these are numbered in the shell's order. */
  struct Corner
  {
    std::uint32_t number; ///< among the shell's
    bool mayBeLabelled;   ///< not on the root cube's border
    bool inside = false;
    bool isKnown = false; ///< the effect
    CornerEffect effect = CornerEffect::Otherwise;
    float support = std::numeric_limits<float>::infinity(); ///< or more than that
    bool isMeasured = false;                                 ///< it is the support
    Neighbourhood around{};
  };

  struct Choice
  {
    std::uint32_t corner = None;
    CornerEffect effect = CornerEffect::Otherwise;
    bool isSure = true; ///< that does not depend on components that are not given
  };

  const CornerShell& shell() const { return this->Labels.shell(); }
  LatticePoint point(std::uint32_t corner) const { return fromMorton(this->Codes[corner]); }

  void prepare()
  {
    const CornerShell& shell = this->shell();
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t cell : this->Cells)
    {
      numbers.insert(numbers.end(), shell.cellCorners[cell].begin(), shell.cellCorners[cell].end());
    }
    sortUnique(numbers);
    this->Corners.clear();
    this->Codes.clear();
    for (const std::uint32_t number : numbers)
    {
      const LatticePoint p = fromMorton(shell.corners[number]);
      this->Codes.push_back(shell.corners[number]);
      this->Corners.push_back({ number, !this->Labels.octree().lattice.onBorder(p) });
      if (this->Corners.back().mayBeLabelled)
      {
        this->Corners.back().around = this->Cache.insideAround(p);
      }
    }
    this->CellCorners.resize(this->Cells.size());
    for (std::size_t cell = 0; cell < this->Cells.size(); ++cell)
    {
      const auto& corners = shell.cellCorners[this->Cells[cell]];
      std::transform(corners.begin(), corners.end(), this->CellCorners[cell].begin(),
        [&](std::uint32_t corner) { return std::uint32_t(std::lower_bound(numbers.begin(), numbers.end(), corner) - numbers.begin()); });
    }
    this->Find.emplace(this->Codes);
    this->Labelled.clear();
    this->MayEnclose = false;
  }

  bool covered(std::uint32_t cell) const
  {
    const auto& corners = this->CellCorners[cell];
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) { return this->Corners[corner].inside; });
  }

  /** The number here of a cell of the shell, or None. */
  std::uint32_t own(std::uint32_t cell) const
  {
    const auto at = std::lower_bound(this->Cells.begin(), this->Cells.end(), cell);
    return at != this->Cells.end() && *at == cell ? std::uint32_t(at - this->Cells.begin()) : None;
  }

  bool coverAll()
  {
    std::vector<std::uint32_t> list(this->Cells.size()); // a queue
    for (std::uint32_t cell = 0; cell < list.size(); ++cell)
    {
      list[cell] = cell;
    }
    std::size_t at = 0, next = 0;
    while (at < list.size() || next < this->Cells.size())
    {
      if (this->Solid && (at + next) % LooksApart == 0)
      {
        this->Solid->stopIfCancelled();
      }
      const bool isGrowing = at < list.size();
      const std::uint32_t cell = isGrowing ? list[at++] : std::uint32_t(next++);
      if (this->covered(cell))
      {
        continue;
      }
      const Choice choice = this->best(cell, isGrowing ? CornerEffect::Joins : CornerEffect::Otherwise);
      if (!choice.isSure)
      {
        return false;
      }
      if (choice.corner != None)
      {
        this->label(choice);
        // The uncovered cells around the corner's own cells have another choice now.
        this->Lost.forCellsAround(this->point(choice.corner),
          [&](std::uint32_t other)
          {
            const std::uint32_t number = this->own(other);
            if (number != None && !this->covered(number))
            {
              list.push_back(number);
            }
          });
      }
    }
    return true;
  }

  /** The best of a cell's corners; None where its effect is beyond `most`. What takes long to tell is asked for only where it decides. */
  Choice best(std::uint32_t cell, CornerEffect most)
  {
    const bool isSure = this->findEffects(cell);
    std::array<std::uint32_t, 8> equals;
    std::size_t count = 0;
    Choice choice;
    choice.effect = most;
    for (const std::uint32_t corner : this->CellCorners[cell])
    {
      const Corner& one = this->Corners[corner];
      if (one.mayBeLabelled && one.effect <= choice.effect)
      {
        count = one.effect < choice.effect ? 0 : count;
        choice.effect = one.effect;
        equals[count++] = corner;
      }
    }
    // What joins components, or makes tunnels, is worse than what changes nothing, and an effect that may be either changes no choice of this.
    choice.isSure = isSure || (count > 0 && choice.effect == CornerEffect::Nothing);
    if (count > 0 && choice.isSure)
    {
      choice.isSure = this->Solid || choice.effect != CornerEffect::Otherwise; // it may join components
      choice.corner = bestOfEquals(
        equals.data(), count, [&](std::uint32_t corner, float least) { return this->support(corner, least); }, [&](std::uint32_t corner) { return this->covers(corner); });
    }
    return choice;
  }

  /** Effects of a cell's corners; false where one of them is not to be told without the components. */
  bool findEffects(std::uint32_t cell)
  {
    bool isSure = true;
    for (const std::uint32_t corner : this->CellCorners[cell])
    {
      Corner& one = this->Corners[corner];
      if (!one.mayBeLabelled || one.isKnown)
      {
        continue;
      }
      const auto numbers = topologicalNumbers(one.around);
      const auto effect = localEffect(numbers);
      one.isKnown = effect.has_value();
      one.effect = effect                                                       ? *effect
        : this->Solid && this->Solid->areJoinedAt(this->point(corner), numbers) ? CornerEffect::Joins
                                                                                : CornerEffect::Otherwise;
      isSure = isSure && (one.isKnown || this->Solid);
    }
    return isSure;
  }

  /** A corner's support, or where that is less than `least` anything between. */
  float support(std::uint32_t corner, float least)
  {
    Corner& one = this->Corners[corner];
    if (!one.isMeasured && one.support >= least)
    {
      const float below = std::nextafter(least, -std::numeric_limits<float>::infinity()); // what rounds to `least` is no less
      one.support = this->Depth ? float((*this->Depth)(this->point(corner), this->Octants, below)) : this->Labels.support()[one.number];
      one.isMeasured = one.support >= least;
    }
    return one.support;
  }

  /** How many octants a corner would cover. */
  int covers(std::uint32_t corner) const
  {
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(this->point(corner), cells);
    return int(std::count_if(cells.begin(), cells.begin() + count,
      [&](std::uint32_t cell)
      {
        const std::uint32_t number = this->own(cell); // others that survive have an inside corner
        return number != None && !this->covered(number);
      }));
  }

  void label(const Choice& choice)
  {
    const LatticePoint p = this->point(choice.corner);
    this->MayEnclose = this->MayEnclose || choice.effect == CornerEffect::Otherwise;
    this->Corners[choice.corner].inside = true;
    this->Corners[choice.corner].mayBeLabelled = false; // again
    this->Labelled.push_back(this->Corners[choice.corner].number);
    const CodesAround codes(p);
    for (int n = 0; n < 27; ++n)
    {
      const std::ptrdiff_t other = n != 13 ? this->Find->find(codes[n]) : -1;
      if (other >= 0)
      {
        this->Corners[std::size_t(other)].around[std::size_t(26 - n)] = true;
        this->Corners[std::size_t(other)].isKnown = false;
      }
    }
    if (this->Solid)
    {
      this->Solid->add(p);
    }
  }

  const LatticeLabels& Labels;
  const SomeCells& Lost;
  const CornerDepth* Depth;
  LabelCache Cache;
  OctantCursor Octants;
  Components* Solid = nullptr;
  std::vector<std::uint32_t> Cells;
  std::vector<std::array<std::uint32_t, 8>> CellCorners; ///< of each
  std::vector<Corner> Corners;
  std::vector<std::uint64_t> Codes; ///< of these
  std::optional<CodeCursor> Find;   ///< among the codes
  std::vector<std::uint32_t> Labelled;
  bool MayEnclose = false;
};

/** What is covered cluster by cluster, and the lost octants of those that are not. */
struct Clusters
{
  LostCovering covering;
  std::vector<std::uint32_t> left; ///< ascending

  Clusters(const LatticeLabels& labels, const std::vector<std::uint32_t>& lost, const SomeCells& cells, const CornerDepth* depth, Execution& execution)
  {
    std::vector<std::uint64_t> codes;
    codes.reserve(lost.size());
    std::transform(lost.begin(), lost.end(), std::back_inserter(codes), [&](std::uint32_t cell) { return labels.shell().cells[cell]; });
    const PointClusters clusters = clustersOf(codes, execution);
    const auto cellsOf = [&](std::size_t cluster)
    {
      std::vector<std::uint32_t> some;
      std::transform(clusters.begin(cluster), clusters.end(cluster), std::back_inserter(some), [&](std::uint32_t n) { return lost[n]; });
      return some;
    };
    std::vector<LostCovering> found(clusters.size());
    std::vector<std::uint8_t> isCovered(clusters.size(), 0);
    for (std::size_t begin = 0; begin < clusters.size(); begin += ClustersAtOnce)
    {
      Unannounced(execution).checkpoint(1.0);
      execution.forRanges(std::min(clusters.size() - begin, ClustersAtOnce), 64,
        [&](std::size_t first, std::size_t last)
        {
          Cover cover(labels, cells, depth);
          for (std::size_t cluster = begin + first; cluster < begin + last; ++cluster)
          {
            isCovered[cluster] = cover.run(cellsOf(cluster), nullptr, found[cluster]);
          }
        });
    }
    for (std::size_t cluster = 0; cluster < clusters.size(); ++cluster)
    {
      const auto& corners = found[cluster].corners;
      this->covering.corners.insert(this->covering.corners.end(), corners.begin(), corners.end());
      if (isCovered[cluster] == 0)
      {
        const auto some = cellsOf(cluster);
        this->left.insert(this->left.end(), some.begin(), some.end());
      }
    }
    std::sort(this->left.begin(), this->left.end());
  }
};

} // namespace

LostCovering coverLost(LatticeLabels& labels, const std::vector<std::uint32_t>& lost, const CornerDepth* depth, Execution& execution)
{
  const SomeCells cells(labels.shell(), lost);
  Clusters clusters(labels, lost, cells, depth, execution);
  LostCovering covering = std::move(clusters.covering);
  const auto label = [&](std::size_t from)
  { std::for_each(covering.corners.begin() + std::ptrdiff_t(from), covering.corners.end(), [&](std::uint32_t corner) { labels.setInside(corner); }); };
  label(0);
  if (!clusters.left.empty())
  {
    // What the clusters have done joins no components: it does not matter that it comes first.
    const std::size_t before = covering.corners.size();
    Components components(labels, execution);
    Cover(labels, cells, depth).run(std::move(clusters.left), &components, covering);
    label(before);
  }
  return covering;
}

} // namespace silhouette
