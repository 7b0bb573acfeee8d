// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleIntersection.h"

#include "ExactPredicates.h"

#include <algorithm>
#include <array>

namespace silhouette
{

namespace
{

using Point = Eigen::Vector3d;
using Corners = std::array<const Point*, 3>;

Corners cornersOf(const std::vector<Point>& points, const Triangle& t)
{
  return { &points[t[0]], &points[t[1]], &points[t[2]] };
}

/** The point seen along an axis. */
Eigen::Vector2d along(int axis, const Point& p)
{
  return { p[(axis + 1) % 3], p[(axis + 2) % 3] };
}

int orientAlong(int axis, const Point& a, const Point& b, const Point& c)
{
  return orient2d(along(axis, a), along(axis, b), along(axis, c));
}

/** An axis along which the three points do not lie on a line, -1 where there is none. */
int spreadAxis(const Point& a, const Point& b, const Point& c)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (orientAlong(axis, a, b, c) != 0)
    {
      return axis;
    }
  }
  return -1;
}

/** Do r, which lies on the line of p and q, and the closed segment p q meet? */
bool onSegment(const Point& p, const Point& q, const Point& r)
{
  // On a line the order along each axis decides, and all three agree.
  return (r.array() >= p.array().min(q.array())).all() && (r.array() <= p.array().max(q.array())).all();
}

/** Closed segments in one plane, seen along an axis from which the plane is no line. */
bool segmentsMeetAlong(int axis, const Point& p, const Point& q, const Point& r, const Point& s)
{
  const int pr = orientAlong(axis, p, q, r);
  const int ps = orientAlong(axis, p, q, s);
  const int rp = orientAlong(axis, r, s, p);
  const int rq = orientAlong(axis, r, s, q);
  if (pr * ps < 0 && rp * rq < 0)
  {
    return true;
  }
  return (pr == 0 && onSegment(p, q, r)) || (ps == 0 && onSegment(p, q, s)) ||
    (rp == 0 && onSegment(r, s, p)) || (rq == 0 && onSegment(r, s, q));
}

/** Closed segments, perhaps of length 0, anywhere in space. */
bool segmentsMeet(const Point& p, const Point& q, const Point& r, const Point& s)
{
  if (orient3d(p, q, r, s) != 0)
  {
    return false;
  }
  for (const auto& three :
    { Corners{ &p, &q, &r }, Corners{ &p, &q, &s }, Corners{ &r, &s, &p }, Corners{ &r, &s, &q } })
  {
    const int axis = spreadAxis(*three[0], *three[1], *three[2]);
    if (axis >= 0)
    {
      return segmentsMeetAlong(axis, p, q, r, s);
    }
  }
  return onSegment(p, q, r) || onSegment(p, q, s) || onSegment(r, s, p) || onSegment(r, s, q);
}

/** The closed segment and the closed triangle lie in one plane, which is no line along `axis`. */
bool segmentMeetsCoplanar(int axis, const Point& p, const Point& q, const Corners& t)
{
  std::array<int, 3> side;
  for (int c = 0; c < 3; ++c)
  {
    const Point& from = *t[c];
    const Point& to = *t[(c + 1) % 3];
    if (segmentsMeetAlong(axis, p, q, from, to))
    {
      return true;
    }
    side[c] = orientAlong(axis, from, to, p);
  }
  // The segment meets no edge: it lies wholly inside or wholly outside.
  return side[0] == side[1] && side[1] == side[2];
}

