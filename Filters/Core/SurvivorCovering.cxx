// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorCovering.h"

#include "LabelCache.h"
#include "LatticeRegions.h"
#include "ShellPaths.h"
#include "SimplePoint.h"

#include <algorithm>
#include <deque>
#include <tuple>

namespace silhouette
{
namespace
{

/** What labelling a corner inside does to the topology, best first. */
enum class Effect : int
{
  Nothing,  ///< the corner is simple
  Joins,    ///< it joins components and makes no tunnel
  Founds,   ///< it starts a component of its own
  Otherwise ///< tunnels or cavities may come or go
};

constexpr std::uint32_t None = 0xffffffffu;

struct Candidate
{
  Effect effect = Effect::Otherwise;
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
  Covering(LatticeLabels& labels, int loop, const CornerDepth* depth)
    : Labels(labels)
    , Cache(labels)
    , Loop(loop)
    , Depth(depth)
    , Known(depth ? labels.shell().corners.size() : 0, Unknown)
    , Solid(connectRegions(labels, true))
  {
  }

  CoveringResult run(const std::vector<Bridge>& bridges)
  {
    this->findLost();
    this->coverAll();
    this->joinWithinCells();
    this->joinAcrossCorners();
    this->build(bridges);
    return this->Result;
  }

private:
  const CornerShell& shell() const { return this->Labels.shell(); }
  bool inside(std::uint32_t corner) const { return this->Labels.inside()[corner] != 0; }
  std::uint32_t component(std::uint32_t corner) { return this->Solid.sets.find(corner); }

  bool covered(std::uint32_t cell) const
  {
    const auto& corners = this->shell().cellCorners[cell];
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return this->inside(c); });
  }

  float support(std::uint32_t corner)
  {
    if (!this->Depth)
    {
      return this->Labels.support()[corner];
    }
    float& known = this->Known[corner];
    if (known == Unknown)
    {
      known = float((*this->Depth)(fromMorton(this->shell().corners[corner])));
    }
    return known;
  }

  void findLost()
  {
    for (std::uint32_t cell = 0; cell < this->shell().cells.size(); ++cell)
    {
      if (this->Labels.isSurvivor(cell) && !this->covered(cell))
      {
        this->Lost.push_back(cell);
      }
    }
    this->Result.coveredCells = this->Lost;
  }

  Effect effectOf(const LatticePoint& p)
  {
    Neighbourhood labels;
    for (int n = 0; n < 27; ++n)
    {
      labels[n] = n != 13 && this->Cache.insideAt(neighbourOf(p, n));
    }
    const auto numbers = topologicalNumbers(labels);
    if (isSimple(numbers))
    {
      return Effect::Nothing;
    }
    if (numbers.inside == 0)
    {
      return Effect::Founds;
    }
    return numbers.outside == 1 && this->distinctComponents(p, numbers) ? Effect::Joins : Effect::Otherwise;
  }

  /** Do the local components around p belong to as many components of the whole solid? */
  bool distinctComponents(const LatticePoint& p, const TopologicalNumbers& numbers)
  {
    std::vector<std::uint32_t> roots;
    for (int part = 0; part < numbers.inside; ++part)
    {
      for (int n = 0; n < 27; ++n)
      {
        const auto corner = numbers.insideComponent[n] == part ? this->shell().find(mortonCode(neighbourOf(p, n))) : -1;
        if (corner >= 0)
        {
          roots.push_back(this->component(std::uint32_t(corner)));
          break;
        }
      }
    }
    std::sort(roots.begin(), roots.end());
    return int(roots.size()) == numbers.inside && std::adjacent_find(roots.begin(), roots.end()) == roots.end();
  }

  bool onBorder(std::uint32_t corner) const
  {
    return this->Labels.octree().lattice.onBorder(fromMorton(this->shell().corners[corner]));
  }

  /** A corner that is not on the border. */
  Candidate consider(std::uint32_t corner, Effect effect)
  {
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(fromMorton(this->shell().corners[corner]), cells);
    Candidate candidate;
    candidate.corner = corner;
    candidate.support = this->support(corner);
    candidate.effect = effect;
    candidate.covers = int(
      std::count_if(cells.begin(), cells.begin() + count, [&](std::uint32_t cell) { return !this->covered(cell); }));
    return candidate;
  }

  /**
   * The best of a cell's corners that is not inside yet; corner None where there is none or its effect is beyond `most`. Support, which takes
   * longest, is asked for only among equals.
   */
  Candidate best(std::uint32_t cell, Effect most = Effect::Otherwise)
  {
    std::array<std::uint32_t, 8> equals;
    std::size_t count = 0;
    Effect least = most;
    for (const std::uint32_t corner : this->shell().cellCorners[cell])
    {
      if (this->inside(corner) || this->onBorder(corner))
      {
        continue;
      }
      const Effect effect = this->effectOf(fromMorton(this->shell().corners[corner]));
      if (effect <= least)
      {
        count = effect < least ? 0 : count;
        least = effect;
        equals[count++] = corner;
      }
    }
    Candidate best;
    best.effect = least;
    best.corner = count == 1 ? equals[0] : best.corner;
    for (std::size_t n = 0; count > 1 && n < count; ++n)
    {
      const Candidate candidate = this->consider(equals[n], least);
      best = candidate.rank() < best.rank() ? candidate : best;
    }
    return best;
  }

