// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteDepth.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace silhouette
{
namespace
{

struct Place
{
  double u = 0.0;
  double v = 0.0;
  double pixelsPerOctant = 0.0; ///< 0 behind the camera
};

Place project(const LatticeProjection& projection, const Vector3& p)
{
  std::array<double, 3> h = projection.constant;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int row = 0; row < 3; ++row)
    {
      h[row] += projection.step[axis][row] * p[axis];
    }
  }
  if (!(h[2] > projection.minimumDepth))
  {
    return {};
  }
  Place place{ h[0] / h[2], h[1] / h[2], 0.0 };
  double square = 0.0;
  for (const auto& step : projection.step)
  {
    const double du = step[0] - place.u * step[2], dv = step[1] - place.v * step[2];
    square += 0.5 * (du * du + dv * dv);
  }
  place.pixelsPerOctant = std::sqrt(square) / h[2];
  return place;
}

} // namespace

SilhouetteDepth::SilhouetteDepth(const LatticeViews& views, int backgroundVotes, double reach, Execution& execution,
  const std::vector<Vector2>& shifts)
  : Views(&views)
  , BackgroundVotes(backgroundVotes)
  , Reach(reach)
  , Shifts(shifts)
  , Probes(views.size())
{
  if (backgroundVotes < 0 || backgroundVotes >= views.size())
  {
    throw InvalidInput(
      std::to_string(backgroundVotes) + " background votes: 0 to " + std::to_string(views.size() - 1) + " are possible");
  }
  if (!(reach > 0.0 && std::isfinite(reach)))
  {
    throw InvalidInput("depths up to " + std::to_string(reach) + " octants: the reach has to be positive");
  }
  if (!shifts.empty() && int(shifts.size()) != views.size())
  {
    throw InvalidInput(std::to_string(shifts.size()) + " shifts for " + std::to_string(views.size()) + " views");
  }
  this->Shifts.resize(views.size(), Vector2::Zero());
  const Vector3 middle = Vector3::Constant(0.5 * views.lattice().cells());
  execution.forRanges(this->Probes.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const PreparedView& view = views.view(int(i));
        // Octants nearer to the camera than the middle are larger.
        const double pixels = 1.5 * reach * project(views.projection(int(i)), middle).pixelsPerOctant;
        this->Probes[i] =
          std::make_unique<const DistanceProbe>(view.silhouette(), view.width, view.height, std::max(pixels, 2.0));
      }
    });
  execution.checkpoint(1.0);
}

double SilhouetteDepth::inView(int i, const Vector3& p) const
{
  const Place place = project(this->Views->projection(i), p);
  const PreparedView& view = this->Views->view(i);
  const double u = place.u + this->Shifts[i][0], v = place.v + this->Shifts[i][1];
  if (place.pixelsPerOctant == 0.0)
  {
    return this->Reach;
  }
  const bool outside = u < -0.5 || v < -0.5 || u >= view.width - 0.5 || v >= view.height - 0.5;
  if (outside &&
    view.pixelVote(PreparedView::nearestPixel(u, view.width), PreparedView::nearestPixel(v, view.height)) == Vote::Abstain)
  {
    return this->Reach;
  }
  return std::clamp(this->Probes[i]->at(u, v) / place.pixelsPerOctant, -this->Reach, this->Reach);
}

double SilhouetteDepth::operator()(const Vector3& p, double enough, int& first) const
{
  const int count = this->Views->size(), asked = first;
  double least = this->Reach;
  const auto depthOf = [&](int n)
  {
    const int view = n == 0 ? asked : n - int(n <= asked); // the first, and the others in their order
    const double depth = this->inView(view, p);
    first = depth < least ? view : first;
    least = std::min(least, depth);
    return depth;
  };
  if (this->BackgroundVotes == 0)
  {
    for (int n = 0; n < count && least > enough; ++n)
    {
      depthOf(n);
    }
    return least;
  }
  std::vector<double> smallest(std::size_t(this->BackgroundVotes) + 1, this->Reach); // ascending
  for (int n = 0; n < count && smallest.back() > enough; ++n)
  {
    const double depth = depthOf(n);
    if (depth < smallest.back())
    {
      smallest.back() = depth;
      for (std::size_t k = smallest.size() - 1; k > 0 && smallest[k] < smallest[k - 1]; --k)
      {
        std::swap(smallest[k], smallest[k - 1]);
      }
    }
  }
  return smallest.back();
}

} // namespace silhouette
