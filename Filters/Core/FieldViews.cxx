// SPDX-License-Identifier: BSD-3-Clause
#include "FieldViews.h"

#include "Vectorised.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr int Points = int(FieldViews::BlockPoints);

/** The points of a block, from its lowest on, in Morton order. */
struct BlockOffsets
{
  double i[Points], j[Points], k[Points];

  BlockOffsets()
  {
    for (int n = 0; n < Points; ++n)
    {
      const LatticePoint p = fromMorton(std::uint64_t(n));
      this->i[n] = p.i;
      this->j[n] = p.j;
      this->k[n] = p.k;
    }
  }
};

/** Where the points of a block fall in a map that has all four samples around each of them. */
struct BlockPlaces
{
  double octantsPerPixel[Points];
  std::int32_t sample[Points]; ///< the upper left one of the four
  float s[Points], t[Points];
  float value[4][Points];
};

SILHOUETTE_VECTORISED void placeBlock(
  const LatticeProjection& projection, const LatticePoint& lowest, double depthScale, const DistanceFrame& frame,
  const BlockOffsets& offsets, BlockPlaces& places)
{
  const auto& c = projection.constant;
  const auto& step = projection.step;
  for (int n = 0; n < Points; ++n)
  {
    const double i = lowest.i + offsets.i[n], j = lowest.j + offsets.j[n], k = lowest.k + offsets.k[n];
    const double U = ((c[0] + step[0][0] * i) + step[1][0] * j) + step[2][0] * k;
    const double V = ((c[1] + step[0][1] * i) + step[1][1] * j) + step[2][1] * k;
    const double W = ((c[2] + step[0][2] * i) + step[1][2] * j) + step[2][2] * k;
    const double inverse = 1.0 / W;
    const double x = (U * inverse - frame.left) * frame.samplesPerPixel, y = (V * inverse - frame.top) * frame.samplesPerPixel;
    const std::int32_t column = std::int32_t(x), row = std::int32_t(y);
    places.octantsPerPixel[n] = W * depthScale;
    places.sample[n] = row * frame.columns + column;
    places.s[n] = float(x - column);
    places.t[n] = float(y - row);
  }
}

SILHOUETTE_VECTORISED void interpolateBlock(const BlockPlaces& places, float reach, float* inside)
{
  for (int n = 0; n < Points; ++n)
  {
    const float s = places.s[n], t = places.t[n];
    const float pixels = (places.value[0][n] * (1 - s) + places.value[1][n] * s) * (1 - t) +
      (places.value[2][n] * (1 - s) + places.value[3][n] * s) * t;
    const float octants = float(pixels * places.octantsPerPixel[n]);
    const float least = octants < -reach ? -reach : octants;
    inside[n] = reach < least ? reach : least;
  }
}

} // namespace

FieldViews::FieldViews(const PreparedViews& views, const Lattice& lattice, double reach, double samples)
  : Views(&views)
  , TheLattice(lattice)
  , Reach(reach)
  , Samples(samples)
  , Shifts(views.size(), Vector2::Zero())
  , Projections(views.size())
  , OnLattice(views.size())
  , CentreScale(views.size(), 1.0)
  , DepthScale(views.size(), 1.0)
  , Observed(views.size())
{
  const int middle = lattice.cells() / 2;
  for (int view = 0; view < views.size(); ++view)
  {
    this->project(view);
    const HomogeneousPixel h = this->OnLattice[view]({ middle, middle, middle });
    if (h.W > this->OnLattice[view].minimumDepth)
    {
      this->CentreScale[view] = silhouette::pixelsPerOctant(this->OnLattice[view], { middle, middle, middle });
      this->DepthScale[view] = 1.0 / (h.W * this->CentreScale[view]);
    }
  }
}

Eigen::Matrix<double, 2, 3> FieldViews::pixelSteps(int view) const
{
  const int middle = this->TheLattice.cells() / 2;
  return silhouette::pixelSteps(this->OnLattice[view], { middle, middle, middle });
}

void FieldViews::observe(const std::vector<int>& views, Execution& execution)
{
  execution.forRanges(views.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        DistanceMap& map = this->Observed[views[i]];
        if (map.width == 0)
        {
          map = this->distances(views[i], (*this->Views)[views[i]].silhouette());
        }
      }
    });
}

DistancesOnDemand FieldViews::observedOnDemand(int view) const
{
  const PreparedView& seen = (*this->Views)[view];
  return DistancesOnDemand(seen.silhouette(), seen.width, seen.height, this->reachInPixels(view));
}

double FieldViews::reachInPixels(int view) const
{
  return 1.25 * this->Reach * this->CentreScale[view]; // octants nearer to the camera than the middle are larger
}

