// SPDX-License-Identifier: BSD-3-Clause
#include "UncoveredShare.h"

#include "MarchingCubesTable.h"
#include "UncoveredRegions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace silhouette
{
namespace
{

constexpr double StatedFor = 128.0;  ///< cells a side of the lattice whose octants the following and the bridged distance are
constexpr double LeastContact = 0.5; ///< octants: shorter ends and sides of a region are noise, such as a hole beside the contour

/** A count for each pixel of how many boxes and spans hold it, kept as differences along both axes. */
class CoverCount
{
public:
  CoverCount(int width, int height)
    : Width(width)
    , Height(height)
    , Stride(std::size_t(width) + 1)
    , Differences(Stride * (std::size_t(height) + 1), 0)
  {
  }

  /** All pixels whose squares the closed box touches; it may reach outside. */
  void add(double leastX, double greatestX, double leastY, double greatestY)
  {
    if (!(greatestX >= -0.5 && greatestY >= -0.5 && leastX < this->Width && leastY < this->Height))
    {
      return;
    }
    const std::size_t c0 = first(leastX), c1 = end(greatestX, this->Width);
    const std::size_t r0 = first(leastY), r1 = end(greatestY, this->Height);
    ++this->Differences[r0 * this->Stride + c0];
    --this->Differences[r0 * this->Stride + c1];
    --this->Differences[r1 * this->Stride + c0];
    ++this->Differences[r1 * this->Stride + c1];
  }

  /** Call `work(column, row)` for every pixel that nothing holds. */
  template <typename Work>
  void forUncovered(const Work& work) const
  {
    std::vector<std::int32_t> held(this->Stride, 0);
    for (int row = 0; row < this->Height; ++row)
    {
      std::int32_t along = 0;
      for (int column = 0; column < this->Width; ++column)
      {
        along += this->Differences[std::size_t(row) * this->Stride + column];
        held[column] += along;
        if (held[column] == 0)
        {
          work(column, row);
        }
      }
    }
  }

  int height() const { return this->Height; }

private:
  static std::size_t first(double least) { return std::size_t(std::max(0.0, std::floor(least + 0.5))); }
  static std::size_t end(double greatest, int size)
  {
    return std::size_t(std::min(double(size - 1), std::floor(greatest + 0.5))) + 1;
  }

  int Width;
  int Height;
  std::size_t Stride;
  std::vector<std::int32_t> Differences;
};

struct Point
{
  double x, y;
};

/** The projected corners of an octant; false where one is not in front of the camera. */
bool project(
  const LatticeProjection& projection, const LatticePoint& lowest, std::int32_t size, Point (&out)[8])
{
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint d = cornerOffset(c);
    const auto h = projection({ lowest.i + d.i * size, lowest.j + d.j * size, lowest.k + d.k * size });
    if (!(h.W > projection.minimumDepth))
    {
      return false;
    }
    out[c] = { h.U / h.W, h.V / h.W };
  }
  return true;
}

/**
 * The box around a last-generation octant's projection, widened by `reach` pixels. About its middle the projection
 * is as good as linear over an octant, which saves seven divisions of eight.
 */
void addLeaf(const LatticeProjection& projection, const LatticePoint& cell, double reach, CoverCount& count)
{
  const auto& step = projection.step;
  auto h = projection(cell);
  for (int axis = 0; axis < 3; ++axis)
  {
    h.U += 0.5 * step[axis][0];
    h.V += 0.5 * step[axis][1];
    h.W += 0.5 * step[axis][2];
  }
  if (!(h.W > projection.minimumDepth))
  {
    return;
  }
  const double over = 1.0 / h.W, x = h.U * over, y = h.V * over;
  double halfWidth = 0.0, halfHeight = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    halfWidth += std::abs(step[axis][0] - x * step[axis][2]);
    halfHeight += std::abs(step[axis][1] - y * step[axis][2]);
  }
  halfWidth = 0.5 * halfWidth * over + reach;
  halfHeight = 0.5 * halfHeight * over + reach;
  count.add(x - halfWidth, x + halfWidth, y - halfHeight, y + halfHeight);
}

/**
 * The polygon, row by row at the rows' middles: what it leaves out at its border the octants around it cover.
 */
void addPolygon(const Point (&p)[8], CoverCount& count)
{
  const auto y = std::minmax_element(p, p + 8, [](const Point& a, const Point& b) { return a.y < b.y; });
  const int from = int(std::clamp(std::ceil(y.first->y), 0.0, double(count.height())));
  const int to = int(std::clamp(std::floor(y.second->y), -1.0, double(count.height() - 1)));
  for (int row = from; row <= to; ++row)
  {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const auto& edge : edgeCorners)
    {
      const Point a = p[edge[0]], b = p[edge[1]];
      if ((a.y <= row) != (b.y <= row))
      {
        const double x = a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x);
        least = std::min(least, x);
        greatest = std::max(greatest, x);
      }
    }
    if (least <= greatest)
    {
      count.add(least, greatest, row, row);
    }
  }
}

