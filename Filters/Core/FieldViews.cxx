// SPDX-License-Identifier: BSD-3-Clause
#include "FieldViews.h"

#include "SharedWork.h"
#include "Vectorised.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr int Points = int(FieldViews::BlockPoints);
constexpr std::size_t GroupPoints = BlockGroups::Points;

/** Steps from a block's lowest point to its points, in Morton order. */
struct BlockOffsets
{
  float i[Points], j[Points], k[Points];

  BlockOffsets()
  {
    for (int n = 0; n < Points; ++n)
    {
      const LatticePoint p = fromMorton(std::uint64_t(n));
      this->i[n] = float(p.i);
      this->j[n] = float(p.j);
      this->k[n] = float(p.k);
    }
  }
};

/**
 * How a view sees a block, from where its lowest point falls on: single precision is enough for the pixels from there to the others. Where a point is many times
 * nearer to the camera, its place is that much less right, but a pixel is that much less of an octant.
 */
struct BlockProjection
{
  double u, v, octantsPerPixel; ///< of the lowest point
  float stepU[3], stepV[3];     ///< px for a step on each axis, at that point's depth
  float stepDepth[3];           ///< by how much of that depth a step is further away

  BlockProjection(const LatticeProjection& projection, const LatticePoint& lowest, double depthScale)
  {
    const HomogeneousPixel h = projection(lowest);
    const double inverse = 1.0 / h.W;
    this->u = h.U * inverse;
    this->v = h.V * inverse;
    this->octantsPerPixel = h.W * depthScale;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto& step = projection.step[axis];
      this->stepU[axis] = float((step[0] - this->u * step[2]) * inverse);
      this->stepV[axis] = float((step[1] - this->v * step[2]) * inverse);
      this->stepDepth[axis] = float(step[2] * inverse);
    }
  }
};

/** Where the points of some of a block's groups fall, px from where its lowest point does: one group's after another's, as in all that is told of them. */
struct BlockPlaces
{
  float u[Points], v[Points], octantsPerPixel[Points];
};

SILHOUETTE_VECTORISED void placeBlock(const BlockProjection& block, const BlockOffsets& offsets, const BlockGroups& groups, BlockPlaces& places)
{
  const auto octantsPerPixel = float(block.octantsPerPixel);
  for (std::size_t m = 0; m < groups.size(); ++m)
  {
    const std::size_t first = groups.first(m);
    const float *const is = offsets.i + first, *const js = offsets.j + first, *const ks = offsets.k + first;
    float *const u = places.u + m * GroupPoints, *const v = places.v + m * GroupPoints, *const scale = places.octantsPerPixel + m * GroupPoints;
    for (std::size_t n = 0; n < GroupPoints; ++n)
    {
      const float i = is[n], j = js[n], k = ks[n];
      const float depth = 1.0f + ((block.stepDepth[0] * i + block.stepDepth[1] * j) + block.stepDepth[2] * k);
      const float inverse = 1.0f / depth;
      u[n] = ((block.stepU[0] * i + block.stepU[1] * j) + block.stepU[2] * k) * inverse;
      v[n] = ((block.stepV[0] * i + block.stepV[1] * j) + block.stepV[2] * k) * inverse;
      scale[n] = octantsPerPixel * depth;
    }
  }
}

constexpr int Corners = 8; ///< of a cube

struct CornerPlaces
{
  double u[Corners], v[Corners], W[Corners];
};

/** Where the corners of a cube fall. */
SILHOUETTE_VECTORISED void placeCorners(const LatticeProjection& projection, const HomogeneousPixel& lowest, double side, CornerPlaces& places)
{
  static constexpr double along[3][Corners] = { { 0, 1, 0, 1, 0, 1, 0, 1 }, { 0, 0, 1, 1, 0, 0, 1, 1 }, { 0, 0, 0, 0, 1, 1, 1, 1 } };
  double steps[3][3];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int row = 0; row < 3; ++row)
    {
      steps[axis][row] = side * projection.step[axis][row];
    }
  }
  for (int n = 0; n < Corners; ++n)
  {
    const double i = along[0][n], j = along[1][n], k = along[2][n];
    const double W = lowest.W + ((steps[0][2] * i + steps[1][2] * j) + steps[2][2] * k);
    const double inverse = 1.0 / W;
    places.W[n] = W;
    places.u[n] = (lowest.U + ((steps[0][0] * i + steps[1][0] * j) + steps[2][0] * k)) * inverse;
    places.v[n] = (lowest.V + ((steps[0][1] * i + steps[1][1] * j) + steps[2][1] * k)) * inverse;
  }
}

