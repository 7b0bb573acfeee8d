// SPDX-License-Identifier: BSD-3-Clause
/**
 * How deep does any point of space lie inside the silhouettes? The field whose zero is the visual hull's surface.
 */
#pragma once

#include "DistanceMap.h"
#include "PreparedViews.h"

#include <memory>
#include <vector>

namespace silhouette
{

class SilhouetteDepth
{
public:
  /**
   * `views` is not copied and has to outlive this. `backgroundVotes` is k: so many views are not listened to at each point. Depths are exact
   * up to `reach` octants and cut off there. `shifts`: px, added to what the views project; one for each view, or none.
   * Throws InvalidInput for k outside 0 to views - 1, a reach that is not positive, a wrong number of shifts. Cost: a DistanceProbe of every view.
   */
  SilhouetteDepth(const LatticeViews& views, int backgroundVotes, double reach, Execution& execution,
    const std::vector<Vector2>& shifts = {});

  /**
   * Depth in octants of a point in lattice coordinates: the least over the views, but for the k least, of the distance from
   * the silhouette's contour, positive inside. Views that abstain do not count. Once it is known to be at most `enough`, some value that is too.
   */
  double operator()(const Vector3& p, double enough = -1e300) const
  {
    int first = 0;
    return (*this)(p, enough, first);
  }

  /**
   * The same. `first`, a view, is asked first, and becomes the one with the least depth of those that were asked: for the next point near by that is mostly the one
   * that decides.
   */
  double operator()(const Vector3& p, double enough, int& first) const;

  const Lattice& lattice() const { return this->Views->lattice(); }

private:
  double inView(int view, const Vector3& p) const;

  const LatticeViews* Views;
  int BackgroundVotes;
  double Reach;
  std::vector<Vector2> Shifts;
  std::vector<std::unique_ptr<const DistanceProbe>> Probes;
};

} // namespace silhouette
