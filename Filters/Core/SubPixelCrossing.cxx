// SPDX-License-Identifier: BSD-3-Clause
#include "SubPixelCrossing.h"

#include <algorithm>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr double Reach = 2.0; ///< octants: an edge that a contour crosses has its ends within one

} // namespace

SubPixelCrossing::SubPixelCrossing(const LatticeViews& views, Execution& execution)
  : Views(&views)
  , Fields(views.prepared(), views.lattice(), Reach)
{
  std::vector<int> all(std::size_t(views.size()));
  std::iota(all.begin(), all.end(), 0);
  this->Fields.observe(all, execution);
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
        const DistanceMap& map = this->Fields.observed(view);
        const double from = this->Fields.inside(map, this->Fields.place(view, inside));
        const double to = this->Fields.inside(map, this->Fields.place(view, outside));
        // The nearest pixel may tell another side than the distance: then the end itself is nearest to the contour.
        falls.push_back(from <= 0.0 ? 0.0 : to >= 0.0 ? 1.0 : from / (from - to));
      }
    });
  const std::ptrdiff_t allowed = backgroundVotes - ask.backgroundVotes;
  if (allowed < 0 || allowed >= std::ptrdiff_t(falls.size()))
  {
    return allowed < 0 ? 0.0 : 1.0;
  }
  std::nth_element(falls.begin(), falls.begin() + allowed, falls.end());
  return falls[std::size_t(allowed)];
}

} // namespace silhouette
