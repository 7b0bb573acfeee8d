// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorCovering.h"

#include "CornerEffects.h"
#include "IndicesWhere.h"
#include "LargePages.h"
#include "LatticeRegions.h"
#include "LostCovering.h"
#include "ShellPaths.h"

#include <algorithm>
#include <deque>
#include <tuple>

namespace silhouette
{
namespace
{

constexpr std::uint32_t None = 0xffffffffu;
constexpr std::size_t LooksApart = 64; ///< cells, corners or bridges after which it is asked whether to stop

struct Candidate
{
  CornerEffect effect = CornerEffect::Otherwise;
  float support = -1e30f;
  int covers = 0;
  std::uint32_t corner = None;

  /** Smaller is better. */
  std::tuple<int, float, int, std::uint32_t> rank() const
  {
    return { int(this->effect), -this->support, -this->covers, this->corner };
  }
};

class Covering
{
public:
  /** `result`: what has been done to the labels so far. */
  Covering(LatticeLabels& labels, int loop, const CornerDepth* depth, CoveringResult& result, Execution& execution)
    : Labels(labels)
    , Effects(labels, depth)
    , Loop(loop)
    , Solid(labels, execution)
    , Result(result)
    , Run(execution)
  {
  }

  void run(const std::vector<Bridge>& bridges)
  {
    this->joinWithinCells();
    this->joinAcrossCorners();
    this->build(bridges);
  }

private:
  const CornerShell& shell() const { return this->Labels.shell(); }
  void stopIfCancelled()
  {
    if (++this->Looks % LooksApart == 0)
    {
      Unannounced(this->Run).checkpoint(1.0);
    }
  }

  bool inside(std::uint32_t corner) const { return this->Labels.inside()[corner] != 0; }
  std::uint32_t component(std::uint32_t corner) { return this->Solid.of(corner); }

  bool covered(std::uint32_t cell) const
  {
    const auto& corners = this->shell().cellCorners[cell];
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return this->inside(c); });
  }

  CornerEffect effectOf(std::uint32_t corner) { return this->Effects.of(corner, this->Solid); }

  bool onBorder(std::uint32_t corner) const
  {
    return this->Labels.octree().lattice.onBorder(fromMorton(this->shell().corners[corner]));
  }

  /** How many octants a corner would cover. */
  int covers(std::uint32_t corner) const
  {
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(fromMorton(this->shell().corners[corner]), cells);
    return int(
      std::count_if(cells.begin(), cells.begin() + count, [&](std::uint32_t cell) { return !this->covered(cell); }));
  }

  /** A corner that is not on the border. */
  Candidate consider(std::uint32_t corner, CornerEffect effect)
  {
    Candidate candidate;
    candidate.corner = corner;
    candidate.support = this->Effects.support(corner);
    candidate.effect = effect;
    candidate.covers = this->covers(corner);
    return candidate;
  }

  /** The best of a cell's corners that are not inside yet; one is not on the border. Support, which takes longest, is asked for only among equals. */
  std::uint32_t best(std::uint32_t cell)
  {
    std::array<std::uint32_t, 8> equals;
    std::size_t count = 0;
    CornerEffect least = CornerEffect::Otherwise;
    for (const std::uint32_t corner : this->shell().cellCorners[cell])
    {
      const bool mayBeLabelled = !this->inside(corner) && !this->onBorder(corner);
      const CornerEffect effect = mayBeLabelled ? this->effectOf(corner) : CornerEffect::Otherwise;
      if (mayBeLabelled && effect <= least)
      {
        count = effect < least ? 0 : count;
        least = effect;
        equals[count++] = corner;
      }
    }
    return bestOfEquals(
      equals.data(), count, [&](std::uint32_t corner, float) { return this->Effects.support(corner); }, [&](std::uint32_t corner) { return this->covers(corner); });
  }

