// SPDX-License-Identifier: BSD-3-Clause
/**
 * Some triangles of a mesh as a mesh of their own.
 */
#pragma once

#include "Mesh.h"

#include <vector>

namespace silhouette
{

class MeshPart
{
public:
  MeshPart() = default;
  /** The triangles of these numbers, in this order, and the points that they name, as they are first named. */
  MeshPart(const Mesh& mesh, std::vector<std::int32_t> numbers)
    : Numbers(std::move(numbers))
  {
    std::vector<std::int32_t> own(mesh.points.size(), -1);
    for (const std::int32_t n : this->Numbers)
    {
      Triangle triangle = mesh.triangles[std::size_t(n)];
      for (std::int32_t& p : triangle)
      {
        if (own[std::size_t(p)] < 0)
        {
          own[std::size_t(p)] = std::int32_t(this->Points.size());
          this->Points.push_back(p);
        }
        p = own[std::size_t(p)];
      }
      this->Triangles.push_back(triangle);
    }
  }

  /** Number in the mesh of one of the part's triangles. */
  std::int32_t triangle(std::size_t n) const { return this->Numbers[n]; }
  /** The part, with the points where a mesh of the same triangles has them. Cost: linear in the part. */
  Mesh of(const Mesh& mesh) const
  {
    Mesh part{ {}, this->Triangles };
    for (const std::int32_t p : this->Points)
    {
      part.points.push_back(mesh.points[std::size_t(p)]);
    }
    return part;
  }

private:
  std::vector<std::int32_t> Numbers;
  std::vector<std::int32_t> Points; ///< numbers in the mesh
  std::vector<Triangle> Triangles;
};

} // namespace silhouette
