// SPDX-License-Identifier: BSD-3-Clause
#include "IntersectionsNear.h"

#include <algorithm>

namespace silhouette
{

IntersectionsNear::IntersectionsNear(const Mesh& mesh, std::vector<std::int32_t> triangles)
  : Part(mesh, std::move(triangles))
{
}

const std::vector<TrianglePair>& IntersectionsNear::pairs(
  const Mesh& mesh, const std::function<bool(std::size_t)>& hasChanged, Execution& execution)
{
  const Mesh part = this->Part.of(mesh);
  std::vector<TrianglePair> found;
  if (!this->IsKnown)
  {
    found = selfIntersections(part, execution);
    this->IsKnown = true;
  }
  else
  {
    std::vector<std::int32_t> changed;
    for (std::size_t n = 0; n < part.triangles.size(); ++n)
    {
      if (hasChanged(std::size_t(this->Part.triangle(n))))
      {
        changed.push_back(std::int32_t(n));
      }
    }
    const auto isOver = [&](const TrianglePair& pair)
    { return std::any_of(pair.begin(), pair.end(), [&](std::int32_t t) { return hasChanged(std::size_t(t)); }); };
    this->Met.erase(std::remove_if(this->Met.begin(), this->Met.end(), isOver), this->Met.end());
    found = selfIntersectionsWith(part, changed, execution);
  }
  for (const TrianglePair& pair : found)
  {
    this->Met.push_back({ this->Part.triangle(std::size_t(pair[0])), this->Part.triangle(std::size_t(pair[1])) });
  }
  return this->Met;
}

} // namespace silhouette
