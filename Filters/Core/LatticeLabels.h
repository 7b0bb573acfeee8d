// SPDX-License-Identifier: BSD-3-Clause
/**
 * Labels of lattice corners: kept for the corners of a shell of cells, the octree's last-generation intersection
 * octants and whatever further cells are asked for, and read off the octree everywhere else.
 */
#pragma once

#include "LabelBlocks.h"
#include "Mesh.h"
#include "PreparedViews.h"

#include <memory>
#include <vector>

namespace silhouette
{

/** A surface point's place on the lattice. */
struct LatticeCrossing
{
  std::uint64_t edge = 0; ///< 4 times the Morton code of the edge's lower end, plus its axis
  double fraction = 0.0;  ///< from the lower end, in (0, 1)
};

/** Name of the lattice edge that starts at `lower` along `axis`. */
inline std::uint64_t edgeKey(std::uint64_t lower, int axis)
{
  return lower << 2 | std::uint64_t(axis);
}

/** The crossings of a surface whose points lie on lattice edges, ascending by edge. */
struct SurfaceCrossings
{
  std::vector<LatticeCrossing> crossings;
  std::vector<std::uint8_t> lowerInside; ///< for each, 1 where the edge's lower end is the inside one; empty where that was not asked for
  std::uint64_t ignoredPoints = 0;       ///< points that lie on no lattice edge

  /** Index of an edge's crossing, or -1. */
  std::ptrdiff_t find(std::uint64_t edge) const;
};

/** Is it to be found which end of a crossed edge is inside? */
enum class CrossingSides
{
  Located,
  NotLocated
};

/**
 * Find the points' lattice edges (to within 1e-3 of an edge), and from the triangles' normals, if that is asked for, which end is inside. Cost: linear,
 * for a surface whose points are not in the edges' order n log n.
 */
SurfaceCrossings locateCrossings(const Mesh& surface, const Lattice& lattice, CrossingSides sides, Execution& execution);

/** The inside votes of the shell's corners, as CornerVotes.h tells. */
std::vector<std::uint16_t> shellVotes(
  const Octree& octree, const CornerShell& shell, const LatticeViews& views, Execution& execution);

class LatticeLabels
{
public:
  /** Labels by votes: inside iff at most the octree's k views say background, not on the root cube's border. */
  LatticeLabels(const Octree& octree, CornerShell shell, const PreparedViews& views, Execution& execution);
  /** The same by votes that are known: those of the shell's corners, by the octree's views. */
  LatticeLabels(const Octree& octree, CornerShell shell, const std::vector<std::uint16_t>& votes, Execution& execution);
  /**
   * Labels without views: corners of inside octants are inside, those of background octants outside; the rest by
   * the surface's crossings, and where an edge has none its ends are alike. What stays unknown is outside.
   */
  LatticeLabels(const Octree& octree, CornerShell shell, const SurfaceCrossings& crossings);

  /**
   * Labels by a field, inside where it is positive; by the octree where the field has no values. The shell has
   * to hold every cell with corners of both signs, and those outside by the field in an inside octant.
   */
  LatticeLabels(const Octree& octree, CornerShell shell, const BrickField& field, Execution& execution);

  /** Take these cells (Morton codes, ascending) for the survivors, instead of the octree's intersection octants. */
  void setSurvivors(const std::vector<std::uint64_t>& cells, Execution& execution);

  const Octree& octree() const { return this->Far.octree(); }
  const BrickField* field() const { return this->Far.field(); }
  const CornerShell& shell() const { return this->Shell; }
  const std::vector<std::uint8_t>& inside() const { return this->Inside; }
  /**
   * How much speaks for the shell's corners being inside: the field, else their inside votes; all 0 where there
   * are neither.
   */
  const std::vector<float>& support() const { return this->Support; }

  /** Label a corner of the shell inside. */
  void setInside(std::size_t corner) { this->Inside[corner] = 1; }
  void setOutside(std::size_t corner) { this->Inside[corner] = 0; }
  /** Label a background octant's corners inside, as part of a filled cavity. */
  void fillOctant(int generation, std::size_t index);

  /**
   * Take a shell that holds all cells of this one; labels, survivors and support stay, further corners get the
   * labels they have.
   */
  void widen(CornerShell shell, Execution& execution);

  /**
   * Where labels may differ from one point to the next. Made when first it is asked for, and again where the shell or an octant has changed: to be asked for by one thread at a
   * time. What the labels say about points and blocks is told faster with it.
   */
  const LabelBlocks& blocks(Execution& execution) const;

  /** Label of any lattice point. */
  bool insideAt(const LatticePoint& p) const;
  /** Labels of the 4 x 4 x 4 points of Morton codes 64 `block` to 64 `block` + 63, a bit each, the first the lowest; 1 inside. */
  std::uint64_t insideOfBlock(std::uint64_t block) const;
  /** The same for many blocks, ascending. Cost: linear. */
  std::vector<std::uint64_t> insideOfBlocks(const std::vector<std::uint64_t>& blocks, Execution& execution) const;
  /** Is a cell of the shell an intersection octant, and not a further cell? */
  bool isSurvivor(std::size_t cell) const { return this->Survivor[cell] != 0; }
  /** Numbers of the surviving cells of the shell around a lattice point, at most eight; returns how many. */
  int cellsAround(const LatticePoint& p, std::array<std::uint32_t, 8>& cells) const;

private:
  using Corner = std::vector<std::uint64_t>::const_iterator;
  std::uint64_t insideOfBlock(std::uint64_t block, Corner& corner, OctantCursor& octants) const;
  void labelByVotes(const std::vector<std::uint16_t>& votes, Execution& execution);
  void fromOctree();
  void spread(const SurfaceCrossings& crossings);

  FarLabels Far; ///< of other points than the shell's corners
  CornerShell Shell;
  std::vector<std::uint8_t> Inside;
  std::vector<std::uint8_t> Survivor;
  std::vector<float> Support;
  mutable std::shared_ptr<const LabelBlocks> Blocks; ///< or nothing
};

} // namespace silhouette
