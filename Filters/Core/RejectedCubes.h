// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cubes of lattice points that one view alone calls background, found without asking about each point.
 */
#pragma once

#include "PointCubes.h"
#include "PreparedViews.h"

#include <cstdint>

namespace silhouette
{

class RejectedCubes
{
public:
  /** `depth`: octants, 0 or more: no object is within as much of a cube, in the view that rejects it. The views have to outlive it. */
  RejectedCubes(const LatticeViews& views, double depth)
    : Views(views)
    , Depth(depth)
  {
  }

  /**
   * The largest cube of side 4 and more, aligned as octants are, around a point, of which it is known from the cube's images that one view
   * alone rejects all its points; of side 0 where there is none. Those of two points are the same or have no point in common. Cost: for each side a test in
   * that view; where it passes, in the others.
   */
  PointCube around(std::uint64_t corner, int view);

private:
  bool isFree(int view, const PointCube& cube, double depth, double guard) const;
  bool isObjectElsewhere(int view, const PointCube& cube);

  const LatticeViews& Views;
  double Depth;
  PointCube Last;    ///< that was found
  int Objector = 0;  ///< the last view that kept a cube from being one
};

} // namespace silhouette
