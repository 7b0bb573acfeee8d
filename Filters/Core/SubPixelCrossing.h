// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where the votes fail along a lattice edge, between pixels (Documentation/method.md, section 2).
 */
#pragma once

#include "FieldViews.h"

namespace silhouette
{

/**
 * A pixel is a square to exactCrossing(): along a contour that crosses the rows slowly it is right by half a
 * pixel, and the least over many views lies too far inside. Here each view's crossing is where the signed
 * distance from its contour, bilinear between pixels, falls to 0 between the edge's ends: distances some pixels
 * from a contour average over its stairs.
 */
class SubPixelCrossing
{
public:
  /**
   * `views` is not copied and has to outlive this. Cost: distanceMap() of each view, up to two octants from its
   * contour.
   */
  SubPixelCrossing(const LatticeViews& views, Execution& execution);

  /**
   * The fraction t in [0, 1] of the edge from `inside` to `outside`, neighbouring lattice points, beyond which
   * more than `backgroundVotes` views are outside. Only the views that call `outside` background count, each
   * from where its distance, linear between the ends, is 0; so that t is the same from whichever of the edge's
   * octants `ask` is. Cost: a vote for each view asked, two distances for each that counts.
   */
  double operator()(
    const ViewsToAsk& ask, const LatticePoint& inside, const LatticePoint& outside, int backgroundVotes) const;

private:
  const LatticeViews* Views;
  FieldViews Fields;
};

} // namespace silhouette
