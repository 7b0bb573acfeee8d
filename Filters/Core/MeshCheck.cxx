// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCheck.h"

#include "Error.h"

#include <algorithm>
#include <atomic>
#include <string>

namespace silhouette
{

namespace
{

bool isPoint(const Mesh& mesh, std::int32_t point)
{
  return point >= 0 && std::size_t(point) < mesh.points.size();
}

} // namespace

void checkMesh(const Mesh& mesh)
{
  const auto count = std::int64_t(mesh.points.size());
  for (std::int64_t p = 0; p < count; ++p)
  {
    if (!mesh.points[p].allFinite())
    {
      throw InvalidInput("point " + std::to_string(p) + " has a coordinate that is not finite");
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const std::int32_t p : mesh.triangles[t])
    {
      if (!isPoint(mesh, p))
      {
        throw InvalidInput("triangle " + std::to_string(t) + " names point " + std::to_string(p) +
          " of a mesh of " + std::to_string(count) + " points");
      }
    }
  }
}

void checkMesh(const Mesh& mesh, Execution& execution)
{
  std::atomic<bool> isFine{ true };
  execution.forRanges(std::max(mesh.points.size(), mesh.triangles.size()), 16384,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t n = first; n < std::min(last, mesh.points.size()); ++n)
      {
        if (!mesh.points[n].allFinite())
        {
          isFine = false;
        }
      }
      for (std::size_t n = first; n < std::min(last, mesh.triangles.size()); ++n)
      {
        for (const std::int32_t p : mesh.triangles[n])
        {
          if (!isPoint(mesh, p))
          {
            isFine = false;
          }
        }
      }
    });
  if (!isFine)
  {
    checkMesh(mesh); // tells what is wrong
  }
}

} // namespace silhouette