  /** Label a corner inside: its cells may have a second component now. */
  void addUnsettled(std::uint32_t corner)
  {
    this->Result.mayEnclose = this->effectOf(corner) == CornerEffect::Otherwise || this->Result.mayEnclose;
    this->Labels.setInside(corner);
    this->Result.coveringCorners.push_back(corner);
    this->Solid.add(corner, this->Effects.setInside(corner));
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(fromMorton(this->shell().corners[corner]), cells);
    this->Unsettled.insert(this->Unsettled.end(), cells.begin(), cells.begin() + count);
  }

  /** Are two corners of a cell inside, opposite ends of its diagonal? In no other cell are inside corners apart. */
  bool hasDiagonal(std::uint32_t cell) const
  {
    const auto& corners = this->shell().cellCorners[cell];
    std::array<int, 8> inside;
    int count = 0;
    for (int c = 0; c < 8 && count < 3; ++c)
    {
      inside[std::size_t(count)] = c;
      count += this->inside(corners[std::size_t(c)]);
    }
    return count == 2 && inside[0] + inside[1] == 7;
  }

  /** The inside corners of a cell belong to one component then. */
  void joinWithin(std::uint32_t cell)
  {
    this->stopIfCancelled();
    if (this->hasDiagonal(cell))
    {
      std::array<std::uint32_t, 2> ends;
      const auto& corners = this->shell().cellCorners[cell];
      std::copy_if(corners.begin(), corners.end(), ends.begin(), [&](std::uint32_t corner) { return this->inside(corner); });
      if (this->component(ends[0]) != this->component(ends[1]))
      {
        this->addUnsettled(this->best(cell));
      }
    }
  }

  /** Every cell around a corner that was added may hold a second component now. */
  void settle()
  {
    for (; !this->Unsettled.empty(); this->Unsettled.pop_front())
    {
      this->joinWithin(this->Unsettled.front());
    }
  }

  void joinWithinCells()
  {
    for (const std::int32_t cell : indicesWhere(this->shell().cells.size(), 4096, this->Run,
           [&](std::size_t one) { return this->Labels.isSurvivor(one) && this->hasDiagonal(std::uint32_t(one)); }))
    {
      this->joinWithin(std::uint32_t(cell));
    }
    this->settle();
  }

