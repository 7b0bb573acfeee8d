// SPDX-License-Identifier: BSD-3-Clause
#include "ThinSolid.h"

#include <algorithm>
#include <cmath>

namespace silhouette
{
namespace
{

/** Hulls of the world in lattice coordinates. */
std::vector<ThinHull> onLattice(std::vector<ThinHull> hulls, const Lattice& lattice)
{
  for (ThinHull& hull : hulls)
  {
    for (int end = 0; end < 2; ++end)
    {
      hull.centre[end] = (hull.centre[end] - lattice.root.origin) / lattice.leafEdge();
      hull.radius[end] /= lattice.leafEdge();
    }
  }
  return hulls;
}

std::vector<Box> boxesOf(const std::vector<ThinHull>& hulls)
{
  std::vector<Box> boxes;
  for (const ThinHull& hull : hulls)
  {
    Box box(hull.centre[0]);
    boxes.push_back(box.extend(hull.centre[1]));
  }
  return boxes;
}

} // namespace

ThinSolid::ThinSolid(const std::vector<ThinHull>& hulls, const Lattice& lattice, const SilhouetteDepth* depth)
  : Hulls(onLattice(hulls, lattice))
  , Tree(boxesOf(this->Hulls))
  , Depth(depth)
{
}

bool ThinSolid::isBetter(const Vector3& p, const Vector3& other) const
{
  return !this->Depth || std::abs((*this->Depth)(p)) < std::abs((*this->Depth)(other));
}

bool ThinSolid::surfaceBetween(const Vector3& inside, const Vector3& outside, Vector3& target) const
{
  int strictest = 0;
  const Vector3 middle = 0.5 * (inside + outside);
  std::vector<std::int32_t> near;
  this->Tree.overlapping(Box(middle - Vector3::Constant(1.5), middle + Vector3::Constant(1.5)),
    [&](std::int32_t hull) { near.push_back(hull); });
  const NearestBall from = this->nearest(near, middle);
  // Not quite the point beyond: edges that end at one point are to lead to different places.
  const Vector3 ray = inside + 0.85 * (outside - inside) - from.centre;
  const double length = ray.norm();
  if (near.empty() || length < 1e-6)
  {
    return false;
  }
  const Vector3 heading = ray / length;
  const double farthest = length + 0.3;
  double before = 0.0, behind = 0.0;
  while (behind < farthest)
  {
    const double depth = this->depthAt(near, from.centre + behind * heading, strictest);
    if (depth <= 0.0)
    {
      break;
    }
    before = behind;
    behind += std::max(0.8 * depth, 0.02);
  }
  for (int halving = 0; halving < 7; ++halving)
  {
    const double half = 0.5 * (before + behind);
    (this->depthAt(near, from.centre + half * heading, strictest) > 0.0 ? before : behind) = half;
  }
  target = from.centre + before * heading;
  return true;
}

NearestBall ThinSolid::nearest(const std::vector<std::int32_t>& hulls, const Vector3& p) const
{
  NearestBall best;
  best.distance = 1e300;
  for (const std::int32_t hull : hulls)
  {
    const NearestBall ball = nearestBall(this->Hulls[hull], p);
    best = ball.distance < best.distance ? ball : best;
  }
  return best;
}

/** `strictest`: a view, as SilhouetteDepth has it. */
double ThinSolid::depthAt(const std::vector<std::int32_t>& hulls, const Vector3& p, int& strictest) const
{
  const double inHulls = -this->nearest(hulls, p).distance;
  return this->Depth && inHulls <= 0.0 ? std::max(inHulls, (*this->Depth)(p, inHulls, strictest)) : inHulls;
}

} // namespace silhouette
