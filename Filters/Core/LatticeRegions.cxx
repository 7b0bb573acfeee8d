// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeRegions.h"

#include "BlockBits.h"
#include "CodeCursor.h"
#include "IntersectionAround.h"
#include "LabelCache.h"
#include "MarchingCubesTable.h"
#include "OctantsAround.h"
#include "UnionFind.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <iterator>
#include <set>

namespace silhouette
{
namespace
{

constexpr std::size_t RangeGrain = 4096; ///< octants or cells worth a thread

LatticePoint lowestCell(const Octree& octree, int generation, std::size_t index)
{
  const int shift = octree.lattice.depth - generation;
  const LatticePoint p = fromMorton(octree.generations[generation].code[index]);
  return { p.i << shift, p.j << shift, p.k << shift };
}

/** Call `work(generation, index)` for every octant with this state; perhaps side by side, each range by a worker that `makeWorker` makes. */
template <typename MakeWorker>
void forOctants(const Octree& octree, OctantState state, Execution& execution, const MakeWorker& makeWorker)
{
  for (int g = octree.treeGeneration; g <= octree.lattice.depth; ++g)
  {
    const auto& states = octree.generations[g].state;
    execution.forRanges(states.size(), RangeGrain,
      [&](std::size_t first, std::size_t last)
      {
        auto work = makeWorker();
        for (std::size_t i = first; i < last; ++i)
        {
          if (states[i] == state)
          {
            work(g, i);
          }
        }
      });
  }
}

/** On the calling thread, for the octants of one state whose set is among the given ones, each named by its least member. */
template <typename Work>
void forOctantsOf(const Octree& octree, OctantState state, const std::set<std::uint32_t>& sets, LatticeRegions& regions, const Work& work)
{
  Execution alone;
  forOctants(octree, state, alone,
    [&]
    {
      return [&](int g, std::size_t i)
      {
        if (sets.count(regions.sets.find(regions.octant(g, i))))
        {
          work(g, i);
        }
      };
    });
}

LatticeRegions emptyRegions(const Octree& octree, std::size_t corners, Execution& execution)
{
  LatticeRegions regions;
  std::size_t count = corners;
  for (const auto& generation : octree.generations)
  {
    regions.firstOctant.push_back(count);
    count += generation.size();
  }
  regions.beyond = std::uint32_t(count);
  regions.sets = ConcurrentUnionFind(count + 1, execution);
  return regions;
}

/** Joins octants of one state across their faces. Every pair of neighbours is met from its smaller octant. One for each thread. */
class OctantJoining
{
public:
  /** With `beyond`, octants at the root cube's border are joined to the world beyond. Refuted ones, if any are named, join nothing. */
  OctantJoining(const Octree& octree, OctantState state, bool beyond, const std::vector<std::uint8_t>& refuted, LatticeRegions& regions)
    : Source(octree)
    , State(state)
    , Beyond(beyond)
    , Refuted(refuted)
    , Regions(regions)
    , Cursors{ OctantCursor(octree), OctantCursor(octree), OctantCursor(octree), OctantCursor(octree), OctantCursor(octree),
      OctantCursor(octree) }
  {
  }

  void operator()(int g, std::size_t i)
  {
    if (this->counts(g, i))
    {
      this->joinToSiblings(g, i);
      for (int side = 0; side < 6; ++side)
      {
        this->joinBeside(g, i, side / 2, side % 2 != 0);
      }
    }
  }

private:
  bool counts(int g, std::size_t i) const { return this->Refuted.empty() || !this->Refuted[this->Regions.place(g, i)]; }

  /** The octants of a parent are eight in a row. */
  void joinToSiblings(int g, std::size_t i)
  {
    const std::uint64_t code = this->Source.generations[g].code[i];
    for (std::size_t step = 1; g > this->Source.treeGeneration && step < 8; step *= 2)
    {
      if (!(code & step) && this->Source.generations[g].state[i + step] == this->State && this->counts(g, i + step))
      {
        this->Regions.sets.unite(this->Regions.octant(g, i), this->Regions.octant(g, i + step));
      }
    }
  }

  /** Across a face that is one of the parent's too; roots have no parent. */
  void joinBeside(int g, std::size_t i, int axis, bool ahead)
  {
    const std::uint64_t code = this->Source.generations[g].code[i];
    if (g > this->Source.treeGeneration && (code >> axis & 1) != std::uint64_t(ahead))
    {
      return;
    }
    std::uint64_t other = 0;
    const bool exists = besideBlock(code, axis, ahead, other);
    if (!exists || other >> 3 * g != 0)
    {
      if (this->Beyond)
      {
        this->Regions.sets.unite(this->Regions.octant(g, i), this->Regions.beyond);
      }
      return;
    }
    const auto found = this->Cursors[std::size_t(2 * axis + ahead)].locate(other << 3 * (this->Source.lattice.depth - g));
    if (found.generation >= 0 && found.generation <= g && found.state == this->State && this->counts(found.generation, found.index))
    {
      this->Regions.sets.unite(this->Regions.octant(g, i), this->Regions.octant(found.generation, found.index));
    }
  }

