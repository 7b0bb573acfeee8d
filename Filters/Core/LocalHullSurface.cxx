// SPDX-License-Identifier: BSD-3-Clause
#include "LocalHullSurface.h"

#include "CellSafety.h"
#include "CodeCursor.h"
#include "CrossingPlacer.h"
#include "IndicesWhere.h"
#include "LabelCache.h"
#include "LatticeRegions.h"
#include "LatticeSurface.h"
#include "MeshComponents.h"
#include "ParameterRange.h"
#include "RobustLabels.h"
#include "SurvivorBridges.h"
#include "SurvivorCovering.h"
#include "ThesisHullSurface.h"
#include "ThinHullFitting.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace silhouette
{
namespace
{

constexpr double CoverReach = 3.0; ///< octants: corners farther outside than that are alike

void check(const Octree& octree, const PreparedViews* views, const LocalHullOptions& options)
{
  if (views && octree.fingerprint != views->fingerprint())
  {
    throw InvalidInput("the octree was carved from other views, or with another policy outside the image");
  }
  requireRange("cover offset", options.coverOffset, CrossingMargin, 1.0 - CrossingMargin);
  requireRange("island share", options.islandShare, 0.0, 1.0);
  requireRange("bridge gap", options.bridgeGap, 0);
  checkThinHullOptions(options.thin); // whether anything is thin or not
}

std::vector<std::uint64_t> codesOf(const CornerShell& shell, const std::vector<std::uint32_t>& corners)
{
  std::vector<std::uint64_t> codes;
  for (const std::uint32_t corner : corners)
  {
    codes.push_back(shell.corners[corner]);
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

/** The shell of the survivors, their components and what bridges these. */
struct Survivors
{
  const Octree& octree;
  CornerShell shell;
  std::uint64_t components; ///< before they are bridged
  std::vector<Bridge> bridges;
  std::vector<std::uint64_t> bridgePoints;

  /** `intersection` is the shell of the octree's intersection octants. */
  Survivors(const Octree& carved, CornerShell intersection, int bridgeGap, Execution& execution)
    : octree(carved)
    , shell(std::move(intersection))
  {
    BlockRegions connected = connectSurvivors(carved, execution);
    this->components = connected.count();
    this->bridges = bridgeSurvivors(carved.lattice, this->shell, connected, bridgeGap, execution);
    for (const auto& bridge : this->bridges)
    {
      this->bridgePoints.insert(this->bridgePoints.end(), bridge.begin(), bridge.end());
    }
  }

  void count(LocalHullSurface& surface) const
  {
    surface.bridges = this->bridges.size();
    surface.survivors = this->octree.count(OctantState::Intersection, this->octree.lattice.depth) +
      this->octree.count(OctantState::Inside, this->octree.lattice.depth);
  }
};

/** Have the labels' shell hold the cells around some lattice points; the covered cells' numbers go with it. */
void widenAround(LatticeLabels& labels, CoveringResult& covering, const std::vector<std::uint64_t>& points, Execution& execution)
{
  const auto missing = cellsMissingAround(labels.shell(), points, execution);
  if (missing.empty())
  {
    return;
  }
  std::vector<std::uint64_t> covered;
  for (const std::uint32_t cell : covering.coveredCells)
  {
    covered.push_back(labels.shell().cells[cell]);
  }
  labels.widen(withCells(labels.shell(), missing, execution), execution);
  CodeCursor cells(labels.shell().cells);
  std::transform(covered.begin(), covered.end(), covering.coveredCells.begin(), [&](std::uint64_t cell) { return std::uint32_t(cells.find(cell)); });
}

/** Label lattice points inside, the shell being widened around these and, where it is widened at all, around others. */
void labelInside(LatticeLabels& labels, CoveringResult& covering, const std::vector<std::uint64_t>& points,
  const std::vector<std::uint64_t>& others, Execution& execution)
{
  if (points.empty())
  {
    return;
  }
  std::vector<std::uint64_t> all = points;
  all.insert(all.end(), others.begin(), others.end());
  widenAround(labels, covering, all, execution);
  for (const std::uint64_t point : points)
  {
    labels.setInside(std::size_t(labels.shell().find(point)));
  }
}

/**
 * Join handles that noise has cut, and fill narrow tunnels; returns the corners that were labelled inside. `added`: the covering ones, around which the shell will be
 * widened.
 */
std::vector<std::uint64_t> mendTopology(LatticeLabels& labels, CoveringResult& covering, const std::vector<std::uint64_t>& added,
  const LocalHullOptions& options, LocalHullSurface& surface, Execution& execution)
{
  Phase joining(execution, 0.0, 0.5);
  std::vector<std::uint64_t> points = handleJoints(labels, surface.deficit, options.handles, joining);
  surface.handleCorners = points.size();
  labelInside(labels, covering, points, {}, execution);
  Phase filling(execution, 0.5, 1.0);
  const auto walls = tunnelWalls(labels, options.tunnels, filling);
  surface.tunnelCorners = walls.size();
  labelInside(labels, covering, walls, added, execution);
  points.insert(points.end(), walls.begin(), walls.end());
  return points;
}

/** What of the covering is thin: no corner within an octant of it was inside before. */
struct ThinParts
{
  std::vector<std::uint32_t> cells;
  std::vector<std::uint64_t> corners; ///< covering ones, ascending

  ThinParts(const LatticeLabels& labels, const CoveringResult& covering, const std::vector<std::uint64_t>& added, Execution& execution)
  {
    const CornerShell& shell = labels.shell();
    const auto& covered = covering.coveredCells;
    const auto makeTest = [&]
    {
      return [&, cache = LabelCache(labels)](std::size_t one) mutable { return isThin(labels, cache, added, covered[one]); };
    };
    for (const std::int32_t n : indicesWhereTests(covered.size(), 1024, execution, makeTest))
    {
      this->cells.push_back(covered[std::size_t(n)]);
      for (const std::uint32_t corner : shell.cellCorners[this->cells.back()])
      {
        if (std::binary_search(added.begin(), added.end(), shell.corners[corner]))
        {
          this->corners.push_back(shell.corners[corner]);
        }
      }
    }
    sortUnique(this->corners);
  }

private:
  static bool isThin(const LatticeLabels& labels, LabelCache& cache, const std::vector<std::uint64_t>& added, std::uint32_t cell)
  {
    const LatticePoint p = fromMorton(labels.shell().cells[cell]);
    bool thin = true;
    for (int n = 0; n < 64 && thin; ++n)
    {
      const LatticePoint q{ p.i + n % 4 - 1, p.j + n / 4 % 4 - 1, p.k + n / 16 - 1 };
      thin = labels.octree().lattice.onBorder(q) || !cache.insideAt(q) || std::binary_search(added.begin(), added.end(), mortonCode(q));
    }
    return thin;
  }
};

/** Contour the labels, place the points, and round the thin parts. Crossings are given up once the points are placed. */
void makeSurface(LatticeLabels& labels, const Survivors& survivors, CoveringResult& covering, SurfaceCrossings crossings,
  const std::vector<std::uint64_t>& added, const LatticeViews* views, const LocalHullOptions& options,
  LocalHullSurface& surface, Execution& execution)
{
  const Lattice& lattice = labels.octree().lattice;
  widenAround(labels, covering, added, execution);
  const CornerShell& shell = labels.shell();
  execution.checkpoint(0.2);
  const LatticeSurface contoured = contour(shell, labels.inside(), execution);
  {
    const CrossingPlacer place(labels, crossings, views ? &views->prepared() : nullptr, added, options.coverOffset);
    const std::vector<double> fractions = place.fractions(shell, contoured, execution);
    execution.checkpoint(0.4);
    surface.mesh = placePoints(lattice, shell, contoured, fractions, options.singlePrecision, execution);
  }
  crossings = {};
  Phase separating(execution, 0.4, 0.5);
  surface.movedToMiddle =
    removeCellIntersections(lattice, shell, contoured, options.singlePrecision, surface.mesh, separating);
  execution.checkpoint(0.5);
  if (!views || !options.thinHulls)
  {
    return;
  }
  const ThinParts thin(labels, covering, added, execution);
  if (!thin.cells.empty())
  {
    Phase measuring(execution, 0.5, 0.6);
    const SilhouetteDepth depth(*views, labels.octree().backgroundVotes, 1.0, measuring);
    Phase hulling(execution, 0.6, 0.7);
    const auto hulls = thinHulls(labels, thin.cells, depth, options.thin, hulling);
    surface.thinHulls = hulls.size();
    Phase thinning(execution, 0.7, 1.0);
    surface.movedToHulls = moveToThinHulls(
      hulls, { labels, survivors.octree, thin.corners, shell, contoured, options.singlePrecision }, &depth, options.thin, surface.mesh, thinning);
  }
}

/**
 * Labels with every survivor covered, and the surface of them. False where a correction was so large that the surface has more components
 * than the survivors.
 */
bool coverAndContour(LatticeLabels& labels, const Survivors& survivors, SurfaceCrossings crossings,
  const PreparedViews* views, const LocalHullOptions& options, LocalHullSurface& surface, Execution& execution)
{
  surface.cavitiesFilled += options.fillCavities ? fillCavities(labels, execution) : 0;
  execution.checkpoint(0.1);
  std::optional<LatticeViews> latticeViews;
  std::optional<CornerDepth> depth; // a field tells how far outside a corner is, votes do not
  if (views)
  {
    latticeViews.emplace(*views, labels.octree().lattice);
  }
  if (views && !labels.field())
  {
    depth.emplace(labels.octree(), *latticeViews, CoverReach);
  }
  CoveringResult covering = coverSurvivors(
    labels, survivors.bridges, loopSteps(labels.octree().lattice, options.handles), depth ? &*depth : nullptr, execution);
  surface.coveredOctants = covering.coveredCells.size();
  surface.coveringCorners = covering.coveringCorners.size();
  execution.checkpoint(0.3);
  auto added = codesOf(labels.shell(), covering.coveringCorners);
  Phase mending(execution, 0.3, 0.4);
  const auto mended = mendTopology(labels, covering, added, options, surface, mending);
  added.insert(added.end(), mended.begin(), mended.end());
  std::sort(added.begin(), added.end());
  if (options.fillCavities && (covering.mayEnclose || !mended.empty()))
  {
    surface.cavitiesFilled += fillCavities(labels, execution);
  }
  execution.checkpoint(0.4);
  Phase contouring(execution, 0.4, 1.0);
  makeSurface(labels, survivors, covering, std::move(crossings), added, latticeViews ? &*latticeViews : nullptr, options, surface, contouring);
  const bool isCorrected = labels.field() || &labels.octree() != &survivors.octree;
  return !isCorrected || !options.fillCavities || countComponents(surface.mesh, execution) <= survivors.components;
}

/** Nothing corrected, and nothing given up. */
LocalHullOptions plainOptions(const LocalHullOptions& options)
{
  LocalHullOptions plain = options;
  plain.islandShare = 0.0;
  plain.repairSilhouettes = false;
  plain.correction.alignViews = false;
  plain.correction.moveSurface = false;
  return plain;
}

CornerShell intersectionShell(const Octree& octree, Execution& execution)
{
  return makeCornerShell(leafCells(octree, OctantState::Intersection, execution), execution);
}

/** Robust without views. */
LocalHullSurface uncorrectedSurface(
  const Mesh& imperfect, const Octree& octree, const LocalHullOptions& options, Execution& execution)
{
  LocalHullSurface surface;
  const Survivors survivors(octree, intersectionShell(octree, execution), options.bridgeGap, execution);
  survivors.count(surface);
  execution.checkpoint(0.4);
  SurfaceCrossings crossings = locateCrossings(imperfect, octree.lattice, CrossingSides::Located, execution);
  surface.ignoredPoints = crossings.ignoredPoints;
  LatticeLabels labels(octree, extendedShell(survivors.shell, survivors.bridgePoints, execution), crossings);
  Phase finishing(execution, 0.5, 1.0);
  coverAndContour(labels, survivors, std::move(crossings), nullptr, options, surface, finishing);
  return surface;
}

/** The octree without debris and islands. */
Octree withoutCrumbs(
  const Octree& octree, const CorrectedCapture& capture, double islandShare, DroppedSurvivors& dropped, Execution& execution)
{
  const auto debris = capture.recarved ? debrisLeaves(octree, *capture.recarved) : std::vector<std::uint64_t>();
  Unannounced dropping(execution);
  return dropIslands(dropLeaves(octree, debris, dropped), islandShare, dropped, dropping);
}

LocalHullSurface robustSurface(const Mesh& imperfect, const Octree& carved, const PreparedViews& views,
  const LocalHullOptions& options, Execution& execution)
{
  LocalHullSurface surface;
  CornerShell shell = intersectionShell(carved, execution);
  execution.checkpoint(0.1);
  Phase correcting(execution, 0.1, 0.5);
  CorrectedCapture capture = correctCapture(imperfect, carved, shell, views, options, correcting);
  surface.deficit = capture.correction.deficit;
  surface.shift = capture.correction.shift;
  surface.alignment = capture.correction.alignment;
  surface.repairedPixels = capture.repairedPixels;
  std::optional<Octree> kept;
  if (options.islandShare > 0.0)
  {
    kept = withoutCrumbs(carved, capture, options.islandShare, surface.dropped, execution);
    shell = intersectionShell(*kept, execution);
  }
  const Octree& octree = kept ? *kept : carved;
  if (capture.recarved)
  {
    Unannounced leaving(execution);
    capture.recarved = withoutStrangers(*capture.recarved, octree, leaving);
  }
  Survivors survivors(octree, std::move(shell), options.bridgeGap, execution);
  survivors.count(surface);
  LatticeLabels labels = correctedLabels(octree, std::move(survivors.shell), survivors.bridgePoints, views, capture, execution);
  execution.checkpoint(0.6);
  SurfaceCrossings crossings =
    locateCrossings(capture.surface ? *capture.surface : imperfect, octree.lattice, CrossingSides::NotLocated, execution);
  surface.ignoredPoints = crossings.ignoredPoints;
  Phase finishing(execution, 0.6, 0.9);
  if (coverAndContour(labels, survivors, std::move(crossings), capture.repaired ? &*capture.repaired : &views, options, surface, finishing))
  {
    return surface;
  }
  Phase again(execution, 0.9, 1.0);
  LocalHullSurface plain = robustSurface(imperfect, octree, views, plainOptions(options), again);
  plain.dropped = surface.dropped;
  return plain;
}

LocalHullSurface thesisSurface(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution)
{
  Phase covering(execution, 0.0, 0.4);
  const LocalHullSurface covered = coveredSurface(imperfect, octree, views, options, covering);
  Phase combining(execution, 0.4, 1.0);
  LocalHullSurface surface = thesisHullSurface(covered.mesh, octree, options, combining);
  surface.coveredOctants = covered.coveredOctants;
  surface.coveringCorners = covered.coveringCorners;
  surface.bridges = covered.bridges;
  surface.cavitiesFilled += covered.cavitiesFilled;
  return surface;
}

} // namespace

LocalHullSurface localHullSurface(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution)
{
  check(octree, views, options);
  if (octree.generations.empty())
  {
    return {};
  }
  if (options.mode == LocalHullMode::Robust && views)
  {
    LocalHullSurface surface = robustSurface(imperfect, octree, *views, options, execution);
    execution.progress(1.0);
    return surface;
  }
  DroppedSurvivors dropped;
  std::optional<Octree> kept;
  if (options.islandShare > 0.0)
  {
    Phase dropping(execution, 0.0, 0.1);
    kept = dropIslands(octree, options.islandShare, dropped, dropping);
  }
  Phase surfacing(execution, 0.1, 1.0);
  const Octree& used = kept ? *kept : octree;
  LocalHullSurface surface = options.mode == LocalHullMode::Thesis
    ? thesisSurface(imperfect, used, views, options, surfacing)
    : uncorrectedSurface(imperfect, used, options, surfacing);
  surface.dropped = std::move(dropped);
  execution.progress(1.0);
  return surface;
}

LocalHullSurface coveredSurface(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution)
{
  LocalHullOptions plain = plainOptions(options);
  plain.mode = LocalHullMode::Robust;
  plain.thinHulls = false;
  plain.tunnels.fillTunnels = false;
  return localHullSurface(imperfect, octree, views, plain, execution);
}

std::vector<LocalHull> classifyLocalHulls(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution)
{
  check(octree, views, options);
  if (octree.generations.empty())
  {
    return {};
  }
  if (options.mode == LocalHullMode::Thesis)
  {
    DroppedSurvivors dropped; // what the surface gives up has no hull
    Phase dropping(execution, 0.0, 0.1);
    const std::optional<Octree> kept =
      options.islandShare > 0.0 ? std::optional<Octree>(dropIslands(octree, options.islandShare, dropped, dropping)) : std::nullopt;
    const Octree& used = kept ? *kept : octree;
    Phase covering(execution, 0.1, 0.4);
    const LocalHullSurface covered = coveredSurface(imperfect, used, views, options, covering);
    Phase hulling(execution, 0.4, 1.0);
    return thesisHulls(covered.mesh, used, options, hulling);
  }
  CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection, execution), execution);
  const LatticeLabels labels = views ? LatticeLabels(octree, std::move(shell), *views, execution)
                                     : LatticeLabels(octree, std::move(shell), locateCrossings(imperfect, octree.lattice, CrossingSides::Located, execution));
  return localHulls(imperfect, labels, options.hulls, execution);
}

} // namespace silhouette
