// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far outside the silhouettes does a lattice corner lie? For a few corners, without distance maps of whole
 * images.
 */
#pragma once

#include "CornerVotes.h"

#include <limits>

namespace silhouette
{

class CornerDepth
{
public:
  /**
   * Octree and views are not copied and have to outlive this. As many views as the octree allows background votes, k, are not listened to at each corner.
   * Depths are cut off at `reach` octants. Throws InvalidInput for a reach that is not above 0, and where there are not more than k views.
   */
  CornerDepth(const Octree& octree, const LatticeViews& views, double reach);

  /**
   * Depth of a corner in octants: 0 inside and where no view says anything, else minus the distance to the silhouette in the view that is farthest
   * from it, but for the k farthest; pixels are squares, -reach at least. `octants`: the octree's; not for several threads at once. Cost: a vote of each
   * view, where k is 0 and the corner is a surviving octant's of those that are undecided about it; for the views that call the corner background, a few
   * questions for each row of pixels nearer than the silhouette. Whoever asks only whether it is `least` or more is told the depth if it is, else anything between the
   * depth and that, with fewer views asked.
   */
  double operator()(const LatticePoint& p, OctantCursor& octants, double least = -std::numeric_limits<double>::infinity()) const;

private:
  double outsideView(int view, const LatticePoint& p) const;

  const LatticeViews* Views;
  LeafViews Undecided;
  int BackgroundVotes;
  double Reach;
};

} // namespace silhouette