bool segmentMeetsTriangle(const Point& p, const Point& q, const Corners& t)
{
  const int sp = orient3d(*t[0], *t[1], *t[2], p);
  const int sq = orient3d(*t[0], *t[1], *t[2], q);
  if (sp * sq > 0)
  {
    return false;
  }
  if (sp == 0 && sq == 0)
  {
    const int axis = spreadAxis(*t[0], *t[1], *t[2]);
    if (axis >= 0)
    {
      return segmentMeetsCoplanar(axis, p, q, t);
    }
    return segmentsMeet(p, q, *t[0], *t[1]) || segmentsMeet(p, q, *t[1], *t[2]) ||
      segmentsMeet(p, q, *t[2], *t[0]);
  }
  // The segment reaches the plane in one point; the line through it passes all edges on one side, or touches.
  bool left = false;
  bool right = false;
  for (int c = 0; c < 3; ++c)
  {
    const int side = orient3d(p, q, *t[c], *t[(c + 1) % 3]);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

/** True where plane a has b strictly on one side. A degenerate `a` has no plane. */
bool planeSeparates(const Corners& a, const Corners& b)
{
  const int side = orient3d(*a[0], *a[1], *a[2], *b[0]);
  return side != 0 && orient3d(*a[0], *a[1], *a[2], *b[1]) == side &&
    orient3d(*a[0], *a[1], *a[2], *b[2]) == side;
}

bool disjointMeet(const Corners& a, const Corners& b)
{
  if (planeSeparates(a, b) || planeSeparates(b, a))
  {
    return false;
  }
  for (int c = 0; c < 3; ++c)
  {
    if (segmentMeetsTriangle(*a[c], *a[(c + 1) % 3], b) || segmentMeetsTriangle(*b[c], *b[(c + 1) % 3], a))
    {
      return true;
    }
  }
  return false;
}

/** Corner 0 is shared and all lies in one plane: do the angles at that corner overlap, or touch in a ray? */
bool anglesMeet(const Corners& a, const Corners& b)
{
  const int axis = spreadAxis(*a[0], *a[1], *a[2]);
  if (axis < 0)
  {
    return false;
  }
  const auto side = [axis, &a](const Point* p, const Point* q) { return orientAlong(axis, *a[0], *p, *q); };
  const int turnA = side(a[1], a[2]);
  const int turnB = side(b[1], b[2]);
  const std::array<std::array<int, 2>, 2> turn{ { { side(a[1], b[1]), side(a[1], b[2]) },
    { side(a[2], b[1]), side(a[2], b[2]) } } };
  if (turnB == 0)
  {
    return false;
  }
  for (int c = 0; c < 2; ++c)
  {
    const bool edgeOfB = turnA * turn[0][c] >= 0 && turnA * turn[1][c] <= 0;
    const bool edgeOfA = turnB * turn[c][0] <= 0 && turnB * turn[c][1] >= 0;
    if (edgeOfA || edgeOfB)
    {
      return true;
    }
  }
  return false;
}

/** Corner 0 is shared. */
bool meetBeyondCorner(const Corners& a, const Corners& b)
{
  const int side1 = orient3d(*a[0], *a[1], *a[2], *b[1]);
  const int side2 = orient3d(*a[0], *a[1], *a[2], *b[2]);
  if (side1 == 0 && side2 == 0)
  {
    return anglesMeet(a, b);
  }
  if (side1 * side2 > 0 || orient3d(*b[0], *b[1], *b[2], *a[1]) * orient3d(*b[0], *b[1], *b[2], *a[2]) > 0)
  {
    return false;
  }
  // What the triangles have in common is convex and holds the corner. Were it more, the ray from the corner
  // through another common point would leave one of them through the edge that faces the corner.
  return segmentMeetsTriangle(*a[1], *a[2], b) || segmentMeetsTriangle(*b[1], *b[2], a);
}

/** Corners 0 and 1 are shared. */
bool foldedOntoEachOther(const Corners& a, const Corners& b)
{
  if (orient3d(*a[0], *a[1], *a[2], *b[2]) != 0)
  {
    return false;
  }
  const int axis = spreadAxis(*a[0], *a[1], *a[2]);
  return axis >= 0 && orientAlong(axis, *a[0], *a[1], *a[2]) == orientAlong(axis, *a[0], *a[1], *b[2]);
}

} // namespace

bool isDegenerate(const std::vector<Point>& points, const Triangle& t)
{
  return spreadAxis(points[t[0]], points[t[1]], points[t[2]]) < 0;
}

bool trianglesIntersect(const std::vector<Point>& points, const Triangle& a, const Triangle& b)
{
  // Shared corners come first in both, in the same order.
  Triangle sortedA = a;
  Triangle sortedB = b;
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    const auto other = std::find(sortedB.begin() + shared, sortedB.end(), sortedA[i]);
    if (other != sortedB.end())
    {
      std::swap(sortedA[i], sortedA[shared]);
      std::swap(*other, sortedB[shared]);
      ++shared;
    }
  }
  const Corners cornersA = cornersOf(points, sortedA);
  const Corners cornersB = cornersOf(points, sortedB);
  const auto degenerate = [&] { return isDegenerate(points, a) || isDegenerate(points, b); };
  switch (shared)
  {
    case 0:
      return disjointMeet(cornersA, cornersB);
    case 1:
      return meetBeyondCorner(cornersA, cornersB) && !degenerate();
    case 2:
      return foldedOntoEachOther(cornersA, cornersB);
    default:
      return !degenerate();
  }
}

} // namespace silhouette