/** The samples of a map around each of some places, of which it has all four. */
struct BlockSamples
{
  std::int32_t piece[Points];  ///< of the upper left one of the four
  std::int32_t within[Points]; ///< its place in that piece
  float s[Points], t[Points];
  float upper[2 * Points], lower[2 * Points];
};

/** Where the samples begin that a block asks for. */
struct SampleFrame
{
  float x, y;                        ///< samples from the first one to where the block's lowest point falls
  float samplesPerPixel;
  std::int32_t firstColumn, firstRow; ///< of the first one
  std::int32_t lastColumn, lastRow;   ///< of the upper left ones of four, from the first one on
  std::int32_t across;                ///< pieces of a row of the map's
};

/** Places that rounding carries beyond the samples take the last ones. */
SILHOUETTE_VECTORISED void findSamples(const BlockPlaces& places, int points, const SampleFrame& frame, BlockSamples& samples)
{
  for (int n = 0; n < points; ++n)
  {
    const float across = frame.x + places.u[n] * frame.samplesPerPixel, down = frame.y + places.v[n] * frame.samplesPerPixel;
    const auto anyColumn = std::int32_t(across), anyRow = std::int32_t(down);
    const std::int32_t notBefore = anyColumn > 0 ? anyColumn : 0, notAbove = anyRow > 0 ? anyRow : 0;
    const std::int32_t column = notBefore < frame.lastColumn ? notBefore : frame.lastColumn;
    const std::int32_t row = notAbove < frame.lastRow ? notAbove : frame.lastRow;
    samples.piece[n] = (frame.firstRow + row) * frame.across + (frame.firstColumn + column) / DistanceMap::PieceSize;
    samples.within[n] = (frame.firstColumn + column) % DistanceMap::PieceSize;
    samples.s[n] = across - float(column);
    samples.t[n] = down - float(row);
  }
}

SILHOUETTE_VECTORISED void interpolateBlock(const BlockSamples& samples, const BlockPlaces& places, int points, float reach, float* inside)
{
  for (int n = 0; n < points; ++n)
  {
    const float s = samples.s[n], t = samples.t[n];
    const float pixels = (samples.upper[2 * n] * (1 - s) + samples.upper[2 * n + 1] * s) * (1 - t) +
      (samples.lower[2 * n] * (1 - s) + samples.lower[2 * n + 1] * s) * t;
    const float octants = pixels * places.octantsPerPixel[n];
    const float least = octants < -reach ? -reach : octants;
    inside[n] = reach < least ? reach : least;
  }
}

/** Does a map have all samples around the places of a region? */
bool hasSamplesAround(const DistanceMap& map, const FieldViews::Region& region)
{
  return !map.empty() && region.firstU >= map.left && region.firstV >= map.top &&
    region.lastU < map.left + map.lastColumn && region.lastV < map.top + map.lastRow &&
    map.pieces.size() <= std::size_t(std::numeric_limits<std::int32_t>::max());
}

void insideOfSamples(const DistanceMap& map, const FieldViews::Region& region, const BlockProjection& block, const BlockPlaces& places, int points, float reach, float* inside)
{
  const int column = int((region.firstU - map.left) * map.samplesPerPixel), row = int((region.firstV - map.top) * map.samplesPerPixel);
  const double x = (block.u - map.left) * map.samplesPerPixel - column, y = (block.v - map.top) * map.samplesPerPixel - row;
  BlockSamples samples;
  findSamples(places, points,
    { float(x), float(y), float(map.samplesPerPixel), column, row, map.columns - 2 - column, map.rows - 2 - row, map.across }, samples);
  const float* const values = map.values.data();
  for (int n = 0; n < points; ++n)
  {
    const std::uint32_t* const piece = &map.pieces[std::size_t(samples.piece[n])];
    std::memcpy(&samples.upper[2 * n], values + piece[0] + samples.within[n], 2 * sizeof(float));
    std::memcpy(&samples.lower[2 * n], values + piece[map.across] + samples.within[n], 2 * sizeof(float));
  }
  interpolateBlock(samples, places, points, reach, inside);
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
  this->look(lattice, reach);
}

