// SPDX-License-Identifier: BSD-3-Clause
#include "CrossingPlacer.h"

#include "CodeCursor.h"
#include "LargePages.h"

#include <algorithm>

namespace silhouette
{
namespace
{

constexpr std::uint64_t AlongX = 0x1249249249249249ULL; ///< the bits of x in a Morton code

std::uint64_t keyOf(std::uint64_t end, std::uint64_t other)
{
  const std::uint64_t differing = end ^ other;
  return edgeKey(std::min(end, other), (differing & AlongX) != 0 ? 0 : (differing & AlongX << 1) != 0 ? 1 : 2);
}

} // namespace

CrossingPlacer::CrossingPlacer(const LatticeLabels& labels, const SurfaceCrossings& crossings, const PreparedViews* views,
  std::vector<std::uint64_t> added, double coverOffset)
  : Crossings(crossings)
  , Field(labels.field())
  , Added(std::move(added))
  , BackgroundVotes(labels.octree().backgroundVotes)
  , CoverOffset(coverOffset)
{
  if (views)
  {
    this->Views.emplace(*views, labels.octree().lattice);
  }
}

std::vector<double> CrossingPlacer::fractions(const CornerShell& shell, const LatticeSurface& contoured, Execution& execution) const
{
  auto fractions = largeVector<double>(contoured.edges.size());
  const std::vector<std::uint8_t> isAdded = this->addedCorners(shell);
  execution.forRanges(fractions.size(), 256,
    [&](std::size_t first, std::size_t last)
    {
      // Crossings are in the edges' own order.
      const CrossedEdge& start = contoured.edges[first];
      std::optional<BrickCursor> bricks = this->Field ? std::optional<BrickCursor>(*this->Field) : std::nullopt;
      Known known = this->from(keyOf(shell.corners[start.inside], shell.corners[start.outside]));
      for (std::size_t e = first; e < last; ++e)
      {
        const CrossedEdge& edge = contoured.edges[e];
        const std::uint64_t inside = shell.corners[edge.inside], outside = shell.corners[edge.outside];
        fractions[e] = isAdded[edge.inside] ? this->CoverOffset
                                            : std::clamp(this->Field ? this->inField(inside, outside, *bricks)
                                                                     : this->onSurface(inside, outside, known),
                                                CrossingMargin, 1.0 - CrossingMargin);
      }
    });
  return fractions;
}

/** A 1 for each corner of the shell that was added. */
std::vector<std::uint8_t> CrossingPlacer::addedCorners(const CornerShell& shell) const
{
  auto isAdded = largeVector<std::uint8_t>(shell.corners.size());
  CodeCursor corners(shell.corners);
  for (const std::uint64_t corner : this->Added)
  {
    isAdded[std::size_t(corners.find(corner))] = 1;
  }
  return isAdded;
}

double CrossingPlacer::inField(std::uint64_t inside, std::uint64_t outside, BrickCursor& bricks) const
{
  const std::ptrdiff_t a = bricks.find(inside), b = bricks.find(outside);
  if (a < 0 || b < 0)
  {
    return 0.5;
  }
  const double from = this->Field->values()[a], to = this->Field->values()[b];
  return from > 0.0 && to <= 0.0 ? from / (from - to) : 0.5;
}

/** The first crossing that is not before an edge. */
CrossingPlacer::Known CrossingPlacer::from(std::uint64_t key) const
{
  return std::lower_bound(this->Crossings.crossings.begin(), this->Crossings.crossings.end(), key,
    [](const LatticeCrossing& crossing, std::uint64_t edge) { return crossing.edge < edge; });
}

/** `known` is before or at the edge's place among the crossings, and is moved there. */
double CrossingPlacer::onSurface(std::uint64_t inside, std::uint64_t outside, Known& known) const
{
  const std::uint64_t key = keyOf(inside, outside);
  const auto end = this->Crossings.crossings.end();
  while (known != end && known->edge < key)
  {
    ++known;
  }
  if (known != end && known->edge == key)
  {
    return inside < outside ? known->fraction : 1.0 - known->fraction;
  }
  return this->Views ? exactCrossing(*this->Views, fromMorton(inside), fromMorton(outside), this->BackgroundVotes) : 0.5;
}

} // namespace silhouette
