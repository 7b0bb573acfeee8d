// SPDX-License-Identifier: BSD-3-Clause
/**
 * What stands around the carving in vtkSilhouetteOctreeSource: the lattice that its settings ask for, and the
 * warnings that views, lattice and octree deserve. Private to the module.
 */
#pragma once

#include "Octree.h"
#include "PreparedViewsSharing.h"
#include "TreePieces.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace silhouette::modeling
{

struct LatticeSettings
{
  int depth = 8;
  double leafEdge = 0.0; ///< above 0: decides the depth
  bool automaticBounds = true;
  std::array<double, 6> bounds{};
  int backgroundVotes = 0;
  Piece piece; ///< what is carved of the whole
};

/** The root cube and its depth. Throws InvalidInput for a setting out of range, and what automaticBounds
 * throws. */
Lattice makeLattice(const PreparedViews& views, const LatticeSettings& settings, Execution& execution);

/** Warnings that need no lattice: odd silhouettes, cameras that look away, matrices that are no cameras'; each names the view. */
std::vector<std::string> viewWarnings(const PreparedViews& views);

/** Warnings that need no octree: cameras inside the root cube, a view alone in a given box; each names the view. */
std::vector<std::string> latticeWarnings(const PreparedViews& views, const Lattice& lattice, bool automaticBounds);

/** What an octree is carved from. */
struct UsedViews
{
  SharedViews views;                     ///< those given, or dilated
  std::vector<View> dilatedViews;        ///< empty where nothing was dilated
  int dilation = 0;                      ///< px
  std::optional<double> uncovered;       ///< share of the silhouettes, where it was measured
  /** the same with the settings' background votes and without dilation */
  std::optional<double> strictUncovered;
};

/** An octree with what it was carved from. */
struct CarvedViews : UsedViews
{
  Octree octree;
};

/** What was found for the whole, for the pieces that come later. */
struct FoundWhole
{
  SharedViews given; ///< for these views, null for none,
  LatticeSettings settings; ///< and these settings, whatever their piece
  bool automaticTolerance = false;
  UsedViews used;
  Lattice lattice;
  int backgroundVotes = 0;
  std::vector<std::uint64_t> weights; ///< of the trees (TreePieces.h)

  bool isFor(const SharedViews& views, const LatticeSettings& others, bool tolerance) const;
};

/**
 * Find the lattice and carve. With `automaticTolerance`, settings.backgroundVotes are the least, and more
 * votes, or dilated silhouettes, are taken where the silhouettes are not covered (CarvingTolerance.h). What
 * views and lattice deserve as warnings goes to `warn`, before carving, and the views' before the bounds are found: where nothing
 * survives, or nothing bounds the object, these say why. Of a piece its own trees alone are carved; with `automaticTolerance` the whole is carved first, since
 * the tolerance is the whole's. What the whole came to, its lattice, division and tolerance, is left in `found`, where it serves the pieces after the first: they find and warn of
 * nothing again.
 */
CarvedViews carveViews(const SharedViews& views, const LatticeSettings& settings, bool automaticTolerance,
                       FoundWhole& found, const std::function<void(const std::string&)>& warn,
                       Execution& execution);

/** A warning where the object reaches through the root cube's border; empty where it does not. */
std::string cutByBoxWarning(const Octree& octree, const LatticeViews& views);

} // namespace silhouette::modeling