void FieldViews::project(int view)
{
  Projection& projection = this->Projections[view];
  projection = (*this->Views)[view].projection;
  projection.row(0) += this->Shifts[view][0] * projection.row(2);
  projection.row(1) += this->Shifts[view][1] * projection.row(2);
  this->OnLattice[view] = LatticeProjection(projection, this->TheLattice);
}

void FieldViews::addShift(int view, const Vector2& shift)
{
  this->Shifts[view] += shift;
  this->project(view);
}

FieldViews::Place FieldViews::place(int view, const LatticePoint& p) const
{
  const LatticeProjection& projection = this->OnLattice[view];
  const HomogeneousPixel h = projection(p);
  if (!(h.W > projection.minimumDepth))
  {
    return {};
  }
  const double inverse = 1.0 / h.W;
  Place place{ h.U * inverse, h.V * inverse, h.W * this->DepthScale[view] };
  const PreparedView& seen = (*this->Views)[view];
  if (place.u < -0.5 || place.v < -0.5 || place.u >= seen.width - 0.5 || place.v >= seen.height - 0.5)
  {
    const int column = PreparedView::nearestPixel(place.u, seen.width);
    const int row = PreparedView::nearestPixel(place.v, seen.height);
    if (seen.pixelVote(column, row) == Vote::Abstain)
    {
      place.octantsPerPixel = 0.0;
    }
  }
  return place;
}

FieldViews::Region FieldViews::region(int view, const LatticePoint& lowest, int size) const
{
  constexpr double guard = 1e-3; // px: more than the corners' places and the points' are rounded by
  const LatticeProjection& projection = this->OnLattice[view];
  const double infinity = std::numeric_limits<double>::infinity();
  Region region{ infinity, -infinity, infinity, -infinity, infinity };
  for (int n = 0; n < 8; ++n)
  {
    const LatticePoint o = cornerOffset(n);
    const HomogeneousPixel h =
      projection({ lowest.i + (size - 1) * o.i, lowest.j + (size - 1) * o.j, lowest.k + (size - 1) * o.k });
    if (!(h.W > projection.minimumDepth))
    {
      return {};
    }
    const double inverse = 1.0 / h.W, u = h.U * inverse, v = h.V * inverse;
    region = { std::min(region.firstU, u - guard), std::max(region.lastU, u + guard), std::min(region.firstV, v - guard),
      std::max(region.lastV, v + guard), std::min(region.octantsPerPixel, 0.999 * h.W * this->DepthScale[view]) };
  }
  return region;
}

void FieldViews::insideBlock(
  int view, const DistanceMap& map, const LatticePoint& lowest, const Region& region, float* inside) const
{
  const bool within = region.octantsPerPixel > 0.0 && !map.value.empty() && region.firstU >= map.left &&
    region.firstV >= map.top && region.lastU < map.left + map.lastColumn && region.lastV < map.top + map.lastRow;
  if (!within || map.value.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
  {
    for (int n = 0; n < Points; ++n)
    {
      inside[n] = this->inside(map, this->place(view, lowest + fromMorton(std::uint64_t(n))));
    }
    return;
  }
  static const BlockOffsets offsets;
  BlockPlaces places;
  placeBlock(this->OnLattice[view], lowest, this->DepthScale[view], map, offsets, places);
  for (int n = 0; n < Points; ++n)
  {
    const float* sample = &map.value[std::size_t(places.sample[n])];
    places.value[0][n] = sample[0];
    places.value[1][n] = sample[1];
    places.value[2][n] = sample[map.columns];
    places.value[3][n] = sample[map.columns + 1];
  }
  interpolateBlock(places, float(this->Reach), inside);
}

std::vector<ImageCamera> FieldViews::cameras(const std::vector<int>& views) const
{
  std::vector<ImageCamera> cameras;
  for (const int view : views)
  {
    const PreparedView& seen = (*this->Views)[view];
    cameras.push_back({ this->Projections[view], seen.width, seen.height });
  }
  return cameras;
}

DistanceMap FieldViews::distances(int view, const std::uint8_t* object) const
{
  const PreparedView& seen = (*this->Views)[view];
  const double spacing = this->Samples > 0.0 ? std::min(this->CentreScale[view] / this->Samples, double(seen.width)) : 1.0;
  return distanceMap(object, seen.width, seen.height, this->reachInPixels(view), int(spacing));
}

std::vector<DistanceMap> FieldViews::distances(const Mesh& mesh, Execution& execution) const
{
  std::vector<int> all(std::size_t(this->size()));
  std::iota(all.begin(), all.end(), 0);
  const OutlineRenderer renderer(mesh, this->cameras(all), execution);
  std::vector<DistanceMap> maps(all.size());
  execution.forRanges(maps.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        maps[i] = this->distances(int(i), imageOf(renderer.render(i)).pixels.data());
      }
    });
  return maps;
}

} // namespace silhouette
