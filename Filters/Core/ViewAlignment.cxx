// SPDX-License-Identifier: BSD-3-Clause
#include "ViewAlignment.h"

#include "OutlineRendering.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr double LeastThickness = 1.5; ///< octants
constexpr double LeastShare = 0.2;     ///< of a view's contour places; where fewer are thick, the view says nothing

/** Least squares of residual = constant - normal . shift over contour places. */
template <typename Distances>
class Fit
{
public:
  Fit(const SilhouetteRuns& surface, Distances& distances, double pixelsPerOctant)
    : Surface(surface)
    , Map(distances)
    , Scale(pixelsPerOctant)
  {
  }

  void add(double u, double v, double limit)
  {
    ++this->Places;
    const double residual = this->Map.at(u, v);
    if (std::abs(residual) > limit)
    {
      return;
    }
    const Vector2 gradient = this->gradient(u, v);
    const double length = gradient.norm();
    if (length < 0.5 || this->thin(u, v, gradient, length)) // between two contours there is no normal
    {
      return;
    }
    this->Residuals.push_back(float(residual));
    const Eigen::Vector3d row(-gradient[0] / length, -gradient[1] / length, 1.0);
    this->Normal += row * row.transpose();
    this->Right += residual * row;
  }

  ContourResidual result()
  {
    ContourResidual residual;
    residual.count = this->Residuals.size();
    if (residual.count < LeastShare * double(this->Places))
    {
      residual.count = 0;
    }
    if (residual.count > 0)
    {
      residual.mean = this->trimmedMean() / this->Scale;
      // A little damping, so that a straight contour is not shifted along itself.
      Eigen::Matrix3d normal = this->Normal;
      normal.diagonal().array() += 1e-3 * normal.trace() + 1e-12;
      residual.shift = normal.ldlt().solve(this->Right).head<2>();
    }
    return residual;
  }

private:
  Vector2 gradient(double u, double v) const
  {
    Distances& map = this->Map;
    return { map.at(u + 1.0, v) - map.at(u - 1.0, v), map.at(u, v + 1.0) - map.at(u, v - 1.0) };
  }

  /** Is the surface's silhouette thinner here than what noise is told from? Its ends and gaps would look like noise. */
  bool thin(double u, double v, const Vector2& inward, double length) const
  {
    const double step = LeastThickness * this->Scale / length;
    const double column = std::floor(u + step * inward[0] + 0.5), row = std::floor(v + step * inward[1] + 0.5);
    return !(column >= 0.0 && row >= 0.0 && column < this->Surface.width && row < this->Surface.height) ||
      !this->Surface.at(int(column), int(row));
  }

  /** Without the tenth at either end: what hides behind something else has no contour to be compared with. */
  double trimmedMean()
  {
    const std::size_t cut = this->Residuals.size() / 10;
    const auto first = this->Residuals.begin() + std::ptrdiff_t(cut);
    const auto last = this->Residuals.end() - std::ptrdiff_t(cut);
    std::nth_element(this->Residuals.begin(), first, this->Residuals.end());
    std::nth_element(first, last - 1, this->Residuals.end());
    return std::accumulate(first, last, 0.0) / double(last - first);
  }

  const SilhouetteRuns& Surface;
  Distances& Map;
  double Scale; ///< pixels for an octant
  std::size_t Places = 0;
  std::vector<float> Residuals;
  Eigen::Matrix3d Normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d Right = Eigen::Vector3d::Zero();
};

/** Every place between two pixels of which one belongs to the surface. */
template <typename Distances>
ContourResidual compare(const SilhouetteRuns& surface, Distances&& distances, double limit, double pixelsPerOctant)
{
  Fit fit(surface, distances, pixelsPerOctant);
  for (const ContourPlace& place : contourPlaces(surface))
  {
    fit.add(place.column + (place.isBelow ? 0.0 : 0.5), place.row + (place.isBelow ? 0.5 : 0.0), limit);
  }
  return fit.result();
}

} // namespace

std::vector<ContourResidual> contourResiduals(
  const FieldViews& fieldViews, const Mesh& surface, const std::vector<int>& views, double limit, Execution& execution)
{
  const OutlineRenderer renderer(surface, fieldViews.cameras(views), execution);
  std::vector<ContourResidual> residuals(views.size());
  execution.forRanges(views.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const double scale = fieldViews.pixelsPerOctant(views[i]);
        const SilhouetteRuns seen = renderer.render(i);
        residuals[i] = fieldViews.isObserved(views[i])
          ? compare(seen, fieldViews.observed(views[i]), limit * scale, scale)
          : compare(seen, fieldViews.observedOnDemand(views[i]), limit * scale, scale);
      }
    });
  return residuals;
}

Vector3 removeCommonShift(
  const FieldViews& fieldViews, const std::vector<int>& views, std::vector<ContourResidual>& residuals)
{
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vector3 right = Vector3::Zero();
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    if (residuals[i].count > 0)
    {
      const auto steps = fieldViews.pixelSteps(views[i]);
      normal += steps.transpose() * steps;
      right += steps.transpose() * residuals[i].shift;
    }
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
  if (!solver.isInvertible())
  {
    return Vector3::Zero();
  }
  const Vector3 move = solver.solve(right);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    if (residuals[i].count > 0)
    {
      residuals[i].shift -= fieldViews.pixelSteps(views[i]) * move;
    }
  }
  return move;
}

double typicalResidual(const std::vector<ContourResidual>& residuals)
{
  double sum = 0.0, count = 0.0;
  for (const auto& residual : residuals)
  {
    sum += residual.mean * double(residual.count);
    count += double(residual.count);
  }
  return count > 0.0 ? sum / count : 0.0;
}

} // namespace silhouette
