// SPDX-License-Identifier: BSD-3-Clause
#include "LocalHullSurface.h"

#include "CellSafety.h"
#include "EdgeCrossing.h"
#include "LatticeRegions.h"
#include "LatticeSurface.h"
#include "SurvivorCovering.h"

#include <algorithm>
#include <optional>

namespace silhouette
{
namespace
{

void check(const Octree& octree, const PreparedViews* views, const LocalHullOptions& options)
{
  if (views && octree.fingerprint != views->fingerprint())
  {
    throw InvalidInput("the octree was carved from other views, or with another policy outside the image");
  }
  if (!(options.coverOffset >= CrossingMargin && options.coverOffset <= 1.0 - CrossingMargin))
  {
    throw InvalidInput("cover offset " + std::to_string(options.coverOffset) + " octants is outside 0.01 to 0.99");
  }
  if (options.bridgeGap < 0)
  {
    throw InvalidInput("bridge gap " + std::to_string(options.bridgeGap) + " octants: at least 0 is needed");
  }
}

LatticeLabels makeLabels(const Octree& octree, CornerShell shell, const PreparedViews* views,
  const SurfaceCrossings& crossings, Execution& execution)
{
  return views ? LatticeLabels(octree, std::move(shell), *views, execution)
               : LatticeLabels(octree, std::move(shell), crossings);
}

/** The shell with the eight cells around each of the given points, none of which is on the border. */
CornerShell extended(const CornerShell& shell, const std::vector<std::uint64_t>& points, Execution& execution)
{
  std::vector<std::uint64_t> cells = shell.cells;
  for (const std::uint64_t point : points)
  {
    const LatticePoint p = fromMorton(point);
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint o = cornerOffset(n);
      cells.push_back(mortonCode({ p.i - o.i, p.j - o.j, p.k - o.k }));
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return makeCornerShell(std::move(cells), execution);
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

/** Where the surface crosses an edge: as the imperfect surface or the votes say, near the corner if that was added. */
class CrossingPlacer
{
public:
  CrossingPlacer(const LatticeLabels& labels, const SurfaceCrossings& crossings, const PreparedViews* views,
    std::vector<std::uint64_t> added, double coverOffset)
    : Crossings(crossings)
    , Added(std::move(added))
    , BackgroundVotes(labels.octree().backgroundVotes)
    , CoverOffset(coverOffset)
  {
    if (views)
    {
      this->Views.emplace(*views, labels.octree().lattice);
    }
  }

  double operator()(std::uint64_t inside, std::uint64_t outside) const
  {
    if (std::binary_search(this->Added.begin(), this->Added.end(), inside))
    {
      return this->CoverOffset;
    }
    const LatticePoint a = fromMorton(inside), b = fromMorton(outside);
    const int axis = a.i != b.i ? 0 : (a.j != b.j ? 1 : 2);
    const bool ascending = b.i + b.j + b.k > a.i + a.j + a.k;
    const auto known = this->Crossings.find(edgeKey(ascending ? inside : outside, axis));
    double t = 0.5;
    if (known >= 0)
    {
      const double fraction = this->Crossings.crossings[known].fraction;
      t = ascending ? fraction : 1.0 - fraction;
    }
    else if (this->Views)
    {
      t = exactCrossing(*this->Views, a, b, this->BackgroundVotes);
    }
    return std::clamp(t, CrossingMargin, 1.0 - CrossingMargin);
  }

private:
  const SurfaceCrossings& Crossings;
  std::optional<LatticeViews> Views;
  std::vector<std::uint64_t> Added; ///< ascending
  int BackgroundVotes;
  double CoverOffset;
};

/** Contour the labels and place the points. */
void makeSurface(const LatticeLabels& labels, const std::vector<std::uint64_t>& added, const CrossingPlacer& place,
  bool singlePrecision, LocalHullSurface& surface, Execution& execution)
{
  const Lattice& lattice = labels.octree().lattice;
  const CornerShell shell = extended(labels.shell(), added, execution);
  std::vector<std::uint8_t> inside(shell.corners.size());
  execution.forRanges(inside.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        inside[c] = labels.insideAt(fromMorton(shell.corners[c]));
      }
    });
  execution.checkpoint(0.3);
  LatticeSurface contoured = contour(shell, inside, execution);
  std::vector<double> fractions(contoured.edges.size());
  execution.forRanges(fractions.size(), 256,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t e = first; e < last; ++e)
      {
        fractions[e] = place(shell.corners[contoured.edges[e].inside], shell.corners[contoured.edges[e].outside]);
      }
    });
  execution.checkpoint(0.7);
  surface.mesh = placePoints(lattice, shell, contoured, fractions, singlePrecision);
  surface.movedToMiddle =
    removeCellIntersections(lattice, shell, contoured, singlePrecision, surface.mesh, execution);
}

} // namespace

LocalHullSurface localHullSurface(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution)
{
  check(octree, views, options);
  LocalHullSurface surface;
  if (octree.generations.empty())
  {
    return surface;
  }
  const SurfaceCrossings crossings = locateCrossings(imperfect, octree.lattice);
  surface.ignoredPoints = crossings.ignoredPoints;
  execution.checkpoint(0.1);
  CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
  const std::vector<Bridge> bridges = bridgeSurvivors(octree, shell, options.bridgeGap);
  surface.bridges = bridges.size();
  if (!bridges.empty())
  {
    std::vector<std::uint64_t> points;
    for (const auto& bridge : bridges)
    {
      points.insert(points.end(), bridge.begin(), bridge.end());
    }
    shell = extended(shell, points, execution);
  }
  execution.checkpoint(0.2);
  LatticeLabels labels = makeLabels(octree, std::move(shell), views, crossings, execution);
  execution.checkpoint(0.35);
  surface.survivors = octree.count(OctantState::Intersection, octree.lattice.depth) +
    octree.count(OctantState::Inside, octree.lattice.depth);
  surface.cavitiesFilled += options.fillCavities ? fillCavities(labels) : 0;
  execution.checkpoint(0.4);
  const CoveringResult covering = coverSurvivors(labels, bridges);
  surface.coveredOctants = covering.coveredOctants;
  surface.coveringCorners = covering.coveringCorners.size();
  execution.checkpoint(0.5);
  surface.cavitiesFilled += options.fillCavities ? fillCavities(labels) : 0;
  execution.checkpoint(0.6);
  const auto added = codesOf(labels.shell(), covering.coveringCorners);
  const CrossingPlacer place(labels, crossings, views, added, options.coverOffset);
  Phase contouring(execution, 0.6, 1.0);
  makeSurface(labels, added, place, options.singlePrecision, surface, contouring);
  return surface;
}

std::vector<LocalHull> classifyLocalHulls(const Mesh& imperfect, const Octree& octree, const PreparedViews* views,
  const LocalHullOptions& options, Execution& execution)
{
  check(octree, views, options);
  if (octree.generations.empty())
  {
    return {};
  }
  const SurfaceCrossings crossings = locateCrossings(imperfect, octree.lattice);
  CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection), execution);
  const LatticeLabels labels = makeLabels(octree, std::move(shell), views, crossings, execution);
  return localHulls(imperfect, labels, options.hulls, execution);
}

} // namespace silhouette
