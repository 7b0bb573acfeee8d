// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeCrossing.h"

#include <array>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace silhouette
{
namespace
{

/** Where along the edge one view says background: ascending pairs [from, to) of t. */
using Intervals = std::vector<std::pair<double, double>>;

struct ProjectedEdge
{
  HomogeneousPixel a, b;
  double uA, vA, uB, vB;

  double toWorld(double s) const { return s * this->a.W / (this->b.W + s * (this->a.W - this->b.W)); }
};

/** Within the range of int; std::floor is a call where the processor need not have it. */
int floorOf(double value)
{
  const int towardsZero = int(value);
  return towardsZero - (value < towardsZero);
}

/** Steps over pixel boundaries along one image axis. */
struct Stepper
{
  int pixel;
  int direction;
  double start, delta;

  Stepper(double from, double to)
    : pixel(floorOf(from + 0.5))
    , direction(to > from ? 1 : -1)
    , start(from)
    , delta(to - from)
  {
  }
  /** Image parameter of the next boundary; beyond 1 there is none. */
  double next() const
  {
    if (this->delta == 0.0)
    {
      return 2.0;
    }
    return (this->pixel + 0.5 * this->direction - this->start) / this->delta;
  }
};

void append(Intervals& intervals, double from, double to)
{
  if (!intervals.empty() && intervals.back().second >= from)
  {
    intervals.back().second = std::max(intervals.back().second, to);
  }
  else
  {
    intervals.emplace_back(from, to);
  }
}

/** Walk the pixels from a to b, up to world fraction `limit`; stop at the first background if `first`. */
void walk(const PreparedView& view, const ProjectedEdge& e, double limit, bool first, Intervals& intervals)
{
  Stepper x(e.uA, e.uB), y(e.vA, e.vB);
  double t = 0.0;
  while (t < limit)
  {
    const double nextX = x.next(), nextY = y.next();
    const double s = std::min(nextX, nextY);
    const double end = s >= 1.0 ? 1.0 : std::max(t, e.toWorld(std::max(s, 0.0)));
    if (view.pixelVote(x.pixel, y.pixel) == Vote::Background)
    {
      append(intervals, t, end);
      if (first)
      {
        return;
      }
    }
    if (s >= 1.0)
    {
      return;
    }
    t = end;
    Stepper& step = nextX <= nextY ? x : y;
    step.pixel += step.direction;
  }
}

/** For an edge that crosses the camera's plane or runs far outside the image: sample the votes. */
void sample(const PreparedView& view, const LatticeProjection& p, const ProjectedEdge& e, Intervals& intervals)
{
  constexpr int Samples = 64;
  for (int n = 0; n < Samples; ++n)
  {
    const double t = (n + 0.5) / Samples;
    const double W = e.a.W + t * (e.b.W - e.a.W);
    if (W > p.minimumDepth)
    {
      const double u = (e.a.U + t * (e.b.U - e.a.U)) / W, v = (e.a.V + t * (e.b.V - e.a.V)) / W;
      if (view.pixelVote(PreparedView::nearestPixel(u, view.width), PreparedView::nearestPixel(v, view.height)) ==
        Vote::Background)
      {
        append(intervals, double(n) / Samples, double(n + 1) / Samples);
      }
    }
  }
}

/** Does the box of the two ends' pixels hold background? */
bool holdsBackground(const PreparedView& view, const ProjectedEdge& e)
{
  const int columnA = PreparedView::nearestPixel(e.uA, view.width), columnB = PreparedView::nearestPixel(e.uB, view.width);
  const int rowA = PreparedView::nearestPixel(e.vA, view.height), rowB = PreparedView::nearestPixel(e.vB, view.height);
  const int c0 = std::min(columnA, columnB), c1 = std::max(columnA, columnB);
  const int r0 = std::min(rowA, rowB), r1 = std::max(rowA, rowB);
  if (view.inImage(c0, c1, r0, r1) && c1 - c0 < PixelTiles::Size && r1 - r0 < PixelTiles::Size)
  {
    return (~view.window(c0, r0) & PixelTiles::windowPart(c1 - c0 + 1, r1 - r0 + 1)) != 0;
  }
  return view.content(c0, c1, r0, r1).background;
}

void backgroundIntervals(const PreparedView& view, const LatticeProjection& p, const LatticePoint& inside,
  const LatticePoint& outside, double limit, bool first, Intervals& intervals)
{
  ProjectedEdge e;
  e.a = p(inside);
  e.b = p(outside);
  if (!(e.a.W > p.minimumDepth) || !(e.b.W > p.minimumDepth))
  {
    sample(view, p, e, intervals);
    return;
  }
  e.uA = e.a.U / e.a.W;
  e.vA = e.a.V / e.a.W;
  e.uB = e.b.U / e.b.W;
  e.vB = e.b.V / e.b.W;
  if (!holdsBackground(view, e))
  {
    return;
  }
  constexpr double Far = 1 << 20;
  if (std::abs(e.uA) > Far || std::abs(e.uB) > Far || std::abs(e.vA) > Far || std::abs(e.vB) > Far)
  {
    sample(view, p, e, intervals);
    return;
  }
  walk(view, e, limit, first, intervals);
}

/** The first t at which more than `allowed` of the intervals overlap. */
double firstExcess(const Intervals& intervals, int allowed)
{
  std::vector<std::pair<double, int>> events;
  for (const auto& interval : intervals)
  {
    events.emplace_back(interval.first, 1);
    events.emplace_back(interval.second, -1);
  }
  // Ends before starts at the same t: the intervals are half open.
  std::sort(events.begin(), events.end());
  int count = 0;
  for (std::size_t i = 0; i < events.size(); ++i)
  {
    count += events[i].second;
    const bool last = i + 1 == events.size() || events[i + 1].first > events[i].first;
    if (last && count > allowed)
    {
      return events[i].first;
    }
  }
  return 1.0;
}

} // namespace

double exactCrossing(
  const LatticeViews& views, const LatticePoint& inside, const LatticePoint& outside, int backgroundVotes)
{
  std::vector<std::uint16_t> all(std::size_t(views.size()));
  std::iota(all.begin(), all.end(), std::uint16_t(0));
  return exactCrossing(views, { all.data(), all.size(), 0, false }, inside, outside, backgroundVotes);
}

double exactCrossing(const LatticeViews& views, const ViewsToAsk& ask, const LatticePoint& inside,
  const LatticePoint& outside, int backgroundVotes)
{
  thread_local std::array<Intervals, 2> kept; // so that their memory is
  Intervals& all = kept[0];
  Intervals& own = kept[1];
  const int allowed = backgroundVotes - ask.backgroundVotes;
  all.clear();
  double crossing = 1.0;
  ask.forEach(
    [&](int view)
    {
      own.clear();
      backgroundIntervals(views.view(view), views.projection(view), inside, outside, crossing, allowed == 0, own);
      if (allowed == 0)
      {
        crossing = own.empty() ? crossing : std::min(crossing, own.front().first);
      }
      else
      {
        all.insert(all.end(), own.begin(), own.end());
      }
    });
  return allowed == 0 ? crossing : firstExcess(all, allowed);
}

} // namespace silhouette
