// SPDX-License-Identifier: BSD-3-Clause
#include "CornerDepth.h"

#include "Bits.h"
#include "Error.h"
#include "SilhouetteDissent.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace silhouette
{
namespace
{

/** Of a pixel's square from a coordinate, along one axis. */
double away(int pixel, double coordinate)
{
  return std::max(std::abs(pixel - coordinate) - 0.5, 0.0);
}

/** Distance along a row of pixels to the nearest object, px; `most` where it is no less. */
double nearestInRow(const PreparedView& view, double u, int row, double most)
{
  const int column = int(std::floor(u + 0.5));
  const auto holds = [&](int steps) { return view.content(column - steps, column + steps, row, row).object; };
  int within = int(std::ceil(most)), without = -1;
  if (!holds(within))
  {
    return most;
  }
  while (within - without > 1)
  {
    const int middle = (within + without) / 2;
    (holds(middle) ? within : without) = middle;
  }
  for (const int pixel : { column - within, column + within })
  {
    if (view.pixelVote(pixel, row) == Vote::Object)
    {
      most = std::min(most, away(pixel, u));
    }
  }
  return most;
}

constexpr double WindowReach = 7.0; ///< px: pixels nearer than that to a place lie in the four windows around its own
constexpr double CentreReach = 3.0; ///< px: the same of the one window around it

/** The window of 8 x 8 pixels from (column, row) on, all of them in the image: `square` becomes that of the distance to its nearest object, if that is less. */
void searchWindow(const PreparedView& view, int column, int row, double u, double v, double& square)
{
  const std::uint64_t window = view.window(column, row);
  const unsigned before = (1u << std::clamp(int(std::floor(u + 0.5)) - column, 0, 8)) - 1; // columns less than the place's own
  for (std::uint64_t rows = window; rows != 0;)
  {
    const int shift = lowestBit(rows) & 56; // the next row that holds any
    rows &= ~(std::uint64_t(0xff) << shift);
    const double across = away(row + shift / 8, v);
    const unsigned pixels = unsigned(window >> shift & 0xff);
    if (across * across >= square)
    {
      continue;
    }
    if ((pixels & before) != 0)
    {
      const double along = away(column + highestBit(pixels & before), u);
      square = std::min(square, along * along + across * across);
    }
    if ((pixels & ~before) != 0)
    {
      const double along = away(column + lowestBit(pixels & ~before), u);
      square = std::min(square, along * along + across * across);
    }
  }
}

/** nearestObject() by the windows around (column, row), all of them in the image; `most` is WindowReach at most. */
double nearestInWindows(const PreparedView& view, int column, int row, double u, double v, double most)
{
  double square = most * most;
  searchWindow(view, column - 4, row - 4, u, v, square); // where most are found
  if (square > CentreReach * CentreReach)
  {
    for (const int below : { 0, -8 })
    {
      searchWindow(view, column - 8, row + below, u, v, square);
      searchWindow(view, column, row + below, u, v, square);
    }
  }
  return std::sqrt(square);
}

/** Distance from a place in the image to the nearest pixel square of the object, px; `most` where it is no less. */
double nearestObject(const PreparedView& view, double u, double v, double most)
{
  const int column = int(std::floor(u + 0.5)), row = int(std::floor(v + 0.5));
  if (most <= WindowReach && view.inImage(column - 8, column + 7, row - 8, row + 7))
  {
    return nearestInWindows(view, column, row, u, v, most);
  }
  const int first = std::clamp(row, 0, view.height - 1);
  double square = most * most;
  bool any = true;
  for (int steps = 0; any; ++steps)
  {
    any = false;
    for (const int other : { first - steps, first + steps })
    {
      const double across = away(other, v);
      if (other >= 0 && other < view.height && across * across < square)
      {
        any = true;
        const double along = nearestInRow(view, u, other, std::sqrt(square - across * across));
        square = std::min(square, along * along + across * across);
      }
    }
  }
  return std::sqrt(square);
}

} // namespace

CornerDepth::CornerDepth(const Octree& octree, const LatticeViews& views, double reach)
  : Views(&views)
  , Undecided(octree, views)
  , BackgroundVotes(octree.backgroundVotes)
  , Reach(reach)
{
  if (this->BackgroundVotes < 0 || this->BackgroundVotes >= views.size())
  {
    throw InvalidInput("background votes " + std::to_string(this->BackgroundVotes) + ": 0 to " + std::to_string(views.size() - 1) +
      " are possible with " + std::to_string(views.size()) + " views");
  }
  if (!(reach > 0.0))
  {
    throw InvalidInput("reach " + std::to_string(reach) + " octants is not above 0");
  }
}

double CornerDepth::operator()(const LatticePoint& p, OctantCursor& octants, double least) const
{
  std::vector<double> outside;
  int beyond = 0;         // views that are farther away than `least` allows
  double nearest = 0.0; // of these
  this->Undecided.around(p, octants).forEach(
    [&](int view)
    {
      if (beyond <= this->BackgroundVotes && this->Views->vote(view, p) == Vote::Background)
      {
        outside.push_back(this->outsideView(view, p));
        const bool isBeyond = -outside.back() < least;
        nearest = isBeyond && (beyond == 0 || outside.back() < nearest) ? outside.back() : nearest;
        beyond += isBeyond;
      }
    });
  if (beyond > this->BackgroundVotes)
  {
    return -nearest;
  }
  if (int(outside.size()) <= this->BackgroundVotes)
  {
    return 0.0;
  }
  std::nth_element(outside.begin(), outside.begin() + this->BackgroundVotes, outside.end(), std::greater<double>());
  return -outside[std::size_t(this->BackgroundVotes)];
}

double CornerDepth::outsideView(int view, const LatticePoint& p) const
{
  const PreparedView& prepared = this->Views->view(view);
  const LatticeProjection& projection = this->Views->projection(view);
  const auto h = projection(p);
  const double scale = pixelsPerOctant(projection, p);
  // Far outside the image nothing is near: the whole reach.
  const double u = std::clamp(h.U / h.W, -1e8, 1e8), v = std::clamp(h.V / h.W, -1e8, 1e8);
  return std::min(this->Reach, nearestObject(prepared, u, v, std::min(this->Reach * scale, 1e8)) / scale);
}

} // namespace silhouette
