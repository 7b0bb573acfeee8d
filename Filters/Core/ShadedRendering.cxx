// SPDX-License-Identifier: BSD-3-Clause
#include "ShadedRendering.h"

#include "Error.h"
#include "MeshCheck.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace silhouette
{
namespace
{

/** One photograph under work. */
class Photograph
{
public:
  Photograph(const Mesh& mesh, const ShadingNormals& normals, const Projection& projection,
             const BinaryImage& mask)
      : TheMesh(mesh), TheNormals(normals), Mask(mask), InverseDepth(mask.pixels.size(), 0.0),
        Colours(3 * mask.pixels.size())
  {
    const Eigen::Matrix3d left = projection.leftCols<3>();
    this->Eye = -(left.inverse() * projection.col(3));
    const Vector3 forward = left.row(2).normalized();
    const Vector3 down = (left.row(1).transpose() - left.row(1).dot(forward) * forward).normalized();
    this->Light = (-0.55 * down.cross(forward) - 0.65 * down - forward).normalized();
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    {
      std::copy(photographBackground.begin(), photographBackground.end(), &this->Colours[3 * i]);
    }
    this->Projected.reserve(mesh.points.size());
    for (const Vector3& p : mesh.points)
    {
      const Vector3 h = projection * p.homogeneous();
      this->Projected.emplace_back(h[0] / h[2], h[1] / h[2], 1.0 / h[2]);
    }
  }

  std::vector<std::uint8_t> operator()()
  {
    for (std::size_t t = 0; t < this->TheMesh.triangles.size(); ++t)
    {
      this->drawTriangle(t);
    }
    this->fillGaps();
    return std::move(this->Colours);
  }

private:
  /** Compared as a double first: a coordinate may be too large for an int. */
  static int pixelAtMost(double coordinate, int greatest)
  {
    return coordinate < 0.0 ? 0 : int(std::min(coordinate, double(greatest)));
  }

  void drawTriangle(std::size_t t)
  {
    const Triangle& triangle = this->TheMesh.triangles[t];
    const std::array<Vector3, 3> p = {this->Projected[triangle[0]], this->Projected[triangle[1]],
                                      this->Projected[triangle[2]]};
    const Vector3 lowest = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
    const Vector3 highest = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    const double area = (p[1] - p[0]).head<2>().dot(Vector2(p[2].y() - p[0].y(), p[0].x() - p[2].x()));
    if (area == 0.0)
    {
      return;
    }
    const std::array<Vector3, 3> normals = this->cornerNormals(t);
    const int left = pixelAtMost(lowest.x(), this->Mask.width);
    const int right = pixelAtMost(highest.x(), this->Mask.width - 1);
    const int bottom = pixelAtMost(highest.y(), this->Mask.height - 1);
    for (int row = pixelAtMost(lowest.y(), this->Mask.height); row <= bottom; ++row)
    {
      for (int column = left; column <= right; ++column)
      {
        const double b1 =
            ((column - p[0].x()) * (p[2].y() - p[0].y()) - (row - p[0].y()) * (p[2].x() - p[0].x())) / area;
        const double b2 =
            ((row - p[0].y()) * (p[1].x() - p[0].x()) - (column - p[0].x()) * (p[1].y() - p[0].y())) / area;
        this->drawPixel({column, row}, {1.0 - b1 - b2, b1, b2}, p, normals);
      }
    }
  }

  void drawPixel(const Eigen::Vector2i& pixel, const Vector3& share, const std::array<Vector3, 3>& p,
                 const std::array<Vector3, 3>& normals)
  {
    const std::size_t i = std::size_t(pixel.y()) * this->Mask.width + pixel.x();
    const double inverseDepth = share[0] * p[0].z() + share[1] * p[1].z() + share[2] * p[2].z();
    if (this->Mask.pixels[i] == 0 || share.minCoeff() < -1e-9 || inverseDepth <= this->InverseDepth[i])
    {
      return;
    }
    this->InverseDepth[i] = inverseDepth;
    const Vector3 normal = share[0] * p[0].z() * normals[0] + share[1] * p[1].z() * normals[1] +
                           share[2] * p[2].z() * normals[2];
    this->shade(normal.normalized(), &this->Colours[3 * i]);
  }

  /** The corners' normals, seen from the side that is in view. */
  std::array<Vector3, 3> cornerNormals(std::size_t t) const
  {
    const Triangle& triangle = this->TheMesh.triangles[t];
    const Vector3& flat = this->TheNormals.triangles[t];
    const double side = flat.dot(this->Eye - this->TheMesh.points[triangle[0]]) < 0.0 ? -1.0 : 1.0;
    std::array<Vector3, 3> result;
    for (int c = 0; c < 3; ++c)
    {
      const Vector3& smooth = this->TheNormals.points[triangle[c]];
      result[c] = side * (smooth.dot(flat) > 0.5 ? smooth : flat);
    }
    return result;
  }

  /** Fired clay. Blue stays the least of the three whatever the light: the chroma key relies on it. */
  void shade(const Vector3& normal, std::uint8_t* colour) const
  {
    constexpr std::array<double, 3> clay = {0.86, 0.42, 0.22};
    const double ambient = 0.20 + 0.08 * normal.z();
    const double light = ambient + 0.85 * std::max(normal.dot(this->Light), 0.0);
    for (int c = 0; c < 3; ++c)
    {
      colour[c] = std::uint8_t(255.0 * std::sqrt(std::min(clay[c] * light, 1.0)) + 0.5); // gamma 2
    }
  }

  /** Object pixels that rounding left without a triangle, at its very border, take a neighbour's colour. */
  void fillGaps()
  {
    for (int row = 0; row < this->Mask.height; ++row)
    {
      for (int column = 0; column < this->Mask.width; ++column)
      {
        const std::size_t i = std::size_t(row) * this->Mask.width + column;
        if (this->Mask.pixels[i] == 0 || this->InverseDepth[i] > 0.0)
        {
          continue;
        }
        this->shade(-this->Light, &this->Colours[3 * i]);
        for (const std::size_t other : {column > 0 ? i - 1 : i, row > 0 ? i - this->Mask.width : i,
                                        column + 1 < this->Mask.width ? i + 1 : i,
                                        row + 1 < this->Mask.height ? i + this->Mask.width : i})
        {
          if (this->InverseDepth[other] > 0.0)
          {
            std::copy_n(&this->Colours[3 * other], 3, &this->Colours[3 * i]);
          }
        }
      }
    }
  }

  const Mesh& TheMesh;
  const ShadingNormals& TheNormals;
  const BinaryImage& Mask;
  Vector3 Eye;
  Vector3 Light;                  ///< unit vector towards it
  std::vector<Vector3> Projected; ///< u, v, 1 / w
  std::vector<double> InverseDepth;
  std::vector<std::uint8_t> Colours;
};

/** Over the triangles' edges; above zero. */
double meanSquaredEdge(const Mesh& mesh)
{
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    for (int c = 0; c < 3; ++c)
    {
      sum += (mesh.points[t[(c + 1) % 3]] - mesh.points[t[c]]).squaredNorm();
    }
  }
  return std::max(sum / (3.0 * double(mesh.triangles.size()) + 1.0), std::numeric_limits<double>::min());
}

} // namespace

