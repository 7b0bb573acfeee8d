// SPDX-License-Identifier: BSD-3-Clause
#include "OutlineRendering.h"

#include "Error.h"
#include "MeshCheck.h"
#include "SilhouetteRendering.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace silhouette
{
namespace
{

constexpr std::size_t MostKept = std::size_t(1) << 24; ///< pixels: memory for larger images is given back
constexpr double NearShare = 1e-6; ///< of the greatest w: nearer points are renderSilhouette()'s to cut off

/** One directed edge of a triangle, kept at its lower end. */
struct HalfEdge
{
  std::int32_t to;
  std::uint32_t triangle;
  bool forwards;
  bool used;
};

/** Where outlines enter and leave the covered part of each row. */
class Windings
{
public:
  Windings(int width, int height)
    : Width(width)
    , Height(height)
    , Stride(std::size_t(width) + 1)
    , Steps(kept())
  {
    this->Steps.resize(std::max(this->Steps.size(), this->Stride * std::size_t(height)), 0);
  }

  /** The row's middle is crossed from the lower row's end (in v) on, up to but not including the upper's. */
  void add(Vector2 p, Vector2 q, int sign)
  {
    if (q[1] < p[1])
    {
      std::swap(p, q);
      sign = -sign;
    }
    const double first = std::max(std::ceil(p[1]), 0.0), last = std::min(std::ceil(q[1]), double(this->Height)) - 1.0;
    if (!(first <= last))
    {
      return;
    }
    this->First = std::min(this->First, int(first));
    this->Last = std::max(this->Last, int(last));
    const double slope = (q[0] - p[0]) / (q[1] - p[1]);
    for (int row = int(first); row <= int(last); ++row)
    {
      const int column = int(std::clamp(std::ceil(p[0] + (row - p[1]) * slope), 0.0, double(this->Width)));
      this->Steps[std::size_t(row) * this->Stride + std::size_t(column)] += sign;
      this->FirstColumn = std::min(this->FirstColumn, column);
      this->LastColumn = std::max(this->LastColumn, column);
    }
  }

  /** Once, and last. */
  void fill(BinaryImage& image)
  {
    for (int row = this->First; row <= this->Last; ++row)
    {
      std::int16_t* steps = &this->Steps[std::size_t(row) * this->Stride];
      std::uint8_t* pixels = &image.pixels[std::size_t(row) * std::size_t(this->Width)];
      std::int16_t count = 0;
      const int end = std::min(this->LastColumn + 1, this->Width);
      for (int column = this->FirstColumn; column < end; ++column)
      {
        std::uint64_t ahead[2];
        while (column + 8 < end && (std::memcpy(ahead, steps + column, 16), (ahead[0] | ahead[1]) == 0))
        {
          std::memset(pixels + column, count != 0, 8); // no outline here
          column += 8;
        }
        count = std::int16_t(count + steps[column]);
        pixels[column] = count != 0;
      }
      std::fill(pixels + end, pixels + this->Width, std::uint8_t(count != 0)); // of an outline that is not closed
      std::fill(steps + this->FirstColumn, steps + this->LastColumn + 1, std::int16_t(0));
    }
    if (this->Steps.size() > MostKept)
    {
      std::vector<std::int16_t>().swap(this->Steps);
    }
  }

private:
  /** The memory, which serves the thread's next image. */
  static std::vector<std::int16_t>& kept()
  {
    thread_local std::vector<std::int16_t> steps;
    return steps;
  }

  int Width;
  int Height;
  std::size_t Stride;
  int First = 1 << 30;
  int Last = -1;
  int FirstColumn = 1 << 30;
  int LastColumn = -1;
  std::vector<std::int16_t>& Steps; ///< all 0 before and after
};

} // namespace

OutlineRenderer::OutlineRenderer(const Mesh& mesh)
  : TheMesh(mesh)
{
  checkMesh(mesh);
  const auto none = std::uint32_t(mesh.triangles.size());
  std::vector<std::uint32_t> first(mesh.points.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
  {
    for (int c = 0; c < 3; ++c)
    {
      ++first[std::size_t(std::min(t[c], t[(c + 1) % 3])) + 1];
    }
  }
  for (std::size_t p = 1; p < first.size(); ++p)
  {
    first[p] += first[p - 1];
  }
  std::vector<HalfEdge> halves(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  this->Planes.reserve(mesh.triangles.size());
  this->Edges.reserve(halves.size() / 2);
  for (std::uint32_t n = 0; n < none; ++n)
  {
    const Triangle& t = mesh.triangles[n];
    for (int c = 0; c < 3; ++c)
    {
      const std::int32_t a = t[c], b = t[(c + 1) % 3];
      halves[next[std::size_t(std::min(a, b))]++] = { std::max(a, b), n, a < b, false };
    }
    const auto& a = mesh.points[t[0]];
    const Eigen::Vector3d normal = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
    this->Planes.push_back({ normal[0], normal[1], normal[2], normal.dot(a) });
  }
  for (std::size_t p = 0; p + 1 < first.size(); ++p)
  {
    for (std::uint32_t n = first[p]; n < first[p + 1]; ++n)
    {
      HalfEdge& half = halves[n];
      if (half.used)
      {
        continue;
      }
      Edge edge{ std::int32_t(p), half.to, half.forwards ? half.triangle : none, half.forwards ? none : half.triangle };
      for (std::uint32_t m = n + 1; m < first[p + 1]; ++m)
      {
        HalfEdge& other = halves[m];
        if (!other.used && other.to == half.to && other.forwards != half.forwards)
        {
          (other.forwards ? edge.forwards : edge.backwards) = other.triangle;
          other.used = true;
          break;
        }
      }
      this->Edges.push_back(edge);
    }
  }
}

BinaryImage OutlineRenderer::render(const Projection& projection, int width, int height) const
{
  if (width < 1 || height < 1)
  {
    throw InvalidInput("an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
  }
  double least = 1.0, greatest = -1.0;
  std::vector<Vector2> points(this->TheMesh.points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const Vector3 h = projection.leftCols<3>() * this->TheMesh.points[n] + projection.col(3);
    if (!h.allFinite())
    {
      throw InvalidInput("point " + std::to_string(n) + " does not project to finite numbers");
    }
    least = n == 0 ? h[2] : std::min(least, h[2]);
    greatest = n == 0 ? h[2] : std::max(greatest, h[2]);
    points[n] = { h[0] / h[2], h[1] / h[2] };
  }
  if (!(least > NearShare * greatest))
  {
    return renderSilhouette(this->TheMesh, projection, width, height);
  }
  // A triangle faces the camera as the determinant of its homogeneous corners says: linear in its plane, with factors
  // that are defined for a camera at infinity too.
  const Eigen::Matrix3d m = projection.leftCols<3>();
  const Vector3 r0 = m.row(0), r1 = m.row(1), r2 = m.row(2);
  const Vector3 q = r1.cross(r2) * projection(0, 3) + r2.cross(r0) * projection(1, 3) + r0.cross(r1) * projection(2, 3);
  const double determinant = r0.dot(r1.cross(r2));
  std::vector<std::uint8_t> faces(this->Planes.size() + 1, 0);
  for (std::size_t t = 0; t < this->Planes.size(); ++t)
  {
    const auto& plane = this->Planes[t];
    faces[t] = q[0] * plane[0] + q[1] * plane[1] + q[2] * plane[2] + determinant * plane[3] > 0.0;
  }
  BinaryImage image{ width, height, std::vector<std::uint8_t>(std::size_t(width) * height, 0) };
  Windings windings(width, height);
  for (const Edge& edge : this->Edges)
  {
    const int sign = int(faces[edge.forwards]) - int(faces[edge.backwards]);
    if (sign != 0)
    {
      windings.add(points[edge.from], points[edge.to], sign);
    }
  }
  windings.fill(image);
  return image;
}

} // namespace silhouette
