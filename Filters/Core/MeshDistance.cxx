// SPDX-License-Identifier: BSD-3-Clause
#include "MeshDistance.h"

#include "BoxTree.h"
#include "MeshCheck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace silhouette
{

namespace
{

using Point = Eigen::Vector3d;

constexpr std::size_t Block = 64;       ///< triangles whose samples are summed in one place
constexpr std::size_t Batches = 16;     ///< times that a run asks whether it is cancelled
constexpr double MostSubdivisions = 1e4;

double squaredDistanceToSegment(const Point& x, const Point& p, const Point& q)
{
  const Point d = q - p;
  const double length = d.squaredNorm();
  const double t = length > 0.0 ? std::clamp(d.dot(x - p) / length, 0.0, 1.0) : 0.0;
  return (p + t * d - x).squaredNorm();
}

double squaredDistanceToTriangle(const Point& x, const Point& a, const Point& b, const Point& c)
{
  const Point normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  // Above the triangle the plane is nearest, elsewhere an edge is.
  if (square > 0.0 && normal.cross(b - a).dot(x - a) >= 0.0 && normal.cross(c - b).dot(x - b) >= 0.0 &&
    normal.cross(a - c).dot(x - c) >= 0.0)
  {
    const double height = normal.dot(x - a);
    return height * height / square;
  }
  return std::min({ squaredDistanceToSegment(x, a, b), squaredDistanceToSegment(x, b, c),
    squaredDistanceToSegment(x, c, a) });
}

const Mesh& checkedSurface(const Mesh& surface)
{
  checkMesh(surface);
  if (surface.triangles.empty())
  {
    throw InvalidInput("a mesh without triangles has no distance");
  }
  return surface;
}

/** Sums over samples: of areas, and of areas times distances; and the same with every sample's weight 1. */
struct Sums
{
  std::array<double, 2> weight{};
  std::array<double, 2> distance{};
  std::array<double, 2> square{};
  double greatestSquare = 0.0;

  void add(double area, double squaredDistance)
  {
    const std::array<double, 2> weights{ area, 1.0 };
    for (int w = 0; w < 2; ++w)
    {
      this->weight[w] += weights[w];
      this->distance[w] += weights[w] * std::sqrt(squaredDistance);
      this->square[w] += weights[w] * squaredDistance;
    }
    this->greatestSquare = std::max(this->greatestSquare, squaredDistance);
  }
  void add(const Sums& o)
  {
    for (int w = 0; w < 2; ++w)
    {
      this->weight[w] += o.weight[w];
      this->distance[w] += o.distance[w];
      this->square[w] += o.square[w];
    }
    this->greatestSquare = std::max(this->greatestSquare, o.greatestSquare);
  }
};

double subdivisions(const Point& a, const Point& b, const Point& c, double spacing)
{
  const double longest =
    std::sqrt(std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() }));
  return std::max(1.0, std::ceil(longest / spacing));
}

void sampleTriangle(
  const DistanceTarget& target, const Point& a, const Point& b, const Point& c, double spacing, Sums& sums)
{
  const int n = int(subdivisions(a, b, c, spacing));
  const double area = (b - a).cross(c - a).norm() / 2.0 / (double(n) * n);
  const auto sample = [&](double u, double v)
  { sums.add(area, target.squaredDistance(a + (u / (3.0 * n)) * (b - a) + (v / (3.0 * n)) * (c - a))); };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; i + j < n; ++j)
    {
      sample(3 * i + 1, 3 * j + 1); // the small triangle that stands as the whole one does
      if (i + j + 1 < n)
      {
        sample(3 * i + 2, 3 * j + 2); // the one that stands on its head beside it
      }
    }
  }
}

void checkSampling(const Mesh& from, double spacing)
{
  checkedSurface(from);
  if (!(spacing > 0.0))
  {
    throw InvalidInput("the spacing of samples is " + std::to_string(spacing) + ", not positive");
  }
  for (std::size_t t = 0; t < from.triangles.size(); ++t)
  {
    const Triangle& p = from.triangles[t];
    if (!(subdivisions(from.points[p[0]], from.points[p[1]], from.points[p[2]], spacing) <= MostSubdivisions))
    {
      throw InvalidInput(
        "a spacing of " + std::to_string(spacing) + " is too fine for triangle " + std::to_string(t));
    }
  }
}

