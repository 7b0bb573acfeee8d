// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRendering.h"

#include "Error.h"
#include "MeshCheck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace silhouette
{

namespace
{

/** Points nearer to the camera's plane than this share of the greatest w are cut off. */
constexpr double NearShare = 1e-6;

/** A triangle cut by the near plane has at most four corners. */
struct Polygon
{
  std::array<Vector2, 4> corner;
  int size = 0;

  void add(const Vector3& homogeneous)
  {
    this->corner[this->size++] = { homogeneous[0] / homogeneous[2], homogeneous[1] / homogeneous[2] };
  }
};

Vector3 projectPoint(const Projection& P, const Vector3& p)
{
  Vector3 h;
  for (int r = 0; r < 3; ++r)
  {
    h[r] = P(r, 0) * p[0] + P(r, 1) * p[1] + P(r, 2) * p[2] + P(r, 3);
  }
  return h;
}

std::vector<Vector3> projectPoints(const Mesh& mesh, const Projection& projection)
{
  std::vector<Vector3> result;
  result.reserve(mesh.points.size());
  for (const Vector3& p : mesh.points)
  {
    result.push_back(projectPoint(projection, p));
    if (!result.back().allFinite())
    {
      throw InvalidInput(
        "point " + std::to_string(result.size() - 1) + " does not project to finite numbers");
    }
  }
  return result;
}

/**
 * The part of the triangle in front of w = nearPlane. Ends of cut edges are ordered, so that neighbours
 * agree.
 */
Polygon cutByNearPlane(const std::vector<Vector3>& points, const Triangle& triangle, double nearPlane)
{
  Polygon result;
  for (int c = 0; c < 3; ++c)
  {
    const std::int32_t here = triangle[c];
    const std::int32_t next = triangle[(c + 1) % 3];
    const bool hereSeen = points[here][2] > nearPlane;
    if (hereSeen)
    {
      result.add(points[here]);
    }
    if (hereSeen != (points[next][2] > nearPlane))
    {
      const Vector3& a = points[std::min(here, next)];
      const Vector3& b = points[std::max(here, next)];
      const double t = (nearPlane - a[2]) / (b[2] - a[2]);
      Vector3 cut = a + t * (b - a);
      cut[2] = nearPlane;
      result.add(cut);
    }
  }
  return result;
}

/** Where segment p q meets the row; the same bits for q p. The row lies between the ends. */
double crossing(Vector2 p, Vector2 q, double row)
{
  if (q[1] < p[1])
  {
    std::swap(p, q);
  }
  if (row == p[1])
  {
    return p[0];
  }
  if (row == q[1])
  {
    return q[0];
  }
  // Multiplied before divided: exact where the corners and the crossing are whole numbers.
  const double column = p[0] + (row - p[1]) * (q[0] - p[0]) / (q[1] - p[1]);
  return std::clamp(column, std::min(p[0], q[0]), std::max(p[0], q[0]));
}

/** The least and greatest column of the polygon on one row. */
std::array<double, 2> rowSpan(const Polygon& polygon, double row)
{
  std::array<double, 2> span{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  const auto include = [&span](double column)
  {
    span[0] = std::min(span[0], column);
    span[1] = std::max(span[1], column);
  };
  for (int c = 0; c < polygon.size; ++c)
  {
    const Vector2& p = polygon.corner[c];
    const Vector2& q = polygon.corner[c + 1 == polygon.size ? 0 : c + 1];
    if (p[1] == row && q[1] == row)
    {
      include(p[0]);
      include(q[0]);
    }
    else if (std::min(p[1], q[1]) <= row && row <= std::max(p[1], q[1]))
    {
      include(crossing(p, q, row));
    }
  }
  return span;
}

void fill(const Polygon& polygon, BinaryImage& image)
{
  double top = std::numeric_limits<double>::infinity();
  double bottom = -top;
  for (int c = 0; c < polygon.size; ++c)
  {
    top = std::min(top, polygon.corner[c][1]);
    bottom = std::max(bottom, polygon.corner[c][1]);
  }
  // Compared as doubles first: a coordinate near the camera's plane may be too large for an int.
  const double firstRow = std::max(std::ceil(top), 0.0);
  const double lastRow = std::min(std::floor(bottom), image.height - 1.0);
  for (double row = firstRow; row <= lastRow; row += 1.0)
  {
    const std::array<double, 2> span = rowSpan(polygon, row);
    const double first = std::max(std::ceil(span[0]), 0.0);
    const double last = std::min(std::floor(span[1]), image.width - 1.0);
    if (first <= last)
    {
      std::memset(&image.at(int(first), int(row)), 1, std::size_t(last - first) + 1);
    }
  }
}

} // namespace

BinaryImage renderSilhouette(const Mesh& mesh, const Projection& projection, int width, int height)
{
  if (width < 1 || height < 1)
  {
    throw InvalidInput("an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
  }
  checkMesh(mesh);
  BinaryImage image;
  image.width = width;
  image.height = height;
  image.pixels.assign(std::size_t(width) * height, 0);

  const std::vector<Vector3> points = projectPoints(mesh, projection);
  double greatest = 0.0;
  for (const Vector3& p : points)
  {
    greatest = std::max(greatest, p[2]);
  }
  const double nearPlane = NearShare * greatest;
  if (!(nearPlane > 0.0))
  {
    return image; // everything is behind the camera
  }
  for (const Triangle& triangle : mesh.triangles)
  {
    fill(cutByNearPlane(points, triangle, nearPlane), image);
  }
  return image;
}

} // namespace silhouette