  const Octree& Source;
  OctantState State;
  bool Beyond;
  const std::vector<std::uint8_t>& Refuted;
  LatticeRegions& Regions;
  std::array<OctantCursor, 6> Cursors; ///< one for each side
};

void joinOctants(const Octree& octree, OctantState state, bool beyond, const std::vector<std::uint8_t>& refuted, LatticeRegions& regions,
  Execution& execution)
{
  forOctants(octree, state, execution, [&] { return OctantJoining(octree, state, beyond, refuted, regions); });
}

/**
 * Join an outside corner of a background octant that a field's solid reaches into: not all of its points meet in it, so with what lies beside the
 * corner along lattice edges, a corner of the shell or, standing for all other points outside, the octant.
 */
void joinWithinOctant(LabelCache& labels, CodeCursor& corners, const LatticePoint& p, std::uint32_t corner, std::uint32_t octant,
  const LatticePoint& lowest, std::int32_t size, LatticeRegions& regions)
{
  const auto within = [size](std::int32_t x, std::int32_t low) { return x >= low && x <= low + size; };
  for (const int n : EdgeNeighbours)
  {
    const LatticePoint q = neighbourOf(p, n);
    if (within(q.i, lowest.i) && within(q.j, lowest.j) && within(q.k, lowest.k) && !labels.insideAt(q))
    {
      const std::ptrdiff_t other = corners.find(mortonCode(q));
      regions.sets.unite(corner, other >= 0 ? std::uint32_t(other) : octant);
    }
  }
}

/**
 * Octants of one state that a field contradicts: the smallest at any of their corners, larger ones, of which a
 * part is still what the octree says, at all of them. Nothing where the labels have no field.
 */
std::vector<std::uint8_t> refutedOctants(const LatticeLabels& labels, OctantState state, Execution& execution)
{
  std::vector<std::uint8_t> refuted;
  if (!labels.field())
  {
    return refuted;
  }
  const Octree& octree = labels.octree();
  for (const auto& generation : octree.generations)
  {
    refuted.resize(refuted.size() + generation.size(), 0);
  }
  std::vector<std::size_t> first;
  for (const auto& generation : octree.generations)
  {
    first.push_back(first.empty() ? 0 : first.back() + (&generation - 1)->size());
  }
  forOctants(octree, state, execution,
    [&]
    {
      return [&, cache = LabelCache(labels)](int g, std::size_t i) mutable
      {
        const LatticePoint p = lowestCell(octree, g, i);
        const std::int32_t size = std::int32_t(1) << (octree.lattice.depth - g);
        int against = 0;
        for (int n = 0; n < 8; ++n)
        {
          const LatticePoint o = cornerOffset(n);
          const LatticePoint q{ p.i + size * o.i, p.j + size * o.j, p.k + size * o.k };
          against += cache.insideAt(q) != (state == OctantState::Inside);
        }
        refuted[first[g] + i] = size == 1 ? against > 0 : against == 8;
      };
    });
  return refuted;
}

/** Background octants of several leaf cells with an inside corner of the shell among their points; nothing where the labels have no field. */
std::vector<std::atomic<std::uint8_t>> enteredOctants(const LatticeLabels& labels, const LatticeRegions& regions, Execution& execution)
{
  std::vector<std::atomic<std::uint8_t>> entered(labels.field() ? regions.octants() : 0);
  if (!labels.field())
  {
    return entered;
  }
  forCorners(labels.octree(), labels.shell(), execution,
    [&]
    {
      return [&](std::size_t c, CursorsAround& octants)
      {
        if (labels.inside()[c])
        {
          forOctantsAround(octants, labels.octree(), labels.shell().corners[c], 0xff, OctantState::Background,
            [&](const Octree::Location& at)
            {
              if (at.generation < labels.octree().lattice.depth)
              {
                entered[regions.place(at.generation, at.index)].store(1, std::memory_order_relaxed);
              }
            });
        }
      };
    });
  return entered;
}

/** The diagonals of a cell's faces, as corner pairs. */
constexpr std::uint8_t FaceDiagonals[12][2] = { { 0, 6 }, { 2, 4 }, { 1, 7 }, { 3, 5 }, { 0, 5 }, { 1, 4 },
  { 2, 7 }, { 3, 6 }, { 0, 3 }, { 1, 2 }, { 4, 7 }, { 5, 6 } };

/** For each set of a cell's corners: what each of them is joined to, the lowest one that it meets within the cell. */
struct CornerJoints
{
  std::uint8_t lowest[256][8];

