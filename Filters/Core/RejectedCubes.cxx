// SPDX-License-Identifier: BSD-3-Clause
#include "RejectedCubes.h"

#include "OctantTest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace silhouette
{
namespace
{

/** The box of a cube's image and the least depth. */
struct ImageBox
{
  double least[2] = { std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() };
  double most[2] = { -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  double leastW = std::numeric_limits<double>::infinity();
};

ImageBox imageBox(const LatticeProjection& projection, const PointCube& cube)
{
  ImageBox box;
  const LatticePoint low = fromMorton(cube.corner);
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint o = cornerOffset(c);
    const std::int32_t reach = cube.side - 1;
    const auto h = projection({ low.i + reach * o.i, low.j + reach * o.j, low.k + reach * o.k });
    const double image[2] = { h.U / h.W, h.V / h.W };
    for (int axis = 0; axis < 2; ++axis)
    {
      box.least[axis] = std::min(box.least[axis], image[axis]);
      box.most[axis] = std::max(box.most[axis], image[axis]);
    }
    box.leastW = std::min(box.leastW, h.W);
  }
  return box;
}

/** As much as pixelsPerOctant(), or more, at any point whose image is in the box. */
double mostPixelsPerOctant(const LatticeProjection& projection, const ImageBox& box)
{
  double squares = 0.0;
  for (const auto& step : projection.step)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const double most = std::max(std::abs(step[axis] - box.least[axis] * step[2]), std::abs(step[axis] - box.most[axis] * step[2]));
      squares += most * most;
    }
  }
  return std::sqrt(0.5 * squares) / box.leastW;
}

} // namespace

PointCube RejectedCubes::around(std::uint64_t corner, int view)
{
  if (this->Last.side > 0 && corner >= this->Last.corner && corner < this->Last.end())
  {
    return this->Last;
  }
  const std::int32_t n = this->Views.lattice().cells();
  const auto cubeAround = [&](std::int32_t side) { return PointCube{ corner & ~(PointCube{ 0, side }.size() - 1), side }; };
  // What a larger cube's image holds its cubes' images hold; from the largest on, so that two points of a cube cannot come to different ones.
  for (std::int32_t side = this->isFree(view, cubeAround(LeastCube), 0.0, 0.0) ? n : 0; side >= LeastCube; side /= 2)
  {
    const PointCube cube = cubeAround(side);
    const LatticePoint low = fromMorton(cube.corner);
    if (std::max({ low.i, low.j, low.k }) + side - 1 <= n && this->isFree(view, cube, this->Depth, 1.0) && this->isObjectElsewhere(view, cube))
    {
      this->Last = cube;
      return cube;
    }
  }
  return {};
}

/** Is there nothing but background in the cube's image and as far around it as `depth` octants and `guard` pixels? */
bool RejectedCubes::isFree(int i, const PointCube& cube, double depth, double guard) const
{
  const LatticeProjection& projection = this->Views.projection(i);
  const ImageBox box = imageBox(projection, cube);
  if (!(box.leastW > projection.minimumDepth))
  {
    return false;
  }
  const PreparedView& view = this->Views.view(i);
  const double wider = depth * mostPixelsPerOctant(projection, box) + guard;
  const auto content = view.content(
    PreparedView::nearestPixel(box.least[0] - wider, view.width), PreparedView::nearestPixel(box.most[0] + wider, view.width),
    PreparedView::nearestPixel(box.least[1] - wider, view.height), PreparedView::nearestPixel(box.most[1] + wider, view.height));
  return !content.object && !content.abstain;
}

/** Does no other view see background of the cube, and half of all views nothing but object? */
bool RejectedCubes::isObjectElsewhere(int view, const PointCube& cube)
{
  const OctantBox box{ fromMorton(cube.corner), cube.side - 1 };
  int object = 0;
  const auto mayBeObject = [&](int i)
  {
    const ViewRelation relation = relate(this->Views.view(i), this->Views.projection(i), box);
    object += relation == ViewRelation::Inside;
    return relation != ViewRelation::Background && relation != ViewRelation::Mixed;
  };
  const int first = this->Objector;
  for (int n = 0; n < this->Views.size(); ++n)
  {
    const int i = n == 0 ? first : (n <= first ? n - 1 : n); // the last objector first
    if (i != view && !mayBeObject(i))
    {
      this->Objector = i;
      return false;
    }
  }
  return 2 * object >= this->Views.size();
}

} // namespace silhouette
