// SPDX-License-Identifier: BSD-3-Clause
#include "ThesisHullSurface.h"

#include "CellSafety.h"
#include "ConvexHull.h"
#include "HullCombination.h"
#include "MeshSoundness.h"
#include "SurfaceNesting.h"
#include "SurvivorCoverage.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace silhouette
{
namespace
{

constexpr double SnapDistance = 1e-3; ///< octants: single precision may have moved a point off its edge by as much

/** Cells around those points that no survivor holds: bridges between survivors run there. */
std::vector<std::uint64_t> cellsBesideSurvivors(const std::vector<Eigen::Vector3d>& points, const Octree& octree)
{
  std::vector<std::uint64_t> cells;
  for (const auto& p : points)
  {
    std::array<LatticePoint, 8> around;
    int count = 0;
    bool survivor = false;
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint o = cornerOffset(n);
      const Eigen::Vector3d below = p.array().floor();
      const LatticePoint cell{ int(below[0]) - o.i, int(below[1]) - o.j, int(below[2]) - o.k };
      const bool holds = (!o.i || p[0] == below[0]) && (!o.j || p[1] == below[1]) && (!o.k || p[2] == below[2]);
      if (holds && octree.lattice.hasCell(cell))
      {
        around[count++] = cell;
        const auto location = octree.locate(cell);
        survivor |= location.generation >= 0 && location.state != OctantState::Background;
      }
    }
    for (int n = 0; n < count && !survivor; ++n)
    {
      cells.push_back(mortonCode(around[n]));
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

std::vector<Eigen::Vector3d> pointsOf(const Mesh& mesh, const Lattice& lattice)
{
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.points.size());
  for (const auto& p : mesh.points)
  {
    points.push_back(latticeCoordinates(p, lattice, SnapDistance));
  }
  return points;
}

/** Every survivor must have a corner within the surface: otherwise nothing here covers it. */
void requireCovered(const Octree& octree, const std::vector<RowInterval>& solid)
{
  std::uint64_t uncovered = 0;
  for (std::size_t n = 0; n < octree.last().size(); ++n)
  {
    if (octree.last().state[n] != OctantState::Background)
    {
      const LatticePoint cell = fromMorton(octree.last().code[n]);
      bool covered = false;
      for (int c = 0; c < 8 && !covered; ++c)
      {
        const LatticePoint p = cell + cornerOffset(c);
        covered = !octree.lattice.onBorder(p) && findInterval(solid, rowKey(p, 0), p.i);
      }
      uncovered += !covered;
    }
  }
  if (uncovered > 0)
  {
    throw InvalidInput("the surface leaves " + std::to_string(uncovered) +
      " surviving octants without an inside corner: the hulls need one that covers them all");
  }
}

bool keepsPromise(const Mesh& mesh, const Octree& octree, Execution& execution)
{
  return assessMesh(mesh, execution).sound() && lostSurvivors(octree, mesh, execution) == 0;
}

/** A single hull's own facets; nothing where rounding has spoilt them. */
std::optional<Mesh> ownFacets(const Mesh& hull, const Octree& octree, bool singlePrecision, Execution& execution)
{
  Execution quiet;
  Mesh mesh = hull;
  if (singlePrecision)
  {
    requireSinglePrecision(octree.lattice);
    for (auto& p : mesh.points)
    {
      p = roundedToFloat(p);
    }
  }
  execution.checkpoint(0.5);
  if (keepsPromise(mesh, octree, quiet))
  {
    return mesh;
  }
  auto again = convexHull(mesh.points);
  execution.checkpoint(0.8);
  return again && keepsPromise(*again, octree, quiet) ? std::move(again) : std::nullopt;
}

/** Leave out what no part of the covered solid reaches, and cavities where they are to be filled. */
void dropComponents(
  const std::vector<RowInterval>& solid, bool fillCavities, CombinedSurface& combined, LocalHullSurface& result)
{
  const SurfaceNesting nesting = nestSurface(combined.shell, combined.surface);
  const std::size_t count = nesting.parent.size();
  std::vector<std::uint8_t> reached(count, 0), keep(count, 0);
  for (const auto& interval : solid)
  {
    const std::uint32_t wall = nesting.solidAt(pointOnRow(interval.row, 0, std::int32_t(std::ceil(interval.from))));
    if (wall != NoComponent)
    {
      reached[wall] = 1;
    }
  }
  for (std::uint32_t c = 0; c < count; ++c)
  {
    const bool outermost = nesting.parent[c] == NoComponent;
    keep[c] = reached[nesting.solidOf(c)] && (outermost || !fillCavities);
    result.cavitiesFilled += nesting.cavity[c] && fillCavities && reached[nesting.solidOf(c)];
  }
  keepComponents(nesting, keep, combined.surface, combined.fractions);
}

} // namespace

std::vector<LocalHull> thesisHulls(
  const Mesh& covered, const Octree& octree, const LocalHullOptions& options, Execution& execution)
{
  if (octree.generations.empty())
  {
    return {};
  }
  const auto points = pointsOf(covered, octree.lattice);
  const SolidRows solid = surfaceRows(locateCrossings(covered, octree.lattice, CrossingSides::NotLocated, execution));
  Phase slicing(execution, 0.0, 0.4);
  const SlicedVolume volume = sliceVolume(octree, cellsBesideSurvivors(points, octree), options.slices, slicing);
  Phase chaining(execution, 0.4, 1.0);
  return hullChains(volume, points, solid, octree.lattice, options.chains, chaining);
}

LocalHullSurface combineLocalHulls(const std::vector<LocalHull>& hulls, const Mesh& covered, const Octree& octree,
  const LocalHullOptions& options, Execution& execution)
{
  LocalHullSurface result;
  if (octree.generations.empty())
  {
    return result;
  }
  const Lattice& lattice = octree.lattice;
  const SurfaceCrossings crossings = locateCrossings(covered, lattice, CrossingSides::NotLocated, execution);
  const auto solid = surfaceRows(crossings, 0);
  requireCovered(octree, solid);
  result.survivors =
    octree.count(OctantState::Intersection, lattice.depth) + octree.count(OctantState::Inside, lattice.depth);
  result.ignoredPoints = crossings.ignoredPoints;
  execution.checkpoint(0.1);
  if (hulls.size() == 1 && hulls[0].surfacePoints.size() == covered.points.size())
  {
    Phase facets(execution, 0.1, 0.4);
    if (auto own = ownFacets(hulls[0].mesh, octree, options.singlePrecision, facets))
    {
      result.mesh = std::move(*own);
      execution.checkpoint(1.0);
      return result;
    }
  }
  Phase combining(execution, 0.4, 0.6);
  const SolidRows rows = combinedRows(hulls, crossings, lattice, combining);
  Phase contouring(execution, 0.6, 0.8);
  CombinedSurface combined = contourRows(rows, lattice, contouring);
  dropComponents(solid, options.fillCavities, combined, result);
  result.mesh = placePoints(lattice, combined.shell, combined.surface, combined.fractions, options.singlePrecision, execution);
  Phase safety(execution, 0.8, 1.0);
  result.movedToMiddle = removeCellIntersections(
    lattice, combined.shell, combined.surface, options.singlePrecision, result.mesh, safety);
  return result;
}

LocalHullSurface thesisHullSurface(
  const Mesh& covered, const Octree& octree, const LocalHullOptions& options, Execution& execution)
{
  Phase hulling(execution, 0.0, 0.6);
  const auto hulls = thesisHulls(covered, octree, options, hulling);
  Phase combining(execution, 0.6, 1.0);
  return combineLocalHulls(hulls, covered, octree, options, combining);
}

} // namespace silhouette
