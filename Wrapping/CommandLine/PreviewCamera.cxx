// SPDX-License-Identifier: BSD-3-Clause
#include "PreviewCamera.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace silhouette::program
{
namespace
{

constexpr double Elevation = 20.0; // degrees
constexpr double Turn = 35.0;      // degrees off the broad side
constexpr double RingVariation = 0.3; // of the cameras' directions along a ring's axis, relative to across
constexpr double Elongated = 1.2;  // of two horizontal extents (standard deviations)

double dot(const Direction& a, const Direction& b)
{
  return vtkMath::Dot(a.data(), b.data());
}

Direction cross(const Direction& a, const Direction& b)
{
  Direction result;
  vtkMath::Cross(a.data(), b.data(), result.data());
  return result;
}

Direction combined(double s, const Direction& a, double t, const Direction& b)
{
  return { s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2] };
}

/** Of unit length; `otherwise` where there is none, or nothing finite. */
Direction unit(const Direction& a, const Direction& otherwise)
{
  const double length = std::sqrt(dot(a, a));
  return length > 1e-9 && std::isfinite(length) ? combined(1.0 / length, a, 0.0, a) : otherwise;
}

struct Sight
{
  Direction up{};   ///< upwards in the image
  Direction back{}; ///< towards the camera
};

/**
 * What a view sees at a point. From the derivatives of its matrix there, since matrices of projective captures
 * cannot be taken apart into a camera.
 */
Sight sightAt(const std::array<double, 12>& p, const std::array<double, 3>& at)
{
  double image[3];
  for (int row = 0; row < 3; ++row)
  {
    image[row] = p[4 * row] * at[0] + p[4 * row + 1] * at[1] + p[4 * row + 2] * at[2] + p[4 * row + 3];
  }
  const double u = image[0] / image[2], v = image[1] / image[2];
  Direction right, down;
  const Direction deeper = { p[8], p[9], p[10] };
  for (int axis = 0; axis < 3; ++axis)
  {
    right[axis] = (p[axis] - u * p[8 + axis]) / image[2];
    down[axis] = (p[4 + axis] - v * p[8 + axis]) / image[2];
  }
  const Direction ray = unit(cross(right, down), { 0.0, 0.0, 0.0 });
  Sight sight;
  sight.up = unit(combined(-1.0, down, 0.0, down), { 0.0, 0.0, 0.0 });
  sight.back = combined(dot(ray, deeper) > 0.0 ? -1.0 : 1.0, ray, 0.0, ray);
  return sight;
}

std::vector<Sight> sightsOf(vtkPartitionedDataSetCollection* views, const std::array<double, 3>& at)
{
  std::vector<Sight> sights;
  for (unsigned int i = 0; i < views->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkDataSet* image = views->GetPartitionedDataSet(i)->GetPartition(0);
    vtkDataArray* matrix = image ? image->GetFieldData()->GetArray("Projection") : nullptr;
    if (matrix && matrix->GetNumberOfValues() == 12)
    {
      std::array<double, 12> values;
      for (int n = 0; n < 12; ++n)
      {
        values[n] = matrix->GetVariantValue(n).ToDouble();
      }
      sights.push_back(sightAt(values, at));
    }
  }
  return sights;
}

Direction meanOf(const std::vector<Sight>& sights, Direction Sight::*member)
{
  Direction sum = { 0.0, 0.0, 0.0 };
  for (const Sight& sight : sights)
  {
    sum = combined(1.0, sum, 1.0 / double(sights.size()), sight.*member);
  }
  return sum;
}

/** The direction in which the directions towards the cameras vary least, and how much: its share of the next. */
std::pair<Direction, double> ringAxis(const std::vector<Sight>& sights)
{
  const Direction mean = meanOf(sights, &Sight::back);
  double covariance[3][3] = {}, axes[3][3], values[3];
  double* rows[3] = { covariance[0], covariance[1], covariance[2] };
  double* columns[3] = { axes[0], axes[1], axes[2] };
  for (const Sight& sight : sights)
  {
    const Direction offset = combined(1.0, sight.back, -1.0, mean);
    for (int i = 0; i < 9; ++i)
    {
      covariance[i / 3][i % 3] += offset[i / 3] * offset[i % 3];
    }
  }
  vtkMath::Jacobi(rows, values, columns); // sorts: the smallest last
  return { { axes[0][2], axes[1][2], axes[2][2] }, values[2] / std::max(values[1], 1e-12) };
}

/**
 * Cameras on a ring stand around an upright axis, even where they were turned on their side; others see upwards
 * what is upwards, in the mean.
 */
Direction upwards(const std::vector<Sight>& sights)
{
  if (sights.empty())
  {
    return { 0.0, 0.0, 1.0 };
  }
  const Direction up = meanOf(sights, &Sight::up);
  const auto [axis, variation] = ringAxis(sights);
  if (sights.size() < 4 || variation > RingVariation)
  {
    return unit(up, { 0.0, 0.0, 1.0 });
  }
  // Its upper end is where it is up in the images; where that says nothing, where the cameras are.
  const double inImages = dot(axis, up);
  const double side = std::abs(inImages) > 0.5 ? inImages : dot(axis, meanOf(sights, &Sight::back));
  return combined(side < 0.0 ? -1.0 : 1.0, axis, 0.0, axis);
}

/** Horizontal direction towards the camera, of unit length. */
Direction facing(vtkPolyData* mesh, const std::array<double, 3>& centre, const Direction& up, const Direction& first)
{
  const Direction someSide = std::abs(up[0]) < 0.9 ? Direction{ 1.0, 0.0, 0.0 } : Direction{ 0.0, 1.0, 0.0 };
  const Direction flat = unit(combined(1.0, someSide, -dot(someSide, up), up), someSide);
  const Direction front = unit(combined(1.0, first, -dot(first, up), up), flat);
  const Direction side = cross(up, front);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[3];
    mesh->GetPoint(i, point);
    const Direction offset = { point[0] - centre[0], point[1] - centre[1], point[2] - centre[2] };
    const double x = dot(offset, side), y = dot(offset, front);
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  const double longest = 0.5 * (xx + yy) + spread, shortest = 0.5 * (xx + yy) - spread;
  const double turn = vtkMath::RadiansFromDegrees(Turn);
  if (longest < Elongated * Elongated * shortest)
  {
    return combined(std::cos(turn), front, std::sin(turn), side);
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy); // of the long axis, from `side` to `front`
  const Direction along = combined(std::cos(angle), side, std::sin(angle), front);
  const Direction broad = combined(-std::sin(angle), side, std::cos(angle), front); // never away from the first view
  return combined(std::cos(turn), broad, dot(along, front) < 0.0 ? -std::sin(turn) : std::sin(turn), along);
}

/** Sets target and extents so that the picture holds all points. */
void frame(vtkPolyData* mesh, PreviewCamera& camera)
{
  const Direction axes[3] = { cross(camera.up, camera.back), camera.up, camera.back };
  double low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::max());
  std::fill_n(high, 3, std::numeric_limits<double>::lowest());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[3];
    mesh->GetPoint(i, point);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double along = vtkMath::Dot(point, axes[axis].data());
      low[axis] = std::min(low[axis], along);
      high[axis] = std::max(high[axis], along);
    }
  }
  camera.target = { 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    camera.target = combined(1.0, camera.target, 0.5 * (low[axis] + high[axis]), axes[axis]);
  }
  camera.width = high[0] - low[0];
  camera.height = high[1] - low[1];
  camera.radius = 0.5 * std::hypot(camera.width, camera.height, high[2] - low[2]);
}

} // namespace

PreviewCamera previewCamera(vtkPolyData* mesh, vtkPartitionedDataSetCollection* views)
{
  std::array<double, 3> centre;
  mesh->GetCenter(centre.data());
  const std::vector<Sight> sights = sightsOf(views, centre);
  const Direction up = upwards(sights);
  const Direction first = sights.empty() ? Direction{ 0.0, -1.0, 0.0 } : sights.front().back;
  const Direction look = facing(mesh, centre, up, first);
  const double above = vtkMath::RadiansFromDegrees(Elevation);
  PreviewCamera camera;
  camera.back = combined(std::cos(above), look, std::sin(above), up);
  camera.up = combined(-std::sin(above), look, std::cos(above), up);
  frame(mesh, camera);
  return camera;
}

} // namespace silhouette::program
