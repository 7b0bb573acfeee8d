// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where a surface of labelled corners crosses the lattice edges.
 */
#pragma once

#include "EdgeCrossing.h"
#include "LatticeLabels.h"
#include "LatticeSurface.h"

#include <optional>
#include <vector>

namespace silhouette
{

/** As the labels' field, or a surface, or the views' votes say; near the corner where that was added. */
class CrossingPlacer
{
public:
  /**
   * The labels' field has the say, if they have one; else `crossings` of a surface, and where these have none the `views`, if there are any. `added`:
   * Morton codes, ascending, of corners of which nobody knows more than that they are to be inside: edges from these are crossed at `coverOffset`. Labels
   * and crossings are not copied and have to outlive this.
   */
  CrossingPlacer(const LatticeLabels& labels, const SurfaceCrossings& crossings, const PreparedViews* views,
    std::vector<std::uint64_t> added, double coverOffset);

  /**
   * For each crossed edge of a surface of the shell, which has all corners that were added, the fraction of it from its inside end; the middle where
   * nothing is known. Cost: linear, and exactCrossing() for edges that no crossing tells of.
   */
  std::vector<double> fractions(const CornerShell& shell, const LatticeSurface& contoured, Execution& execution) const;

private:
  using Known = std::vector<LatticeCrossing>::const_iterator;

  std::vector<std::uint8_t> addedCorners(const CornerShell& shell) const;
  double inField(std::uint64_t inside, std::uint64_t outside, BrickCursor& bricks) const;
  Known from(std::uint64_t key) const;
  double onSurface(std::uint64_t inside, std::uint64_t outside, Known& known) const;

  const SurfaceCrossings& Crossings;
  std::optional<LatticeViews> Views;
  const BrickField* Field;
  std::vector<std::uint64_t> Added; ///< ascending
  int BackgroundVotes;
  double CoverOffset;
};

} // namespace silhouette