void FieldViews::look(const Lattice& lattice, double reach)
{
  this->TheLattice = lattice;
  this->Reach = reach;
  const int middle = lattice.cells() / 2;
  for (int view = 0; view < this->size(); ++view)
  {
    this->Shifts[view] = Vector2::Zero();
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
  std::vector<int> missing;
  std::copy_if(views.begin(), views.end(), std::back_inserter(missing), [this](int view) { return !this->isObserved(view); });
  shareWork(missing.size(), execution,
    [&]
    {
      return [&, mapper = DistanceMapper()](std::size_t n) mutable
      { this->Observed[missing[n]] = this->distances(missing[n], (*this->Views)[missing[n]].silhouette(), mapper); };
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
  CornerPlaces corners;
  placeCorners(projection, projection(lowest), size - 1, corners);
  const auto u = std::minmax_element(corners.u, corners.u + Corners), v = std::minmax_element(corners.v, corners.v + Corners);
  const double nearest = *std::min_element(corners.W, corners.W + Corners);
  return nearest > projection.minimumDepth
    ? Region{ *u.first - guard, *u.second + guard, *v.first - guard, *v.second + guard, 0.999 * nearest * this->DepthScale[view] }
    : Region{};
}

void FieldViews::insideBlock(
  int view, const LatticePoint& lowest, const Region& region, const BlockGroups& groups, const DistanceMap& map, float* inside) const
{
  static const BlockOffsets offsets;
  if (region.octantsPerPixel > 0.0 && hasSamplesAround(map, region))
  {
    const BlockProjection block(this->OnLattice[view], lowest, this->DepthScale[view]);
    BlockPlaces places;
    placeBlock(block, offsets, groups, places);
    insideOfSamples(map, region, block, places, int(groups.points()), float(this->Reach), inside);
    return;
  }
  for (std::size_t n = 0; n < groups.points(); ++n)
  {
    inside[n] = this->inside(map, this->place(view, lowest + fromMorton(groups.point(n))));
  }
}

void FieldViews::fetch(const DistanceMap& map, const Region& region) const
{
#if defined(__GNUC__)
  if (region.octantsPerPixel > 0.0 && hasSamplesAround(map, region))
  {
    const auto sampleOf = [&](double px, int first) { return int((px - first) * map.samplesPerPixel); };
    const int left = sampleOf(region.firstU, map.left), right = sampleOf(region.lastU, map.left) + 1;
    for (int row = sampleOf(region.firstV, map.top); row <= sampleOf(region.lastV, map.top) + 1; ++row)
    {
      __builtin_prefetch(map.sample(row, left));
      __builtin_prefetch(map.sample(row, right));
    }
  }
#else
  (void)map;
  (void)region;
#endif
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

DistanceMap FieldViews::distances(int view, const std::uint8_t* object, DistanceMapper& mapper) const
{
  const PreparedView& seen = (*this->Views)[view];
  const double spacing = this->Samples > 0.0 ? std::min(this->CentreScale[view] / this->Samples, double(seen.width)) : 1.0;
  return mapper.map(object, seen.width, seen.height, this->reachInPixels(view), int(spacing));
}

std::vector<DistanceMap> FieldViews::distances(const Mesh& mesh, Execution& execution) const
{
  std::vector<int> all(std::size_t(this->size()));
  std::iota(all.begin(), all.end(), 0);
  const OutlineRenderer renderer(mesh, this->cameras(all), execution);
  std::vector<DistanceMap> maps(all.size());
  shareWork(maps.size(), execution,
    [&]
    {
      return [&, mapper = DistanceMapper(), image = BinaryImage()](std::size_t i) mutable
      {
        drawRuns(renderer.render(i), image);
        maps[i] = this->distances(int(i), image.pixels.data(), mapper);
      };
    });
  return maps;
}

} // namespace silhouette
