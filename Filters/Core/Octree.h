// SPDX-License-Identifier: BSD-3-Clause
/**
 * The octree of the silhouettes (METHOD: section 1 of Documentation/method.md) as a linear octree: a sorted
 * array of octants for each generation. No pointers: the children of the r-th intersection octant of a
 * generation are the octants 8 r to 8 r + 7 of the next one.
 */
#pragma once

#include "Bits.h"
#include "Lattice.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace silhouette
{

enum class OctantState : std::uint8_t
{
  Background = 0,   ///< carved
  Intersection = 1, ///< subdivided; in the last generation: holds the surface
  Inside = 2        ///< wholly object
};

/** What a view says beyond the sides of its image. */
enum class OutsidePolicy : std::uint8_t
{
  Border = 0,    ///< abstains beyond a side whose outermost row or column holds an object pixel, else background
  Unknown = 1,   ///< abstains
  Background = 2 ///< background
};

/** The octants of one generation, in Morton order. */
struct Generation
{
  std::vector<std::uint64_t> code;       ///< Morton code of the octant's coordinates within its generation
  std::vector<OctantState> state;        ///< same length
  std::vector<std::uint32_t> childBlock; ///< rank of the octant among the intersection octants before it

  std::size_t size() const { return this->code.size(); }
};

/** Exact counts of what the carving did. The octants of the coarse carve of automatic bounds are not in it. */
struct CarveStatistics
{
  std::uint64_t octantsTested = 0;
  std::uint64_t viewTests = 0;              ///< (octant, view) pairs that were classified
  std::vector<double> carvedByView;         ///< for each view the share of the root cube that it carved
};

/**
 * What the carving knew of the parents of the last generation: for each intersection octant of the last generation
 * but one, in order, what its descendants inherit. A view that is in no list is settled: it calls all of the octant
 * object, or all of it background, or says nothing about it.
 */
struct UndecidedViews
{
  std::vector<std::size_t> first;           ///< into views; one more than there are octants; empty: not known
  std::vector<std::uint16_t> views;         ///< ascending for each octant
  std::vector<std::uint16_t> backgroundVotes; ///< views that call all of the octant background
  std::vector<std::uint8_t> seen;           ///< 1 where some view sees all of the octant
  /** For each octant of the last generation which of the first 16 of its parent's views are undecided about itself. */
  std::vector<std::uint16_t> among;
};

/** Whom to ask about the points of an octant, and what the other views have said of all of it. */
struct ViewsToAsk
{
  static constexpr std::size_t Chosen = 16; ///< so many views are chosen from one by one

  const std::uint16_t* views = nullptr;
  std::size_t count = 0;
  int backgroundVotes = 0;     ///< of the others
  bool seen = false;           ///< one of the others sees all of the octant
  std::uint16_t among = 0xffff; ///< where there are at most 16 views: which of them need be asked

  /** Call ask(view) for each view that need be asked, in order. */
  template <typename Ask> void forEach(const Ask& ask) const
  {
    if (this->count > Chosen)
    {
      for (std::size_t n = 0; n < this->count; ++n)
      {
        ask(int(this->views[n]));
      }
      return;
    }
    for (unsigned left = this->among & ((1u << this->count) - 1); left != 0; left &= left - 1)
    {
      ask(int(this->views[lowestBit(left)]));
    }
  }
};

/** Inside votes by corners, once somebody has counted them. Copies share them. May be asked and told by several threads at once. */
class KnownVotes
{
public:
  using Votes = std::shared_ptr<const std::vector<std::uint16_t>>;

  KnownVotes() = default;
  KnownVotes(const KnownVotes& other)
    : Known(other.get())
  {
  }
  KnownVotes& operator=(const KnownVotes& other)
  {
    this->set(other.get());
    return *this;
  }

  /** Nothing where they are not known. */
  Votes get() const { return std::atomic_load(&this->Known); }
  void set(Votes votes) const { std::atomic_store(&this->Known, std::move(votes)); }

private:
  mutable Votes Known;
};

struct Octree
{
  Lattice lattice;
  int treeGeneration = 0;  ///< generation of the roots: 2^treeGeneration trees a side
  int viewCount = 0;       ///< m
  int backgroundVotes = 0; ///< k: an octant is background iff more than k views say so
  OutsidePolicy outside = OutsidePolicy::Border;
  std::uint64_t fingerprint = 0;       ///< of the views and policies it was carved from
  std::vector<Generation> generations; ///< index is the generation; empty below treeGeneration
  CarveStatistics statistics;
  UndecidedViews undecided;            ///< spares whoever asks about corners most of the views; may be empty
  /** By the octree's own views, of the corners of the last generation's intersection octants; void where the state of one of these is changed. */
  KnownVotes votes;

  const Generation& last() const { return this->generations.back(); }
  std::size_t count(OctantState state, int generation) const;
  /** The smallest octant that holds leaf cell `cell`: its generation, or -1 where no tree of it was carved. */
  struct Location
  {
    int generation = -1;
    std::size_t index = 0;
    OctantState state = OctantState::Background;
  };
  Location locate(const LatticePoint& cell) const;
  /** Is one of the eight octants around a lattice point wholly inside? */
  bool touchesInside(const LatticePoint& p) const;
};

/**
 * Octree::locate() for cells near one another: each is looked for from the octant on that holds it and the one before.
 * Not for several threads at once. The octree has to outlive it.
 */
class OctantCursor
{
public:
  explicit OctantCursor(const Octree& octree)
    : Source(&octree)
  {
  }

  Octree::Location locate(const LatticePoint& cell);
  /** The same by the Morton code of a cell of the lattice, of an octree that has octants. */
  Octree::Location locate(std::uint64_t leaf);
  /**
   * Of the 4 x 4 x 4 leaf cells of Morton codes 64 `block` to 64 `block` + 63, a bit each, those for whose octant `is(location)` holds. Octants are asked
   * about once, but for the smallest, which are asked about one by one. Cells of no tree and beyond the lattice have generation -1.
   */
  template <typename Is> std::uint64_t cellsOfBlock(std::uint64_t block, const Is& is);

private:
  const Octree* Source;
  std::uint64_t Leaf = 0;
  int Deepest = -1; ///< generation of the octant found last; -1 where none is
  std::array<std::size_t, MaximumDepth + 1> Index{}; ///< of that octant and of those that it lies in
};

template <typename Is> std::uint64_t OctantCursor::cellsOfBlock(std::uint64_t block, const Is& is)
{
  const int depth = this->Source->lattice.depth;
  std::uint64_t cells = 0;
  for (unsigned child = 0; child < 8; ++child)
  {
    auto octant = this->locate(fromMorton(64 * block + 8 * child));
    const int halvings = depth - octant.generation; // that are left
    if (child == 0 && octant.generation >= 0 && halvings >= 2)
    {
      return is(octant) ? ~std::uint64_t(0) : 0;
    }
    if (octant.generation < 0 || halvings >= 1)
    {
      cells |= std::uint64_t(is(octant) ? 0xff : 0) << 8 * child;
      continue;
    }
    for (unsigned n = 0; n < 8; ++n, ++octant.index)
    {
      octant.state = this->Source->last().state[octant.index];
      cells |= std::uint64_t(is(octant)) << (8 * child + n);
    }
  }
  return cells;
}

} // namespace silhouette