ShadingNormals shadingNormals(const Mesh& mesh)
{
  checkMesh(mesh);
  ShadingNormals normals;
  normals.points.assign(mesh.points.size(), Vector3::Zero());
  normals.triangles.reserve(mesh.triangles.size());
  const double shortest = 0.2 * meanSquaredEdge(mesh);
  for (const Triangle& t : mesh.triangles)
  {
    const Vector3& a = mesh.points[t[0]];
    const Vector3 normal = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
    for (int c = 0; c < 3; ++c)
    {
      // Weights by which points on a sphere get the sphere's normals, whatever the triangles' shapes, were it
      // not for `shortest`, which keeps the rounding of tiny triangles from counting most.
      const Vector3& p = mesh.points[t[c]];
      const double next = (mesh.points[t[(c + 1) % 3]] - p).squaredNorm();
      const double other = (mesh.points[t[(c + 2) % 3]] - p).squaredNorm();
      normals.points[t[c]] += normal / ((next + shortest) * (other + shortest));
    }
    normals.triangles.push_back(normal.normalized());
  }
  for (Vector3& normal : normals.points)
  {
    normal.normalize();
  }
  return normals;
}

std::vector<std::uint8_t> shadePhotograph(const Mesh& mesh, const ShadingNormals& normals,
                                          const Projection& projection, const BinaryImage& mask)
{
  if (normals.triangles.size() != mesh.triangles.size() || normals.points.size() != mesh.points.size())
  {
    throw InvalidInput("the normals are not the mesh's");
  }
  if (mask.width < 1 || mask.height < 1 || mask.pixels.size() != std::size_t(mask.width) * mask.height)
  {
    throw InvalidInput("a mask of " + std::to_string(mask.width) + " x " + std::to_string(mask.height) +
                       " pixels holds " + std::to_string(mask.pixels.size()));
  }
  for (const Triangle& triangle : mesh.triangles)
  {
    for (const std::int32_t i : triangle)
    {
      if (!(projection.row(2).dot(mesh.points[i].homogeneous()) > 0.0))
      {
        throw InvalidInput("point " + std::to_string(i) + " is not in front of the camera");
      }
    }
  }
  return Photograph(mesh, normals, projection, mask)();
}

} // namespace silhouette
