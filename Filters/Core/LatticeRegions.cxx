// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeRegions.h"

#include "BlockBits.h"
#include "LabelCache.h"
#include "MarchingCubesTable.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

namespace silhouette
{
namespace
{

LatticePoint lowestCell(const Octree& octree, int generation, std::size_t index)
{
  const int shift = octree.lattice.depth - generation;
  const LatticePoint p = fromMorton(octree.generations[generation].code[index]);
  return { p.i << shift, p.j << shift, p.k << shift };
}

/** Call `work(generation, index)` for every leaf octant with one of two states. */
template <typename Work>
void forOctants(const Octree& octree, OctantState state, const Work& work)
{
  for (int g = octree.treeGeneration; g <= octree.lattice.depth; ++g)
  {
    const auto& states = octree.generations[g].state;
    for (std::size_t i = 0; i < states.size(); ++i)
    {
      if (states[i] == state)
      {
        work(g, i);
      }
    }
  }
}

LatticeRegions emptyRegions(const Octree& octree, std::size_t corners)
{
  LatticeRegions regions;
  std::size_t count = corners;
  for (const auto& generation : octree.generations)
  {
    regions.firstOctant.push_back(count);
    count += generation.size();
  }
  regions.beyond = std::uint32_t(count);
  regions.sets = UnionFind(count + 1);
  return regions;
}

/** Joins octants of one state across their faces. Every pair of neighbours is met from its smaller octant. */
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

