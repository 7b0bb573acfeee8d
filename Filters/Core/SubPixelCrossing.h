// SPDX-License-Identifier: BSD-3-Clause
/**
 * On which side of the contours a lattice point lies, and where the votes fail along a lattice edge, between pixels
 * (Documentation/method.md, section 2).
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
   * Do at most `backgroundVotes` views have a lattice point at a distance of 0 or less, and does some view see it?
   * The nearest pixels say otherwise at one corner in fifty or more of those next to a surface, the more the smaller
   * an octant is. Cost: a place in each view, and a distance where pixels of both kinds are next to it.
   */
  bool inside(const LatticePoint& p, int backgroundVotes) const;

  /**
   * The fraction t in [0, 1] of the edge from `inside` to `outside`, neighbouring lattice points, beyond which more
   * than `backgroundVotes` views are outside. The outside end is labelled so by its votes, and so is the inside one
   * unless `backgroundVotes` is 0. Only the views that call `outside` background count, each from where its
   * distance, linear between the ends, is 0; where `backgroundVotes` is not 0, those that call `inside` background,
   * too, count from the start. So t is the same from whichever of the edge's octants `ask` is. Cost: a vote for each
   * view asked, two distances for each that counts.
   */
  double operator()(
    const ViewsToAsk& ask, const LatticePoint& inside, const LatticePoint& outside, int backgroundVotes) const;

  /**
   * The same for ends that inside() labelled: all views count that have `outside` at a distance of 0 or less. Cost: a
   * distance for each view, another one for each that counts.
   */
  double operator()(const LatticePoint& inside, const LatticePoint& outside, int backgroundVotes) const;

private:
  double distance(int view, const FieldViews::Place& place) const
  {
    return this->Fields.inside(this->Fields.observed(view), place);
  }
  double distance(int view, const LatticePoint& p) const { return this->distance(view, this->Fields.place(view, p)); }
  /** Is a view's distance 0 or less? */
  bool outside(int view, const FieldViews::Place& place) const;

  const LatticeViews* Views;
  FieldViews Fields;
};

} // namespace silhouette
