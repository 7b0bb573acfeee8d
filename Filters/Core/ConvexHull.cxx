// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexHull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>

extern "C"
{
#include <libqhull_r/qhull_ra.h>
}

namespace silhouette
{
namespace
{

/** Owns Qhull's state, and swallows what it would print. */
class QhullRun
{
public:
  explicit QhullRun(std::vector<double>& coordinates)
    : Messages(std::tmpfile())
  {
    FILE* messages = this->Messages ? this->Messages : stderr;
    qh_zero(&this->State, messages);
    char command[] = "qhull Qt Pp";
    this->Failed =
      qh_new_qhull(&this->State, 3, int(coordinates.size() / 3), coordinates.data(), False, command, nullptr, messages) != 0;
  }
  ~QhullRun()
  {
    qh_freeqhull(&this->State, !qh_ALL);
    int remaining = 0, total = 0;
    qh_memfreeshort(&this->State, &remaining, &total);
    if (this->Messages)
    {
      std::fclose(this->Messages);
    }
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool failed() const { return this->Failed; }

  /** The facets as indices into the points given. */
  std::vector<Triangle> triangles()
  {
    std::vector<Triangle> triangles;
    qhT* qh = &this->State; // the name that Qhull's macros expect
    facetT* facet = nullptr;
    FORALLfacets
    {
      Triangle triangle{};
      int corner = 0;
      vertexT *vertex = nullptr, **vertexp = nullptr;
      FOREACHvertex_(facet->vertices)
      {
        if (corner < 3)
        {
          triangle[corner++] = std::int32_t(qh_pointid(qh, vertex->point));
        }
      }
      if (facet->toporient ^ (qh_ORIENTclock != 0))
      {
        std::swap(triangle[1], triangle[2]);
      }
      triangles.push_back(triangle);
    }
    return triangles;
  }

private:
  qhT State{};
  FILE* Messages;
  bool Failed = true;
};

} // namespace

double signedVolume(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles)
{
  double volume = 0.0;
  for (const auto& t : triangles)
  {
    const Eigen::Vector3d& o = points[triangles[0][0]];
    volume += (points[t[0]] - o).dot((points[t[1]] - o).cross(points[t[2]] - o)) / 6.0;
  }
  return volume;
}

std::optional<Mesh> convexHull(const std::vector<Eigen::Vector3d>& points)
{
  if (points.size() < 4)
  {
    return std::nullopt;
  }
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const auto& p : points)
  {
    coordinates.insert(coordinates.end(), { p.x(), p.y(), p.z() });
  }
  QhullRun run(coordinates);
  if (run.failed())
  {
    return std::nullopt;
  }
  auto triangles = run.triangles();
  if (triangles.empty())
  {
    return std::nullopt;
  }
  if (signedVolume(points, triangles) < 0.0)
  {
    for (auto& triangle : triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
  // Keep the hull's vertices only.
  std::vector<std::int32_t> number(points.size(), -1);
  for (const auto& triangle : triangles)
  {
    for (const auto corner : triangle)
    {
      number[corner] = 0;
    }
  }
  Mesh hull;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (number[i] == 0)
    {
      number[i] = std::int32_t(hull.points.size());
      hull.points.push_back(points[i]);
    }
  }
  for (auto& triangle : triangles)
  {
    for (auto& corner : triangle)
    {
      corner = number[corner];
    }
  }
  hull.triangles = std::move(triangles);
  return hull;
}

} // namespace silhouette