  void run()
  {
    forOctants(this->Source, this->State,
      [&](int g, std::size_t i)
      {
        if (this->counts(g, i))
        {
          this->joinToSiblings(g, i);
          for (int side = 0; side < 6; ++side)
          {
            this->joinBeside(g, i, side / 2, side % 2 != 0);
          }
        }
      });
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

void joinOctants(const Octree& octree, OctantState state, bool beyond, const std::vector<std::uint8_t>& refuted, LatticeRegions& regions)
{
  OctantJoining(octree, state, beyond, refuted, regions).run();
}

/** One for each cell around a corner: going through corners in Morton order, each stays in the same octants for long. */
using CursorsAround = std::array<OctantCursor, 8>;

CursorsAround cursorsAround(const Octree& octree)
{
  const OctantCursor c(octree);
  return { c, c, c, c, c, c, c, c };
}

/** For each corner of the shell: which of the eight cells around it are intersection octants, a bit each. */
std::vector<std::uint8_t> intersectionAround(const Octree& octree, const CornerShell& shell)
{
  std::vector<std::uint8_t> around(shell.corners.size(), 0);
  const Generation& leaves = octree.last();
  std::size_t leaf = 0;
  for (std::size_t cell = 0; cell < shell.cells.size(); ++cell)
  {
    while (leaf < leaves.size() && leaves.code[leaf] < shell.cells[cell])
    {
      ++leaf;
    }
    if (leaf < leaves.size() && leaves.code[leaf] == shell.cells[cell] && leaves.state[leaf] == OctantState::Intersection)
    {
      for (int c = 0; c < 8; ++c)
      {
        around[shell.cellCorners[cell][c]] |= std::uint8_t(1 << c);
      }
    }
  }
  return around;
}

/**
 * Join an outside corner of a background octant that a field's solid reaches into: not all of its points meet in it, so with what lies beside the
 * corner along lattice edges, a corner of the shell or, standing for all other points outside, the octant.
 */
void joinWithinOctant(const LatticeLabels& labels, const LatticePoint& p, std::uint32_t corner, std::uint32_t octant,
  const LatticePoint& lowest, std::int32_t size, LatticeRegions& regions)
{
  const auto within = [size](std::int32_t x, std::int32_t low) { return x >= low && x <= low + size; };
  for (const int n : EdgeNeighbours)
  {
    const LatticePoint q = neighbourOf(p, n);
    if (within(q.i, lowest.i) && within(q.j, lowest.j) && within(q.k, lowest.k) && !labels.insideAt(q))
    {
      const std::ptrdiff_t other = labels.shell().find(mortonCode(q));
      regions.sets.unite(corner, other >= 0 ? std::uint32_t(other) : octant);
    }
  }
}

/**
 * Call `meet(location)` for the octants of one state that touch a lattice point; `others`, a bit for each cell around it, are known to have another
 * state. Cells of one parent are looked for once.
 */
template <typename Meet>
void forOctantsAround(
  CursorsAround& octants, const Octree& octree, std::uint64_t corner, std::uint8_t others, OctantState state, const Meet& meet)
{
  const Lattice& lattice = octree.lattice;
  if (others == 0xff)
  {
    return;
  }
  const LatticePoint p = fromMorton(corner);
  const bool onBorder = lattice.onBorder(p);
  const unsigned odd = unsigned(corner & 7); // on these axes the cells on either side have one parent
  std::array<Octree::Location, 8> firsts;
  unsigned known = 0;
  for (unsigned n = 0; n < 8; ++n)
  {
    if (others >> n & 1)
    {
      continue;
    }
    const unsigned first = n | odd;
    if (!(known >> first & 1))
    {
      known |= 1u << first;
      const LatticePoint o = cornerOffset(int(first));
      const LatticePoint cell{ p.i - o.i, p.j - o.j, p.k - o.k };
      firsts[first] = onBorder ? octants[first].locate(cell) : octants[first].locate(mortonCode(cell));
    }
    Octree::Location location = firsts[first];
    if (location.generation == lattice.depth)
    {
      location.index += first & ~n;
      location.state = octree.last().state[location.index];
    }
    if (location.generation >= 0 && location.state == state)
    {
      meet(location);
    }
  }
}

/**
 * Octants of one state that a field contradicts: the smallest at any of their corners, larger ones, of which a
 * part is still what the octree says, at all of them. Nothing where the labels have no field.
 */
std::vector<std::uint8_t> refutedOctants(const LatticeLabels& labels, OctantState state)
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
  LabelCache cache(labels);
  forOctants(octree, state,
    [&](int g, std::size_t i)
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
    });
  return refuted;
}

/** Background octants of several leaf cells with an inside corner of the shell among their points; nothing where the labels have no field. */
std::vector<std::uint8_t> enteredOctants(const LatticeLabels& labels, const LatticeRegions& regions)
{
  std::vector<std::uint8_t> entered;
  if (!labels.field())
  {
    return entered;
  }
  entered.resize(regions.octants(), 0);
  CursorsAround octants = cursorsAround(labels.octree());
  for (std::size_t c = 0; c < labels.shell().corners.size(); ++c)
  {
    if (labels.inside()[c])
    {
      forOctantsAround(octants, labels.octree(), labels.shell().corners[c], 0, OctantState::Background,
        [&](const Octree::Location& at)
        {
          if (at.generation < labels.octree().lattice.depth)
          {
            entered[regions.place(at.generation, at.index)] = 1;
          }
        });
    }
  }
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

void joinCorners(const LatticeLabels& labels, bool inside, LatticeRegions& regions)
{
  static const CornerJoints along[2] = { CornerJoints(false), CornerJoints(true) };
  const auto& lowest = along[inside].lowest;
  for (const auto& corners : labels.shell().cellCorners)
  {
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
}

} // namespace

LatticeRegions connectRegions(const LatticeLabels& labels, bool inside)
{
  const Octree& octree = labels.octree();
  const auto& shell = labels.shell();
  const OctantState state = inside ? OctantState::Inside : OctantState::Background;
  LatticeRegions regions = emptyRegions(octree, shell.corners.size());
  const std::vector<std::uint8_t> refuted = refutedOctants(labels, state);
  const std::vector<std::uint8_t> entered = inside ? std::vector<std::uint8_t>() : enteredOctants(labels, regions);
  joinOctants(octree, state, !inside, refuted, regions);
  joinCorners(labels, inside, regions);
  CursorsAround octants = cursorsAround(octree);
  const std::vector<std::uint8_t> around = intersectionAround(octree, shell);
  for (std::size_t c = 0; c < shell.corners.size(); ++c)
  {
    const LatticePoint p = fromMorton(shell.corners[c]);
    if (!inside && octree.lattice.onBorder(p))
    {
      regions.sets.unite(std::uint32_t(c), regions.beyond);
    }
    if ((labels.inside()[c] != 0) == inside)
    {
      forOctantsAround(octants, octree, shell.corners[c], around[c], state,
        [&](const Octree::Location& at)
        {
          const std::uint32_t octant = regions.octant(at.generation, at.index);
          const std::size_t place = regions.place(at.generation, at.index);
          if (!entered.empty() && entered[place])
          {
            joinWithinOctant(labels, p, std::uint32_t(c), octant, lowestCell(octree, at.generation, at.index),
              std::int32_t(1) << (octree.lattice.depth - at.generation), regions);
          }
          else if (refuted.empty() || !refuted[place])
          {
            regions.sets.unite(std::uint32_t(c), octant);
          }
        });
    }
  }
  return regions;
}

LatticeRegions connectWideOutside(const LatticeLabels& labels, int width)
{
  const Octree& octree = labels.octree();
  LatticeRegions regions = emptyRegions(octree, labels.shell().corners.size());
  std::vector<std::uint8_t> left = refutedOctants(labels, OctantState::Background);
  left.resize(regions.octants(), 0);
  forOctants(octree, OctantState::Background,
    [&](int g, std::size_t i)
    {
      if (octree.lattice.cells() >> g < width)
      {
        left[regions.place(g, i)] = 1;
      }
    });
  joinOctants(octree, OctantState::Background, true, left, regions);
  return regions;
}

std::uint64_t fillCavities(LatticeLabels& labels)
{
  const Octree& octree = labels.octree();
  LatticeRegions regions = connectRegions(labels, false);
  const std::uint32_t beyond = regions.sets.find(regions.beyond);
  std::set<std::uint32_t> cavities;
  for (std::size_t c = 0; c < labels.inside().size(); ++c)
  {
    const std::uint32_t region = regions.sets.find(std::uint32_t(c));
    if (!labels.inside()[c] && region != beyond)
    {
      cavities.insert(region);
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
  forOctants(octree, OctantState::Background,
    [&](int g, std::size_t i)
    {
      if (cavities.count(regions.sets.find(regions.octant(g, i))))
      {
        labels.fillOctant(g, i);
      }
    });
  return cavities.size();
}

std::uint64_t dropUnsupported(LatticeLabels& labels)
{
  const Octree& octree = labels.octree();
  LatticeRegions regions = connectRegions(labels, true);
  std::set<std::uint32_t> supported;
  const auto& shell = labels.shell();
  for (std::size_t cell = 0; cell < shell.cells.size(); ++cell)
  {
    for (const std::uint32_t corner : shell.cellCorners[cell])
    {
      if (labels.isSurvivor(cell) && labels.inside()[corner])
      {
        supported.insert(regions.sets.find(corner));
      }
    }
  }
  forOctants(octree, OctantState::Inside,
    [&](int g, std::size_t i) { supported.insert(regions.sets.find(regions.octant(g, i))); });
  std::set<std::uint32_t> dropped;
  for (std::size_t c = 0; c < shell.corners.size(); ++c)
  {
    const std::uint32_t region = regions.sets.find(std::uint32_t(c));
    if (labels.inside()[c] && !supported.count(region))
    {
      dropped.insert(region);
    }
  }
  for (std::size_t c = 0; c < shell.corners.size() && !dropped.empty(); ++c)
  {
    if (labels.inside()[c] && dropped.count(regions.sets.find(std::uint32_t(c))))
    {
      labels.setOutside(c);
    }
  }
  return dropped.size();
}

LatticeRegions connectSurvivors(const Octree& octree, const CornerShell& shell)
{
  LatticeRegions regions = emptyRegions(octree, shell.corners.size());
  joinOctants(octree, OctantState::Inside, false, {}, regions);
  for (const auto& corners : shell.cellCorners)
  {
    for (const std::uint32_t corner : corners)
    {
      regions.sets.unite(corners[0], corner);
    }
  }
  CursorsAround octants = cursorsAround(octree);
  const std::vector<std::uint8_t> around = intersectionAround(octree, shell);
  for (std::size_t c = 0; c < shell.corners.size(); ++c)
  {
    forOctantsAround(octants, octree, shell.corners[c], around[c], OctantState::Inside,
      [&](const Octree::Location& at)
      { regions.sets.unite(std::uint32_t(c), regions.octant(at.generation, at.index)); });
  }
  return regions;
}

std::uint64_t countSurvivorComponents(const Octree& octree, Execution& execution)
{
  const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
  LatticeRegions regions = connectSurvivors(octree, shell);
  std::set<std::uint32_t> components;
  for (std::size_t c = 0; c < shell.corners.size(); ++c)
  {
    components.insert(regions.sets.find(std::uint32_t(c)));
  }
  forOctants(octree, OctantState::Inside,
    [&](int g, std::size_t i)
    { components.insert(regions.sets.find(regions.octant(g, i))); });
  return components.size();
}

} // namespace silhouette