  /** Corners are joined along edges and, with `diagonals`, along the diagonals of faces. */
  explicit CornerJoints(bool diagonals)
  {
    for (unsigned members = 0; members < 256; ++members)
    {
      UnionFind sets(8);
      const auto join = [&](const auto& pair)
      {
        if ((members >> pair[0] & 1) != 0 && (members >> pair[1] & 1) != 0)
        {
          sets.unite(pair[0], pair[1]);
        }
      };
      std::for_each(std::begin(edgeCorners), std::end(edgeCorners), join);
      if (diagonals)
      {
        std::for_each(std::begin(FaceDiagonals), std::end(FaceDiagonals), join);
      }
      for (std::uint32_t c = 0; c < 8; ++c)
      {
        this->lowest[members][c] = std::uint8_t(sets.find(c));
      }
    }
  }
};

void joinCorners(const LatticeLabels& labels, bool inside, LatticeRegions& regions, Execution& execution)
{
  static const CornerJoints along[2] = { CornerJoints(false), CornerJoints(true) };
  const auto& lowest = along[inside].lowest;
  const auto& cells = labels.shell().cellCorners;
  execution.forRanges(cells.size(), RangeGrain,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t cell = first; cell < last; ++cell)
      {
        const auto& corners = cells[cell];
        unsigned members = 0;
        for (int c = 0; c < 8; ++c)
        {
          members |= unsigned((labels.inside()[corners[c]] != 0) == inside) << c;
        }
        for (int c = 1; c < 8; ++c)
        {
          if (lowest[members][c] != c)
          {
            regions.sets.unite(corners[lowest[members][c]], corners[c]);
          }
        }
      }
    });
}

} // namespace

LatticeRegions connectRegions(const LatticeLabels& labels, bool inside, Execution& execution)
{
  const Octree& octree = labels.octree();
  const auto& shell = labels.shell();
  const OctantState state = inside ? OctantState::Inside : OctantState::Background;
  LatticeRegions regions = emptyRegions(octree, shell.corners.size(), execution);
  const std::vector<std::uint8_t> refuted = refutedOctants(labels, state, execution);
  const auto entered =
    inside ? std::vector<std::atomic<std::uint8_t>>() : enteredOctants(labels, regions, execution);
  joinOctants(octree, state, !inside, refuted, regions, execution);
  joinCorners(labels, inside, regions, execution);
  const std::vector<std::uint8_t> around = intersectionAround(octree, shell, execution);
  const bool someTell = isWhole(octree) && refuted.empty();
  forCorners(octree, shell, execution,
    [&]
    {
      return [&, cache = LabelCache(labels), corners = CodeCursor(shell.corners)](std::size_t c, CursorsAround& octants) mutable
      {
        const LatticePoint p = fromMorton(shell.corners[c]);
        if (!inside && octree.lattice.onBorder(p))
        {
          regions.sets.unite(std::uint32_t(c), regions.beyond);
        }
        if ((labels.inside()[c] != 0) != inside)
        {
          return;
        }
        const auto meet = [&](const Octree::Location& at)
        {
          const std::uint32_t octant = regions.octant(at.generation, at.index);
          const std::size_t place = regions.place(at.generation, at.index);
          if (!entered.empty() && entered[place].load(std::memory_order_relaxed) != 0)
          {
            joinWithinOctant(cache, corners, p, std::uint32_t(c), octant, lowestCell(octree, at.generation, at.index),
              std::int32_t(1) << (octree.lattice.depth - at.generation), regions);
          }
          else if (refuted.empty() || !refuted[place])
          {
            regions.sets.unite(std::uint32_t(c), octant);
          }
        };
        if (!someTell || forOctantsAround(octants, octree, shell.corners[c], tellingCells(around[c]), state, meet) != 0)
        {
          forOctantsAround(octants, octree, shell.corners[c], std::uint8_t(~around[c]), state, meet);
        }
      };
    });
  return regions;
}