  /** Are the cells around a corner in more than one component? */
  bool parts(const std::array<std::uint32_t, 8>& cells, int count)
  {
    std::uint32_t first = None;
    for (int n = 0; n < count; ++n)
    {
      for (const std::uint32_t corner : this->shell().cellCorners[cells[n]])
      {
        if (this->inside(corner))
        {
          const std::uint32_t root = this->component(corner);
          first = first == None ? root : first;
          if (root != first)
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  /** The component of each surviving cell's inside corners, which have one now; nothing where all have the same. */
  std::vector<std::uint32_t> componentsOfCells()
  {
    if (this->Solid.isOne())
    {
      return {};
    }
    auto components = largeVector<std::uint32_t>(this->shell().cells.size(), None);
    std::uint32_t first = None;
    bool several = false;
    for (std::uint32_t cell = 0; cell < components.size(); ++cell)
    {
      const auto& corners = this->shell().cellCorners[cell];
      const auto corner = this->Labels.isSurvivor(cell)
        ? std::find_if(corners.begin(), corners.end(), [&](std::uint32_t c) { return this->inside(c); })
        : corners.end();
      if (corner != corners.end())
      {
        components[cell] = this->component(*corner);
        first = first == None ? components[cell] : first;
        several = several || components[cell] != first;
      }
    }
    return several ? components : std::vector<std::uint32_t>();
  }

  /** Corners outside whose cells, the surviving ones, are in more than one component; ascending. */
  std::vector<std::uint32_t> cornersBetweenComponents()
  {
    constexpr std::uint32_t several = None - 1;
    const std::vector<std::uint32_t> components = this->componentsOfCells();
    auto seen = largeVector<std::uint32_t>(components.empty() ? 0 : this->shell().corners.size(), None);
    for (std::size_t cell = 0; cell < components.size(); ++cell)
    {
      for (const std::uint32_t corner : this->shell().cellCorners[cell])
      {
        const std::uint32_t before = seen[corner], own = components[cell];
        seen[corner] = before == None || before == own ? own : own == None ? before : several;
      }
    }
    std::vector<std::uint32_t> between;
    for (std::uint32_t corner = 0; corner < seen.size(); ++corner)
    {
      if (seen[corner] == several && !this->inside(corner))
      {
        between.push_back(corner);
      }
    }
    return between;
  }

  void joinAcrossCorners()
  {
    std::vector<Candidate> apart;
    for (const std::uint32_t corner : this->cornersBetweenComponents())
    {
      this->stopIfCancelled();
      if (!this->onBorder(corner))
      {
        apart.push_back(this->consider(corner, this->effectOf(corner)));
      }
    }
    std::sort(apart.begin(), apart.end(), [](const Candidate& a, const Candidate& b) { return a.rank() < b.rank(); });
    std::array<std::uint32_t, 8> cells;
    for (const auto& candidate : apart)
    {
      this->stopIfCancelled();
      const int count = this->Labels.cellsAround(fromMorton(this->shell().corners[candidate.corner]), cells);
      if (!this->inside(candidate.corner) && this->parts(cells, count))
      {
        this->addUnsettled(candidate.corner);
        this->settle();
      }
    }
  }

  /** An inside corner of the survivors around a lattice point, or None. */
  std::uint32_t insideNear(std::uint64_t point) const
  {
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(fromMorton(point), cells);
    for (int n = 0; n < count; ++n)
    {
      for (const std::uint32_t corner : this->shell().cellCorners[cells[n]])
      {
        if (this->inside(corner))
        {
          return corner;
        }
      }
    }
    return None;
  }

  /** Corrected labels may have joined already what the survivors leave apart: a bridge would make a tunnel there. */
  bool isNeeded(const Bridge& bridge, ShellPaths& paths)
  {
    const std::uint32_t from = this->insideNear(bridge.front()), to = this->insideNear(bridge.back());
    return from == None || to == None || this->component(from) != this->component(to) ||
      !paths.meet(from, to, this->Loop, [&](std::uint32_t corner) { return this->inside(corner); });
  }

  void build(const std::vector<Bridge>& bridges)
  {
    ShellPaths paths(this->shell());
    for (const auto& bridge : bridges)
    {
      this->stopIfCancelled();
      if (!this->isNeeded(bridge, paths))
      {
        continue;
      }
      for (const std::uint64_t point : bridge)
      {
        const auto corner = this->shell().find(point);
        if (corner >= 0 && !this->inside(std::uint32_t(corner)))
        {
          this->addUnsettled(std::uint32_t(corner));
        }
      }
    }
    this->settle();
  }

  LatticeLabels& Labels;
  CornerEffects Effects;
  int Loop;
  SolidComponents Solid;
  std::deque<std::uint32_t> Unsettled;
  CoveringResult& Result;
  Execution& Run;
  std::size_t Looks = 0; ///< at cells, corners and bridges
};

/** The shell's survivors without an inside corner. */
std::vector<std::uint32_t> lostCells(const LatticeLabels& labels, Execution& execution)
{
  const auto isCovered = [&](const std::array<std::uint32_t, 8>& corners)
  { return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return labels.inside()[c] != 0; }); };
  const auto lost = indicesWhere(labels.shell().cells.size(), 4096, execution,
    [&](std::size_t cell) { return labels.isSurvivor(cell) && !isCovered(labels.shell().cellCorners[cell]); });
  return { lost.begin(), lost.end() };
}

} // namespace

CoveringResult coverSurvivors(
  LatticeLabels& labels, const std::vector<Bridge>& bridges, int loop, const CornerDepth* depth, Execution& execution)
{
  CoveringResult result;
  result.coveredCells = lostCells(labels, execution);
  LostCovering covering = coverLost(labels, result.coveredCells, depth, execution);
  result.coveringCorners = std::move(covering.corners);
  result.mayEnclose = covering.mayEnclose;
  Covering(labels, loop, depth, result, execution).run(bridges);
  return result;
}

} // namespace silhouette
