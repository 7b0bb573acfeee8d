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
}

LatticeLabels makeLabels(
  const Octree& octree, const PreparedViews* views, const SurfaceCrossings& crossings, Execution& execution)
{
  return views ? LatticeLabels(octree, *views, execution) : LatticeLabels(octree, crossings, execution);
}

/** The cells that the surface may pass: the intersection octants, and those around corners added to the solid. */
std::vector<std::uint64_t> cellsOfSurface(const LatticeLabels& labels, const std::vector<std::uint32_t>& added)
{
  std::vector<std::uint64_t> cells = labels.shell().cells;
  for (const std::uint32_t corner : added)
  {
    const LatticePoint p = fromMorton(labels.shell().corners[corner]);
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint o = cornerOffset(n);
      cells.push_back(mortonCode({ p.i - o.i, p.j - o.j, p.k - o.k })); // an added corner is never on the border
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/** Where the surface crosses an edge: as the imperfect surface or the votes say, near the corner if that was added. */
class CrossingPlacer
{
public:
  CrossingPlacer(const LatticeLabels& labels, const SurfaceCrossings& crossings, const PreparedViews* views,
    const std::vector<std::uint32_t>& added, double coverOffset)
    : Labels(labels)
    , Crossings(crossings)
    , BackgroundVotes(labels.octree().backgroundVotes)
    , CoverOffset(coverOffset)
  {
    if (views)
    {
      this->Views.emplace(*views, labels.octree().lattice);
    }
    for (const std::uint32_t corner : added)
    {
      this->Added.push_back(labels.shell().corners[corner]);
    }
    std::sort(this->Added.begin(), this->Added.end());
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
  const LatticeLabels& Labels;
  const SurfaceCrossings& Crossings;
  std::optional<LatticeViews> Views;
  std::vector<std::uint64_t> Added;
  int BackgroundVotes;
  double CoverOffset;
};

/** Contour the labels and place the points. */
void makeSurface(const LatticeLabels& labels, const std::vector<std::uint32_t>& added, const CrossingPlacer& place,
  bool singlePrecision, LocalHullSurface& surface, Execution& execution)
{
  const Lattice& lattice = labels.octree().lattice;
  const CornerShell shell = makeCornerShell(cellsOfSurface(labels, added), execution);
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
  LatticeLabels labels = makeLabels(octree, views, crossings, execution);
  execution.checkpoint(0.3);
  surface.survivors = octree.count(OctantState::Intersection, octree.lattice.depth) +
    octree.count(OctantState::Inside, octree.lattice.depth);
  if (options.fillCavities)
  {
    surface.cavitiesFilled += fillCavities(labels);
  }
  execution.checkpoint(0.4);
  const CoveringResult covering = coverSurvivors(labels);
  surface.coveredOctants = covering.coveredOctants;
  surface.coveringCorners = covering.coveringCorners.size();
  execution.checkpoint(0.5);
  if (options.fillCavities)
  {
    surface.cavitiesFilled += fillCavities(labels);
  }
  execution.checkpoint(0.6);
  const CrossingPlacer place(labels, crossings, views, covering.coveringCorners, options.coverOffset);
  Phase contouring(execution, 0.6, 1.0);
  makeSurface(labels, covering.coveringCorners, place, options.singlePrecision, surface, contouring);
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
  const LatticeLabels labels = makeLabels(octree, views, crossings, execution);
  return localHulls(imperfect, labels, options.hulls, execution);
}

} // namespace silhouette
