// SPDX-License-Identifier: BSD-3-Clause
#include "ProjectiveCameras.h"

#include "Error.h"
#include "TextParsing.h"
#include "ViewingCones.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace silhouette
{

namespace
{

constexpr double LargestAspect = 1.25;
constexpr double LargestSkew = 0.1; // of fx

bool isMetric(const InnerCamera& camera)
{
  const double aspect = camera.fx / camera.fy;
  return aspect <= LargestAspect && aspect >= 1.0 / LargestAspect &&
         std::abs(camera.skew) <= LargestSkew * camera.fx;
}

std::string rounded(double value)
{
  return formatNumber(std::round(value * 100.0) / 100.0 + 0.0); // never -0
}

/** Counts of what is amiss, and the first view where it is. */
struct Findings
{
  int mirrored = 0;
  int notMetric = 0;
  int first = -1;
  int firstNotMetric = -1;
};

Findings findingsOf(const std::vector<InnerCamera>& cameras)
{
  Findings findings;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    if (cameras[i].determinant == 0.0)
    {
      continue;
    }
    const bool mirrored = cameras[i].determinant < 0.0;
    const bool metric = isMetric(cameras[i]);
    findings.mirrored += mirrored ? 1 : 0;
    findings.notMetric += metric ? 0 : 1;
    findings.first = findings.first < 0 && (mirrored || !metric) ? int(i) : findings.first;
    findings.firstNotMetric = findings.firstNotMetric < 0 && !metric ? int(i) : findings.firstNotMetric;
  }
  return findings;
}

} // namespace

int orientProjections(std::vector<Projection>& projections, const std::vector<Vector2>& pixels)
{
  if (projections.size() != pixels.size())
  {
    throw InvalidInput("orienting the projections: " + std::to_string(projections.size()) +
                       " projections, but " + std::to_string(pixels.size()) + " pixels");
  }
  if (projections.empty())
  {
    return 0;
  }
  const bool single = projections.size() == 1;
  const Vector3 point = single ? Vector3::Zero() : nearestPointToRays(projections, pixels);
  int negated = 0;
  for (Projection& projection : projections)
  {
    const double sign =
        single ? projection.leftCols<3>().determinant() : projection.row(2).dot(point.homogeneous());
    if (sign < 0.0)
    {
      projection = -projection;
      ++negated;
    }
  }
  return negated;
}

InnerCamera innerCamera(const Projection& projection)
{
  Eigen::Matrix3d rows = projection.leftCols<3>();
  InnerCamera camera;
  const double scale = rows.row(2).norm();
  if (!(scale > 0.0))
  {
    return camera;
  }
  const Eigen::Matrix3d unit = rows.rowwise().normalized();
  if (!(std::abs(unit.determinant()) > 1e-12))
  {
    return camera;
  }
  // Gram-Schmidt from the last row upward is the RQ decomposition; its axes are the camera's z, y and x.
  rows /= scale;
  const Vector3 z = rows.row(2);
  camera.cx = rows.row(0).dot(z);
  camera.cy = rows.row(1).dot(z);
  const Vector3 second = rows.row(1).transpose() - camera.cy * z;
  camera.fy = second.norm();
  const Vector3 y = second / camera.fy;
  camera.skew = rows.row(0).dot(y);
  camera.fx = (rows.row(0).transpose() - camera.cx * z - camera.skew * y).norm();
  camera.determinant = unit.determinant();
  return camera;
}

std::string projectiveWarning(const std::vector<Projection>& projections,
                              const std::vector<std::string>& names)
{
  std::vector<InnerCamera> cameras;
  for (const Projection& projection : projections)
  {
    cameras.push_back(innerCamera(projection));
  }
  const Findings findings = findingsOf(cameras);
  if (findings.first < 0)
  {
    return {};
  }
  const auto of = " of " + std::to_string(projections.size()) + " projections";
  std::string text;
  if (findings.mirrored > 0)
  {
    text = std::to_string(findings.mirrored) + of + " are mirrored (negative determinant)";
  }
  if (findings.notMetric > 0)
  {
    const auto at = std::size_t(findings.firstNotMetric);
    text += (text.empty() ? "" : " and ") + std::to_string(findings.notMetric) + of +
            " are not metric (fx : fy = " + rounded(cameras[at].fx / cameras[at].fy) +
            ", skew : fx = " + rounded(cameras[at].skew / cameras[at].fx) + ")";
  }
  const auto first = std::size_t(findings.first);
  const bool isNamed = first < names.size() && !names[first].empty();
  text += "; the first is view " + (isNamed ? inQuotes(names[first]) : std::to_string(first));
  const char* differs = findings.notMetric == 0  ? "handedness differs"
                        : findings.mirrored == 0 ? "lengths and angles differ"
                                                 : "lengths, angles and handedness differ";
  const int count = int(projections.size());
  const auto isSome = [count](int found) { return found > 0 && found < count; };
  const bool isOdd = isSome(findings.mirrored) || isSome(findings.notMetric);
  return text + (isOdd ? ". Where others are as they should be, such a matrix is probably wrong"
                       : std::string(". If the matrices are right, the mesh fits the photographs, but its ") + differs +
                             " from the object's");
}

} // namespace silhouette
