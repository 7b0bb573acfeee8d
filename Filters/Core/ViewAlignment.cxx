// SPDX-License-Identifier: BSD-3-Clause
#include "ViewAlignment.h"

#include "OutlineRendering.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr double LeastThickness = 1.5; ///< octants
constexpr double LeastShare = 0.2;     ///< of a view's contour places; where fewer are thick, the view says nothing
constexpr int Squares = 8;             ///< along a contour's extent
constexpr int Unknowns = 3;            ///< of a fit

/** Contour places by squares of the image, an eighth of the contour's extent wide. */
class ContourSquares
{
public:
  explicit ContourSquares(const std::vector<ContourPlace>& places)
  {
    std::array<std::int32_t, 4> box{ std::numeric_limits<std::int32_t>::max(), -1, std::numeric_limits<std::int32_t>::max(), -1 };
    for (const ContourPlace& place : places)
    {
      box = { std::min(box[0], place.column), std::max(box[1], place.column), std::min(box[2], place.row), std::max(box[3], place.row) };
    }
    this->Left = box[0];
    this->Top = box[2];
    this->PerPixel = Squares / (std::max(double(box[1]) - box[0], double(box[3]) - box[2]) + 1.0);
  }

  std::size_t of(double u, double v) const
  {
    const auto number = [this](double x) { return std::size_t(std::clamp(int(x * this->PerPixel), 0, Squares - 1)); };
    return number(u - this->Left) + Squares * number(v - this->Top);
  }

private:
  double Left = 0.0; ///< px
  double Top = 0.0;
  double PerPixel = 1.0;
};

/** Least squares of residual = constant - normal . shift over contour places. */
template <typename Distances>
class Fit
{
public:
  Fit(const SilhouetteRuns& surface, const ContourSquares& squares, Distances& distances, double pixelsPerOctant)
    : Surface(surface)
    , SquareOf(squares)
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
    Equations& equations = this->InSquare[this->SquareOf.of(u, v)];
    equations.normal += row * row.transpose();
    equations.right += residual * row;
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
      this->solve(residual);
    }
    return residual;
  }

private:
  struct Equations
  {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
  };

  /**
   * The shift, and its variance from the squares' misfits: places of one square count as one, since neighbours err alike (the
   * estimate of standard errors by clusters; Liang and Zeger 1986).
   */
  void solve(ContourResidual& residual) const
  {
    Equations all;
    for (const Equations& equations : this->InSquare)
    {
      all.normal += equations.normal;
      all.right += equations.right;
    }
    // A little damping, so that a straight contour is not shifted along itself.
    all.normal.diagonal().array() += 1e-3 * all.normal.trace() + 1e-12;
    const Eigen::LDLT<Eigen::Matrix3d> solver(all.normal);
    const Eigen::Vector3d found = solver.solve(all.right);
    residual.shift = found.head<2>();
    double squares = 0.0;
    for (const Equations& equations : this->InSquare)
    {
      const Eigen::Vector3d misfit = solver.solve(equations.right - equations.normal * found);
      squares += equations.normal(2, 2) > 0.0; // the constant's is the number of places
      residual.noise += misfit.head<2>().squaredNorm();
    }
    residual.noise = squares > Unknowns ? residual.noise * squares / (squares - Unknowns) : residual.shift.squaredNorm();
  }

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
  const ContourSquares& SquareOf;
  Distances& Map;
  double Scale; ///< pixels for an octant
  std::size_t Places = 0;
  std::vector<float> Residuals;
  std::array<Equations, Squares * Squares> InSquare;
};

/** Every place between two pixels of which one belongs to the surface. */
template <typename Distances>
ContourResidual compare(const SilhouetteRuns& surface, Distances&& distances, double limit, double pixelsPerOctant)
{
  const std::vector<ContourPlace> places = contourPlaces(surface);
  const ContourSquares squares(places);
  Fit fit(surface, squares, distances, pixelsPerOctant);
  for (const ContourPlace& place : places)
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

double noiseShare(const std::vector<ContourResidual>& residuals)
{
  double noise = 0.0, squares = 0.0, numbers = 0.0;
  for (const auto& residual : residuals)
  {
    if (residual.count > 0)
    {
      noise += residual.noise;
      squares += residual.shift.squaredNorm();
      numbers += 2.0;
    }
  }
  return squares > 0.0 ? noise / squares * std::max(1.0, numbers - 3.0) / numbers : std::numeric_limits<double>::infinity();
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