  void add(std::uint32_t corner)
  {
    const LatticePoint p = fromMorton(this->shell().corners[corner]);
    this->Result.mayEnclose = this->Result.mayEnclose || this->effectOf(p) == Effect::Otherwise;
    this->Labels.setInside(corner);
    this->Cache.forget(this->shell().corners[corner]);
    this->Result.coveringCorners.push_back(corner);
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(p, cells);
    this->Unsettled.insert(this->Unsettled.end(), cells.begin(), cells.begin() + count);
    for (int n = 0; n < 27; ++n)
    {
      const int differing = (n % 3 != 1) + (n / 3 % 3 != 1) + (n / 9 != 1);
      const auto other = differing == 1 || differing == 2 ? this->shell().find(mortonCode(neighbourOf(p, n))) : -1;
      if (other >= 0 && this->inside(std::uint32_t(other)))
      {
        this->Solid.sets.unite(corner, std::uint32_t(other));
      }
    }
  }

  /** Put the uncovered cells around a corner's own cells on the list again. */
  void revisit(std::uint32_t corner, std::deque<std::uint32_t>& list)
  {
    const LatticePoint p = fromMorton(this->shell().corners[corner]);
    for (int n = 0; n < 64; ++n)
    {
      const auto cell = this->shell().findCell({ p.i + n % 4 - 2, p.j + n / 4 % 4 - 2, p.k + n / 16 - 2 });
      if (cell >= 0 && this->Labels.isSurvivor(cell) && !this->covered(std::uint32_t(cell)))
      {
        list.push_back(std::uint32_t(cell));
      }
    }
  }

  /** Grow from the solid as long as that changes no topology, then found a new component, and so on. */
  void coverAll()
  {
    std::deque<std::uint32_t> list(this->Lost.begin(), this->Lost.end());
    std::size_t next = 0;
    for (;;)
    {
      const bool growing = !list.empty();
      std::uint32_t cell = 0;
      if (growing)
      {
        cell = list.front();
        list.pop_front();
      }
      else if (next < this->Lost.size())
      {
        cell = this->Lost[next++];
      }
      else
      {
        return;
      }
      if (this->covered(cell))
      {
        continue;
      }
      const Candidate candidate = this->best(cell, growing ? Effect::Joins : Effect::Otherwise);
      if (!growing || candidate.corner != None)
      {
        this->add(candidate.corner);
        this->revisit(candidate.corner, list);
      }
    }
  }

  /** The inside corners of a cell belong to one component, unless there are two, opposite ends of its diagonal. */
  void joinWithin(std::uint32_t cell)
  {
    const auto& corners = this->shell().cellCorners[cell];
    std::array<int, 8> inside;
    int count = 0;
    for (int c = 0; c < 8 && count < 3; ++c)
    {
      inside[count] = c;
      count += this->inside(corners[c]);
    }
    if (count == 2 && inside[0] + inside[1] == 7 && this->component(corners[inside[0]]) != this->component(corners[inside[1]]))
    {
      this->add(this->best(cell).corner);
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
    this->Unsettled.clear();
    for (std::uint32_t cell = 0; cell < this->shell().cells.size(); ++cell)
    {
      if (this->Labels.isSurvivor(cell))
      {
        this->joinWithin(cell);
      }
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
    std::vector<std::uint32_t> components(this->shell().cells.size(), None);
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
    std::vector<std::uint32_t> seen(components.empty() ? 0 : this->shell().corners.size(), None);
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
      if (!this->onBorder(corner))
      {
        apart.push_back(this->consider(corner, this->effectOf(fromMorton(this->shell().corners[corner]))));
      }
    }
    std::sort(apart.begin(), apart.end(), [](const Candidate& a, const Candidate& b) { return a.rank() < b.rank(); });
    std::array<std::uint32_t, 8> cells;
    for (const auto& candidate : apart)
    {
      const int count = this->Labels.cellsAround(fromMorton(this->shell().corners[candidate.corner]), cells);
      if (!this->inside(candidate.corner) && this->parts(cells, count))
      {
        this->add(candidate.corner);
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
      !paths.meet(from, to, this->Loop);
  }

  void build(const std::vector<Bridge>& bridges)
  {
    ShellPaths paths(this->shell(), this->Labels.inside());
    for (const auto& bridge : bridges)
    {
      if (!this->isNeeded(bridge, paths))
      {
        continue;
      }
      for (const std::uint64_t point : bridge)
      {
        const auto corner = this->shell().find(point);
        if (corner >= 0 && !this->inside(std::uint32_t(corner)))
        {
          this->add(std::uint32_t(corner));
        }
      }
    }
    this->settle();
  }

  static constexpr float Unknown = 1.0f; ///< no depth

  LatticeLabels& Labels;
  LabelCache Cache;
  int Loop;
  const CornerDepth* Depth;
  std::vector<float> Known; ///< by Depth, of each corner of the shell that it was asked for
  LatticeRegions Solid;
  std::vector<std::uint32_t> Lost;
  std::deque<std::uint32_t> Unsettled;
  CoveringResult Result;
};

} // namespace

CoveringResult coverSurvivors(
  LatticeLabels& labels, const std::vector<Bridge>& bridges, int loop, const CornerDepth* depth)
{
  return Covering(labels, loop, depth).run(bridges);
}

} // namespace silhouette
