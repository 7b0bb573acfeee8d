// SPDX-License-Identifier: BSD-3-Clause
#include "SubPixelCrossing.h"

#include <algorithm>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr double Reach = 2.0; ///< octants: an edge that a contour crosses has its ends within one

/**
 * Is a place between object pixels alone, so that its distance is above 0? For most views it is; the pixels' bits are
 * in the processor's caches, the distances are not.
 */
bool amongObject(const PreparedView& view, const FieldViews::Place& place)
{
  constexpr std::uint64_t Four = 0x0303; // two by two pixels
  return place.u >= 0.0 && place.v >= 0.0 && place.u < view.width - 1 && place.v < view.height - 1 &&
    (view.window(int(place.u), int(place.v)) & Four) == Four;
}

/** Where a view's distance falls to 0; where both ends are on one side of it, the end that is nearer to the contour. */
double fallOf(double from, double to)
{
  return from <= 0.0 ? 0.0 : to >= 0.0 ? 1.0 : from / (from - to);
}

/** The least of the views' falls that `allowed` others precede; changes their order. */
double fallAfter(std::vector<double>& falls, std::ptrdiff_t allowed)
{
  if (allowed < 0 || allowed >= std::ptrdiff_t(falls.size()))
  {
    return allowed < 0 ? 0.0 : 1.0;
  }
  std::nth_element(falls.begin(), falls.begin() + allowed, falls.end());
  return falls[std::size_t(allowed)];
}

} // namespace

SubPixelCrossing::SubPixelCrossing(const LatticeViews& views, Execution& execution)
  : Views(&views)
  , Fields(views.prepared(), views.lattice(), Reach)
{
  std::vector<int> all(std::size_t(views.size()));
  std::iota(all.begin(), all.end(), 0);
  this->Fields.observe(all, execution);
}

bool SubPixelCrossing::outside(int view, const FieldViews::Place& place) const
{
  return !amongObject(this->Views->view(view), place) && this->distance(view, place) <= 0.0;
}

bool SubPixelCrossing::inside(const LatticePoint& p, int backgroundVotes) const
{
  int against = 0;
  bool seen = false;
  for (int view = 0; view < this->Views->size() && against <= backgroundVotes; ++view)
  {
    const FieldViews::Place place = this->Fields.place(view, p);
    seen |= place.octantsPerPixel > 0.0;
    against += this->outside(view, place);
  }
  return seen && against <= backgroundVotes;
}

double SubPixelCrossing::operator()(
  const ViewsToAsk& ask, const LatticePoint& inside, const LatticePoint& outside, int backgroundVotes) const
{
  thread_local std::vector<double> falls; // its memory is kept
  falls.clear();
  ask.forEach(
    [&](int view)
    {
      if (this->Views->vote(view, outside) == Vote::Background)
      {
        // A view against both ends counts from the start, as it does for an octant of which it is not asked.
        const bool against = backgroundVotes > 0 && this->Views->vote(view, inside) == Vote::Background;
        falls.push_back(against ? 0.0 : fallOf(this->distance(view, inside), this->distance(view, outside)));
      }
    });
  return fallAfter(falls, backgroundVotes - ask.backgroundVotes);
}

double SubPixelCrossing::operator()(
  const LatticePoint& inside, const LatticePoint& outside, int backgroundVotes) const
{
  thread_local std::vector<double> falls;
  falls.clear();
  for (int view = 0; view < this->Views->size(); ++view)
  {
    const FieldViews::Place place = this->Fields.place(view, outside);
    if (this->outside(view, place))
    {
      falls.push_back(fallOf(this->distance(view, inside), this->distance(view, place)));
    }
  }
  return fallAfter(falls, backgroundVotes);
}

} // namespace silhouette
