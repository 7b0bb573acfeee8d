// SPDX-License-Identifier: BSD-3-Clause
/**
 * The local hull surfacer (Documentation/method.md, section 4): from an imperfect marching-cubes surface and the
 * octree, a surface that is closed, oriented outwards, edge- and vertex-manifold, free of self-intersections,
 * that crosses or encloses every last-generation octant that survived the carving, and that has no more
 * components than the survivors (26-neighbourhood).
 */
#pragma once

#include "FieldCorrection.h"
#include "HandleJoining.h"
#include "HullChains.h"
#include "LocalHulls.h"
#include "Mesh.h"
#include "Octree.h"
#include "PreparedViews.h"
#include "SilhouetteRepair.h"
#include "SliceRegions.h"
#include "SurvivorIslands.h"
#include "ThinHulls.h"
#include "TunnelFilling.h"

namespace silhouette
{

enum class LocalHullMode : int
{
  Robust = 0, ///< consistent labels, corrected by what the views agree on; every survivor covered
  Thesis = 1  ///< one hull for each chain of slices, combined
};

struct LocalHullOptions
{
  LocalHullMode mode = LocalHullMode::Robust;
  bool fillCavities = true;   ///< label cavities inside; without it a cavity's wall is one more component
  double coverOffset = 0.03;  ///< in octants, 0.01 to 0.99: how far the surface stands off a covering corner
  int bridgeGap = 2;          ///< in octants, 0 or more: survivors' components no further apart are joined; larger joins more
  bool singlePrecision = false; ///< round points to float, and promise it for these
  /**
   * 0 to 1: islands, components of the survivors with fewer octants than this share of the largest one's, are given
   * up and counted; 0 keeps all, larger drops larger ones. Above 0, where silhouettes are repaired, so is debris: octants of the last
   * generation that only pixels uphold which the repair finds false. Islands are then those of what is left.
   */
  double islandShare = 0.0;
  /**
   * Robust, with views: repair speckles, filled in the object and erased in the background, and what a single view cuts deep and wide out of
   * the object, filled.
   */
  bool repairSilhouettes = true;
  bool thinHulls = true;         ///< Robust, with views: round thin parts into hulls of the balls that fit into them
  SilhouetteRepairOptions repair;
  FieldCorrectionOptions correction; ///< Robust, with views
  ThinHullOptions thin;
  TunnelFillingOptions tunnels; ///< Robust
  HandleJoiningOptions handles; ///< Robust, with views
  SliceOptions slices; ///< Thesis
  ChainOptions chains; ///< Thesis
  LocalHullsOptions hulls;
};

/** The surface and what was done for it. */
struct LocalHullSurface
{
  Mesh mesh;
  std::uint64_t survivors = 0;       ///< last-generation octants that survived, inside ones too
  std::uint64_t coveredOctants = 0;  ///< survivors that had no inside corner
  std::uint64_t coveringCorners = 0; ///< corners labelled inside to cover or to join
  std::uint64_t bridges = 0;         ///< joints between components of the survivors
  std::uint64_t cavitiesFilled = 0;  ///< cavities that were labelled inside
  std::uint64_t handleCorners = 0;   ///< corners that were labelled inside to join handles that noise had cut
  std::uint64_t tunnelCorners = 0;   ///< corners that were labelled inside to fill narrow tunnels
  std::uint64_t ignoredPoints = 0;   ///< points of the imperfect surface that lie on no lattice edge
  std::uint64_t thinHulls = 0;       ///< hulls that thin parts were rounded into
  std::uint64_t movedToHulls = 0;    ///< points moved for it
  DroppedSurvivors dropped;          ///< survivors given up as islands and debris
  double deficit = 0.0;              ///< octants: the silhouettes' mean deficit before any correction; 0 without views
  double shift = 0.0;                ///< octants: the mean shift of their contours against the surface's; 0 without views
  double alignment = 0.0;            ///< px, the mean length of the views' shifts; 0 where they were not shifted
  std::uint64_t repairedPixels = 0;  ///< pixels of the silhouettes that were changed: filled, or erased as salt
  std::uint64_t movedToMiddle = 0;   ///< points moved to the middle of their edge against a self-intersection
};

/**
 * Make `imperfect` whole. With views, labels come from the octree and the votes, crossings from the surface where it has
 * them and else from the views; without, both come from octree and surface. Throws InvalidInput where the
 * views are not the octree's or an option is out of range, Cancelled. Cost: linear in the octree and the surface.
 */
LocalHullSurface localHullSurface(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution);

/**
 * The same with nothing corrected and every point on its lattice edge: what the Thesis mode takes its points from, and what
 * thesisHullSurface() asks for. Errors and cost as above.
 */
LocalHullSurface coveredSurface(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution);

/** The local hulls themselves, classified on the imperfect surface. */
std::vector<LocalHull> classifyLocalHulls(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution);

} // namespace silhouette
