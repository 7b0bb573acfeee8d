// SPDX-License-Identifier: BSD-3-Clause
#include "VotingMarchingCubes.h"

#include "CornerShell.h"
#include "CornerVotes.h"
#include "EdgeCrossing.h"
#include "FirstTouch.h"
#include "LargePages.h"
#include "LatticeSurface.h"
#include "ParameterRange.h"
#include "SubPixelLabels.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace silhouette
{
namespace
{

/** k, after checking that octree, views, mode and share fit together. */
int allowedBackgroundVotes(const Octree& octree, const PreparedViews& views, const VotingOptions& options)
{
  const int required = requiredInsideVotes(options.share, views.size());
  const int allowed = views.size() - required;
  if (octree.fingerprint != views.fingerprint())
  {
    throw InvalidInput("the octree was carved from other views, or with another policy outside the image");
  }
  const int needed = options.mode == VotingMode::Faithful ? 0 : allowed;
  if (octree.backgroundVotes != needed)
  {
    throw InvalidInput("the octree allows " + std::to_string(octree.backgroundVotes) + " background votes, but " +
      (options.mode == VotingMode::Faithful ? std::string("the faithful mode needs the strict octree: 0")
                                            : "a vote share of " + std::to_string(options.share) + " of " +
            std::to_string(views.size()) + " views needs exactly " + std::to_string(needed)));
  }
  return allowed;
}

void countLost(const LatticeSurface& contoured, VotingSurface& surface)
{
  const auto& cases = contoured.cellCase;
  surface.intersectionOctants = cases.size();
  surface.lostNoCorner = std::uint64_t(std::count(cases.begin(), cases.end(), std::uint8_t(0)));
  surface.lostAllCorners = std::uint64_t(std::count(cases.begin(), cases.end(), std::uint8_t(255)));
}

/** Run `work(i)` for i in [0, count), with progress and a chance to stop after each sixteenth. */
template <typename Work>
void forEach(Execution& execution, std::size_t count, const Work& work)
{
  constexpr std::size_t Steps = 16;
  for (std::size_t step = 0; step < Steps; ++step)
  {
    const std::size_t from = count * step / Steps, to = count * (step + 1) / Steps;
    execution.forRanges(to - from, 1024,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = from + first; i < from + last; ++i)
        {
          work(i);
        }
      });
    execution.checkpoint(double(step + 1) / Steps);
  }
}

/** 1 for each corner with enough votes; the cube's border is outside. */
std::vector<std::uint8_t> labels(const Lattice& lattice, const CornerShell& shell,
  const std::vector<std::uint16_t>& votes, int required, Execution& execution)
{
  auto inside = largeVector<std::uint8_t>(votes.size());
  execution.forRanges(votes.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        inside[c] = votes[c] >= required && !lattice.onBorder(fromMorton(shell.corners[c]));
      }
    });
  return inside;
}

} // namespace

int requiredInsideVotes(double share, int views)
{
  requireAboveZero("vote share", share, 1.0);
  return std::max(1, int(std::ceil(share * views - 1e-9)));
}

VotingSurface votingMarchingCubes(
  const Octree& octree, const PreparedViews& views, const VotingOptions& options, Execution& execution)
{
  const int allowed = allowedBackgroundVotes(octree, views, options);
  const LatticeViews latticeViews(views, octree.lattice);
  const CornerShell shell = makeCornerShell(leafCells(octree, OctantState::Intersection, execution), execution);
  execution.checkpoint(0.15);

  const CellViews cellViews(octree, shell, latticeViews, execution);
  Phase voting(execution, 0.15, 0.5);
  const KnownVotes::Votes counted = octreeVotes(
    octree, shell, latticeViews, [&] { return cornerVotes(shell, cellViews, latticeViews, voting); });
  const std::vector<std::uint16_t>& votes = *counted;
  const std::vector<std::uint8_t> voted = labels(octree.lattice, shell, votes, views.size() - allowed, execution);
  std::optional<SubPixelCrossing> subPixel;
  std::vector<std::uint8_t> moved; // the labels, where they are not those of the votes
  if (options.edges == EdgePlacement::SubPixel)
  {
    subPixel.emplace(latticeViews, execution);
    execution.checkpoint(0.6);
    if (options.mode == VotingMode::Consistent)
    {
      moved = subPixelLabels(octree, shell, latticeViews, *subPixel, voted, execution);
    }
  }
  LatticeSurface contoured = contour(shell, moved.empty() ? voted : moved, execution);

  VotingSurface surface;
  countLost(contoured, surface);
  execution.checkpoint(subPixel ? 0.7 : 0.6);
  surface.mesh.triangles = std::move(contoured.triangles);
  resizeSideBySide(surface.mesh.points, contoured.edges.size(), execution);
  resizeSideBySide(surface.insideVotes, contoured.edges.size(), execution);
  Phase placing(execution, subPixel ? 0.7 : 0.6, 1.0);
  forEach(placing, contoured.edges.size(),
    [&](std::size_t e)
    {
      const CrossedEdge& edge = contoured.edges[e];
      const ViewsToAsk ask = cellViews[edge.cell];
      const LatticePoint inside = fromMorton(shell.corners[edge.inside]);
      const LatticePoint outside = fromMorton(shell.corners[edge.outside]);
      double t = 0.5;
      if (subPixel)
      {
        // Where no view may dissent, those that call the outside end background are asked whatever the inside end's.
        const bool byVotes = voted[edge.outside] == 0 && (voted[edge.inside] == 1 || allowed == 0);
        t = byVotes ? (*subPixel)(ask, inside, outside, allowed) : (*subPixel)(inside, outside, allowed);
      }
      else if (options.edges == EdgePlacement::Exact)
      {
        t = exactCrossing(latticeViews, ask, inside, outside, allowed);
      }
      surface.mesh.points[e] = crossingPosition(
        octree.lattice, shell, edge, std::clamp(t, CrossingMargin, 1.0 - CrossingMargin));
      surface.insideVotes[e] = { votes[edge.inside], votes[edge.outside] };
    });
  return surface;
}

} // namespace silhouette
