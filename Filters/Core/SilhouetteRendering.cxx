// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRendering.h"

#include "Error.h"
#include "LargePages.h"
#include "MeshCheck.h"
#include "Vectorised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
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

/** The least and the greatest w of some points. Throws InvalidInput for one that does not project to finite numbers. */
std::array<double, 2> depthsOf(const std::vector<Vector3>& points, const Projection& projection)
{
  std::array<double, 2> depths{ std::numeric_limits<double>::infinity(), 0.0 };
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const Vector3 p = projectPoint(projection, points[n]);
    if (!p.allFinite())
    {
      throw InvalidInput("point " + std::to_string(n) + " does not project to finite numbers");
    }
    depths = { std::min(depths[0], p[2]), std::max(depths[1], p[2]) };
  }
  return depths;
}

/** Where a point in front of the camera falls. */
inline Vector2 pixelOf(const Projection& projection, const Vector3& point)
{
  const Vector3 p = projectPoint(projection, point);
  return { p[0] / p[2], p[1] / p[2] };
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

/** The box of the pixels of an image whose centres may lie in what has the given corners. */
inline ImageBox boxOf(const Vector2* corners, int count, int width, int height)
{
  ImageBox box{ width, height, -1, -1 };
  for (int c = 0; c < count; ++c)
  {
    // Compared as doubles first: a coordinate near the camera's plane may be too large for an int.
    const Vector2& p = corners[c];
    box.include({ int(std::clamp(std::ceil(p[0]), 0.0, double(width))), int(std::clamp(std::ceil(p[1]), 0.0, double(height))),
      int(std::clamp(std::floor(p[0]), -1.0, width - 1.0)), int(std::clamp(std::floor(p[1]), -1.0, height - 1.0)) });
  }
  return box;
}

/** Is a row of an image object from one column to another? */
bool isFilled(const BinaryImage& image, int row, int first, int last)
{
  const std::uint8_t* pixels = &image.pixels[std::size_t(row) * std::size_t(image.width)];
  return std::all_of(pixels + first, pixels + last + 1, [](std::uint8_t pixel) { return pixel != 0; });
}

/** Is all of a box object, as of most triangles of a fine mesh? Of a large one that is not asked: false. */
bool isFilled(const BinaryImage& image, const ImageBox& box)
{
  constexpr std::int64_t Small = 256; // pixels
  if (box.left <= box.right && box.top <= box.bottom && std::int64_t(box.right - box.left + 1) * (box.bottom - box.top + 1) > Small)
  {
    return false;
  }
  int row = box.top;
  while (row <= box.bottom && (box.left > box.right || isFilled(image, row, box.left, box.right)))
  {
    ++row;
  }
  return row > box.bottom;
}

/** `box`: of the polygon. */
SILHOUETTE_VECTORISED void fill(const Polygon& polygon, const ImageBox& box, BinaryImage& image)
{
  constexpr int Narrow = 16; // columns that are looked at sooner than the polygon's edges
  for (int row = box.top; row <= box.bottom; ++row)
  {
    if (box.right - box.left < Narrow && isFilled(image, row, box.left, box.right))
    {
      continue;
    }
    const std::array<double, 2> span = rowSpan(polygon, row);
    const double first = std::max(std::ceil(span[0]), 0.0);
    const double last = std::min(std::floor(span[1]), image.width - 1.0);
    if (first <= last)
    {
      std::memset(&image.at(int(first), row), 1, std::size_t(last - first) + 1);
    }
  }
}

/** The box of each of some points in front of the camera. */
SILHOUETTE_VECTORISED void boxPoints(const std::vector<Vector3>& points, const Projection& projection, int width, int height, ImageBox* boxes)
{
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const Vector2 pixel = pixelOf(projection, points[n]);
    boxes[n] = boxOf(&pixel, 1, width, height);
  }
}

} // namespace

const BinaryImage& SilhouetteRenderer::render(const Mesh& mesh, const Projection& projection, int width, int height)
{
  if (width < 1 || height < 1)
  {
    throw InvalidInput("an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
  }
  checkMesh(mesh);
  this->Image.width = width;
  this->Image.height = height;
  this->Image.pixels.assign(std::size_t(width) * height, 0);

  const auto [least, greatest] = depthsOf(mesh.points, projection);
  const double nearPlane = NearShare * greatest;
  if (!(nearPlane > 0.0))
  {
    return this->Image; // everything is behind the camera
  }
  least > nearPlane ? this->fillSeen(mesh, projection) : this->fillCut(mesh, projection, nearPlane);
  return this->Image;
}

void SilhouetteRenderer::fillSeen(const Mesh& mesh, const Projection& projection)
{
  if (this->Boxes.size() < mesh.points.size())
  {
    this->Boxes = largeVector<ImageBox>(mesh.points.size());
  }
  boxPoints(mesh.points, projection, this->Image.width, this->Image.height, this->Boxes.data());
  const auto pixel = [&](std::int32_t point) { return pixelOf(projection, mesh.points[point]); };
  for (const Triangle& t : mesh.triangles)
  {
    ImageBox box = this->Boxes[t[0]];
    box.include(this->Boxes[t[1]]);
    box.include(this->Boxes[t[2]]);
    if (!isFilled(this->Image, box))
    {
      fill({ { pixel(t[0]), pixel(t[1]), pixel(t[2]) }, 3 }, box, this->Image);
    }
  }
}

void SilhouetteRenderer::fillCut(const Mesh& mesh, const Projection& projection, double nearPlane)
{
  std::vector<Vector3> points; // homogeneous
  std::transform(mesh.points.begin(), mesh.points.end(), std::back_inserter(points), [&](const Vector3& p) { return projectPoint(projection, p); });
  for (const Triangle& t : mesh.triangles)
  {
    const Polygon polygon = cutByNearPlane(points, t, nearPlane);
    const ImageBox box = boxOf(polygon.corner.data(), polygon.size, this->Image.width, this->Image.height);
    if (!isFilled(this->Image, box))
    {
      fill(polygon, box, this->Image);
    }
  }
}

} // namespace silhouette