/** The greatest squared distance of the corners that triangles use. */
double greatestOfCorners(const Mesh& from, const DistanceTarget& target, Execution& execution)
{
  std::vector<double> squares(from.points.size(), 0.0);
  std::vector<std::uint8_t> used(from.points.size(), 0);
  for (const Triangle& t : from.triangles)
  {
    used[t[0]] = used[t[1]] = used[t[2]] = 1;
  }
  execution.forRanges(from.points.size(), 256,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        squares[p] = used[p] != 0 ? target.squaredDistance(from.points[p]) : 0.0;
      }
    });
  return *std::max_element(squares.begin(), squares.end());
}

Sums sampleAll(const Mesh& from, const DistanceTarget& target, double spacing, Execution& execution)
{
  // Summed block by block, so that no sum's order depends on how the loop is cut.
  std::vector<Sums> blocks((from.triangles.size() + Block - 1) / Block);
  for (std::size_t batch = 0; batch < Batches; ++batch)
  {
    execution.checkpoint(double(batch) / Batches);
    const std::size_t firstBlock = blocks.size() * batch / Batches;
    execution.forRanges(blocks.size() * (batch + 1) / Batches - firstBlock, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t b = firstBlock + first; b < firstBlock + last; ++b)
        {
          for (std::size_t t = b * Block; t < std::min(from.triangles.size(), (b + 1) * Block); ++t)
          {
            const Triangle& p = from.triangles[t];
            sampleTriangle(
              target, from.points[p[0]], from.points[p[1]], from.points[p[2]], spacing, blocks[b]);
          }
        }
      });
  }
  Sums sums;
  for (const Sums& block : blocks)
  {
    sums.add(block);
  }
  return sums;
}

} // namespace

DistanceTarget::DistanceTarget(const Mesh& surface, Execution& execution)
  : Surface(checkedSurface(surface))
  , Tree(triangleTree(surface.points, surface.triangles, execution))
{
}

double DistanceTarget::squaredDistance(const Eigen::Vector3d& point) const
{
  return this->Tree.nearest(point,
    [&](std::int32_t i)
    {
      const Triangle& t = this->Surface.triangles[i];
      return squaredDistanceToTriangle(
        point, this->Surface.points[t[0]], this->Surface.points[t[1]], this->Surface.points[t[2]]);
    });
}

MeshDistance meshDistance(const Mesh& from, const DistanceTarget& to, double spacing, Execution& execution)
{
  checkSampling(from, spacing);
  execution.checkpoint(0.0);
  const double cornersSquare = greatestOfCorners(from, to, execution);
  Phase sampling(execution, 0.2, 1.0);
  const Sums sums = sampleAll(from, to, spacing, sampling);
  execution.progress(1.0);
  const int w = sums.weight[0] > 0.0 ? 0 : 1;
  MeshDistance result;
  result.mean = sums.distance[w] / sums.weight[w];
  result.rms = std::sqrt(sums.square[w] / sums.weight[w]);
  result.maximum = std::sqrt(std::max(sums.greatestSquare, cornersSquare));
  return result;
}

MeshDistance meshDistance(const Mesh& from, const Mesh& to, double spacing, Execution& execution)
{
  checkSampling(from, spacing);
  execution.checkpoint(0.0);
  const DistanceTarget target(to, execution);
  Phase measuring(execution, 0.1, 1.0);
  return meshDistance(from, target, spacing, measuring);
}

MeshComparison compareMeshes(const Mesh& mesh, const Mesh& truth, double spacing, Execution& execution)
{
  Phase first(execution, 0.0, 0.5);
  Phase second(execution, 0.5, 1.0);
  MeshComparison result;
  result.meshToTruth = meshDistance(mesh, truth, spacing, first);
  result.truthToMesh = meshDistance(truth, mesh, spacing, second);
  result.mean = (result.meshToTruth.mean + result.truthToMesh.mean) / 2.0;
  const auto square = [](double x) { return x * x; };
  result.rms = std::sqrt((square(result.meshToTruth.rms) + square(result.truthToMesh.rms)) / 2.0);
  result.hausdorff = std::max(result.meshToTruth.maximum, result.truthToMesh.maximum);
  return result;
}

} // namespace silhouette
