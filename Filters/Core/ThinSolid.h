// SPDX-License-Identifier: BSD-3-Clause
/**
 * What thin local hulls and silhouettes have in common: where a surface around them is to be.
 */
#pragma once

#include "BoxTree.h"
#include "ThinHulls.h"

#include <vector>

namespace silhouette
{

/** The union of the hulls and of what is inside all silhouettes, lattice coordinates. Any number of threads may ask. */
class ThinSolid
{
public:
  /** `hulls` in the world; `depth` is not copied and has to outlive this, or is null: then the hulls alone count. */
  ThinSolid(const std::vector<ThinHull>& hulls, const Lattice& lattice, const SilhouetteDepth* depth);

  /** Is a point nearer to the silhouettes' contours than another? Without silhouettes, always. */
  bool isBetter(const Vector3& p, const Vector3& other) const;

  /**
   * Where the surface lies between a covering corner and the lattice point beyond it: seen from the nearest hull's inside, before that
   * point, or less than half an octant behind it; right to a hundredth of an octant. False where no hull is near. Cost: the hulls within 1.5 octants, a dozen times.
   */
  bool surfaceBetween(const Vector3& inside, const Vector3& outside, Vector3& target) const;

private:
  NearestBall nearest(const std::vector<std::int32_t>& hulls, const Vector3& p) const;
  double depthAt(const std::vector<std::int32_t>& hulls, const Vector3& p, int& strictest) const;

  std::vector<ThinHull> Hulls;
  BoxTree Tree;
  const SilhouetteDepth* Depth;
};

} // namespace silhouette