LatticeRegions connectWideOutside(const LatticeLabels& labels, int width, std::size_t others, Execution& execution)
{
  const Octree& octree = labels.octree();
  LatticeRegions regions = emptyRegions(octree, others, execution);
  std::vector<std::uint8_t> left = refutedOctants(labels, OctantState::Background, execution);
  left.resize(regions.octants(), 0);
  for (int g = octree.treeGeneration; g <= octree.lattice.depth; ++g)
  {
    if (octree.lattice.cells() >> g < width)
    {
      std::fill_n(left.begin() + std::ptrdiff_t(regions.place(g, 0)), octree.generations[g].size(), std::uint8_t(1));
    }
  }
  joinOctants(octree, OctantState::Background, true, left, regions, execution);
  return regions;
}

std::uint64_t fillCavities(LatticeLabels& labels, Execution& execution)
{
  LatticeRegions regions = connectRegions(labels, false, execution);
  const std::uint32_t beyond = regions.sets.find(regions.beyond);
  std::set<std::uint32_t> cavities;
  // A cavity's least member is a corner, as it has some and they come before all octants.
  for (std::size_t c = 0; c < labels.inside().size(); ++c)
  {
    if (!labels.inside()[c] && c != beyond && regions.sets.find(std::uint32_t(c)) == c)
    {
      cavities.insert(std::uint32_t(c));
    }
  }
  if (cavities.empty())
  {
    return 0;
  }
  for (std::size_t c = 0; c < labels.inside().size(); ++c)
  {
    if (!labels.inside()[c] && cavities.count(regions.sets.find(std::uint32_t(c))))
    {
      labels.setInside(c);
    }
  }
  forOctantsOf(labels.octree(), OctantState::Background, cavities, regions,
    [&](int g, std::size_t i) { labels.fillOctant(g, i); });
  return cavities.size();
}

std::uint64_t dropUnsupported(LatticeLabels& labels, Execution& execution)
{
  LatticeRegions regions = connectRegions(labels, true, execution);
  const auto& shell = labels.shell();
  std::set<std::uint32_t> unsupported;
  for (std::size_t c = 0; c < shell.corners.size(); ++c)
  {
    if (labels.inside()[c] && regions.sets.find(std::uint32_t(c)) == c)
    {
      unsupported.insert(std::uint32_t(c));
    }
  }
  for (std::size_t cell = 0; cell < shell.cells.size() && !unsupported.empty(); ++cell)
  {
    for (const std::uint32_t corner : shell.cellCorners[cell])
    {
      if (labels.isSurvivor(cell) && labels.inside()[corner])
      {
        unsupported.erase(regions.sets.find(corner));
      }
    }
  }
  if (!unsupported.empty())
  {
    const std::set<std::uint32_t> left = unsupported;
    forOctantsOf(labels.octree(), OctantState::Inside, left, regions,
      [&](int g, std::size_t i) { unsupported.erase(regions.sets.find(regions.octant(g, i))); });
  }
  for (std::size_t c = 0; c < shell.corners.size() && !unsupported.empty(); ++c)
  {
    if (labels.inside()[c] && unsupported.count(regions.sets.find(std::uint32_t(c))))
    {
      labels.setOutside(c);
    }
  }
  return unsupported.size();
}

LatticeRegions connectSurvivors(const Octree& octree, const CornerShell& shell, Execution& execution)
{
  LatticeRegions regions = emptyRegions(octree, shell.corners.size(), execution);
  joinOctants(octree, OctantState::Inside, false, {}, regions, execution);
  execution.forRanges(shell.cellCorners.size(), RangeGrain,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t cell = first; cell < last; ++cell)
      {
        for (const std::uint32_t corner : shell.cellCorners[cell])
        {
          regions.sets.unite(shell.cellCorners[cell][0], corner);
        }
      }
    });
  const std::vector<std::uint8_t> around = intersectionAround(octree, shell, execution);
  forCorners(octree, shell, execution,
    [&]
    {
      return [&](std::size_t c, CursorsAround& octants)
      {
        forOctantsAround(octants, octree, shell.corners[c], std::uint8_t(~around[c]), OctantState::Inside,
          [&](const Octree::Location& at) { regions.sets.unite(std::uint32_t(c), regions.octant(at.generation, at.index)); });
      };
    });
  return regions;
}

std::uint64_t countSurvivorComponents(const Octree& octree, Execution& execution)
{
  const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
  LatticeRegions regions = connectSurvivors(octree, shell, execution);
  std::uint64_t components = 0;
  for (std::uint32_t c = 0; c < shell.corners.size(); ++c)
  {
    components += regions.sets.find(c) == c;
  }
  Execution alone;
  forOctants(octree, OctantState::Inside, alone,
    [&]
    {
      return [&](int g, std::size_t i)
      {
        const std::uint32_t octant = regions.octant(g, i);
        components += regions.sets.find(octant) == octant;
      };
    });
  return components;
}

} // namespace silhouette