/**
 * How many pixels an octant of the last generation is wide in the middle of the root cube; 0 where it is not
 * seen.
 */
double pixelsPerOctant(const LatticeProjection& projection, const Lattice& lattice)
{
  const std::int32_t middle = lattice.cells() / 2;
  Point p[8];
  if (!project(projection, { middle, middle, middle }, 1, p))
  {
    return 0.0;
  }
  double longest = 0.0;
  for (const int neighbour : { 1, 2, 4 })
  {
    longest = std::max(longest, std::hypot(p[neighbour].x - p[0].x, p[neighbour].y - p[0].y));
  }
  return longest;
}

} // namespace

double pixelsPerOctant(const PreparedViews& views, const Lattice& lattice)
{
  const LatticeViews latticeViews(views, lattice);
  double sum = 0.0;
  int seeing = 0;
  for (int view = 0; view < views.size(); ++view)
  {
    const double pixels = pixelsPerOctant(latticeViews.projection(view), lattice);
    sum += pixels;
    seeing += pixels > 0.0;
  }
  return seeing > 0 ? sum / seeing : 0.0;
}

namespace
{

/** One view's share. */
double uncoveredShare(const Octree& octree, const PreparedView& view, const LatticeProjection& projection,
  const UncoveredShareOptions& options)
{
  const std::int64_t objects = view.objectPixels(0, view.width, 0, view.height);
  const double octant = pixelsPerOctant(projection, octree.lattice);
  if (objects == 0 || octant == 0.0)
  {
    return 0.0;
  }
  CoverCount count(view.width, view.height);
  const int depth = octree.lattice.depth;
  for (int g = octree.treeGeneration; g <= depth; ++g)
  {
    const Generation& generation = octree.generations[g];
    for (std::size_t i = 0; i < generation.size(); ++i)
    {
      const OctantState state = generation.state[i];
      const LatticePoint at = fromMorton(generation.code[i]);
      const int shift = depth - g;
      Point p[8];
      if (g == depth && state != OctantState::Background)
      {
        addLeaf(projection, at, options.reach * octant, count);
      }
      else if (g < depth && state == OctantState::Inside &&
        project(projection, { at.i << shift, at.j << shift, at.k << shift }, 1 << shift, p))
      {
        addPolygon(p, count);
      }
    }
  }
  std::vector<RowColumn> uncovered;
  BinaryImage covered{ view.width, view.height, std::vector<std::uint8_t>(std::size_t(view.width) * std::size_t(view.height), 1) };
  count.forUncovered(
    [&](int column, int row)
    {
      covered.at(column, row) = 0;
      if (view.pixelVote(column, row) == Vote::Object)
      {
        uncovered.emplace_back(row, column);
      }
    });
  LostPartLimits limits;
  limits.area = std::max(limits.area, options.speckArea * octant * octant);
  const double proportion = octant * std::max(1.0, octree.lattice.cells() / StatedFor);
  limits.contact = std::max(limits.contact, LeastContact * proportion);
  limits.distance = options.bridged * proportion;
  return double(pixelsOfLostParts(uncovered, covered, limits)) / double(objects);
}

void check(const Octree& octree, const PreparedViews& views, const UncoveredShareOptions& options)
{
  for (const auto& [name, value] : { std::pair<const char*, double>("reach", options.reach),
         std::pair<const char*, double>("speck area", options.speckArea), std::pair<const char*, double>("bridged distance", options.bridged) })
  {
    if (!(value >= 0.0) || std::isinf(value))
    {
      throw InvalidInput(
        std::string(name) + " " + std::to_string(value) + " is not a number of octants, 0 or more");
    }
  }
  if (octree.viewCount != views.size())
  {
    throw InvalidInput("the octree was carved from " + std::to_string(octree.viewCount) +
      " views, not from " + std::to_string(views.size()));
  }
}

} // namespace

std::vector<double> uncoveredShares(const Octree& octree, const PreparedViews& views,
  const UncoveredShareOptions& options, Execution& execution)
{
  check(octree, views, options);
  std::vector<double> shares(std::size_t(views.size()), 0.0);
  if (octree.generations.empty())
  {
    return shares;
  }
  const LatticeViews latticeViews(views, octree.lattice);
  const int batch = std::max(1, execution.threads());
  for (int done = 0; done < views.size(); done += batch)
  {
    execution.forRanges(std::size_t(std::min(batch, views.size() - done)), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (int view = done + int(first); view < done + int(last); ++view)
        {
          shares[view] = uncoveredShare(octree, views[view], latticeViews.projection(view), options);
        }
      });
    execution.checkpoint(double(std::min(done + batch, views.size())) / views.size());
  }
  return shares;
}

} // namespace silhouette
