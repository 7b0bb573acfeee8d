// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCheck.h"

#include "Error.h"

#include <string>

namespace silhouette
{

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
      if (p < 0 || p >= count)
      {
        throw InvalidInput("triangle " + std::to_string(t) + " names point " + std::to_string(p) +
          " of a mesh of " + std::to_string(count) + " points");
      }
    }
  }
}

} // namespace silhouette
