// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far outside the silhouettes does a lattice corner lie? For a few corners, without distance maps of whole
 * images.
 */
#pragma once

#include "PreparedViews.h"

namespace silhouette
{

class CornerDepth
{
public:
  /**
   * `views` is not copied and has to outlive this. `backgroundVotes` is k: so many views are not listened to at
   * each corner. Depths are cut off at `reach` octants. Throws InvalidInput for k outside 0 to views - 1 and
   * for a reach that is not above 0.
   */
  CornerDepth(const LatticeViews& views, int backgroundVotes, double reach);

  /**
   * Depth of a corner in octants: 0 inside and where no view says anything, else minus the distance to the
   * silhouette in the view that is farthest from it, but for the k farthest; pixels are squares, -reach at
   * least. Cost: a vote of each view; for the views that call the corner background, a few questions for each
   * row of pixels nearer than the silhouette.
   */
  double operator()(const LatticePoint& p) const;

private:
  double outsideView(int view, const LatticePoint& p) const;

  const LatticeViews* Views;
  int BackgroundVotes;
  double Reach;
};

} // namespace silhouette
