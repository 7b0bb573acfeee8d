// SPDX-License-Identifier: BSD-3-Clause
/**
 * What stands around the carving in vtkSilhouetteOctreeSource: the lattice that its settings ask for, and the
 * warnings that views, lattice and octree deserve. Private to the module.
 */
#pragma once

#include "Octree.h"
#include "PreparedViews.h"

#include <array>
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
};

/** The root cube and its depth. Throws InvalidInput for a setting out of range, and what automaticBounds
 * throws. */
Lattice makeLattice(const PreparedViews& views, const LatticeSettings& settings, Execution& execution);

/** Warnings that need no octree; each names the view. */
std::vector<std::string> viewWarnings(const PreparedViews& views, const Lattice& lattice,
                                      bool automaticBounds);

/** A warning where the object reaches through the root cube's border; empty where it does not. */
std::string cutByBoxWarning(const Octree& octree, const LatticeViews& views);

} // namespace silhouette::modeling
