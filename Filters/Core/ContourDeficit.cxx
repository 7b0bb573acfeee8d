// SPDX-License-Identifier: BSD-3-Clause
#include "ContourDeficit.h"

#include <algorithm>

namespace silhouette
{
namespace
{

constexpr double NearShare = 1.0 / 3.0; ///< of the smallest deficit that counts; from a half on, a shift counts as well
constexpr double SureOfChance = 2.0;    ///< times the share of chance that tells contour noise from wrong cameras

TypicalShift typicalShift(const std::vector<ContourResidual>& residuals, const std::vector<int>& views, const FieldViews& fieldViews)
{
  TypicalShift typical;
  int count = 0;
  for (std::size_t n = 0; n < views.size(); ++n)
  {
    if (residuals[n].count > 0)
    {
      ++count;
      typical.pixels += residuals[n].shift.norm();
      typical.octants += residuals[n].shift.norm() / fieldViews.pixelsPerOctant(views[n]);
    }
  }
  typical.pixels /= std::max(count, 1);
  typical.octants /= std::max(count, 1);
  return typical;
}

int countSaying(const std::vector<ContourResidual>& residuals)
{
  return int(std::count_if(residuals.begin(), residuals.end(), [](const ContourResidual& residual) { return residual.count > 0; }));
}

/** Of residuals of `views`, some of which may say nothing. */
double shareOfChance(const FieldViews& fieldViews, const std::vector<int>& views, std::vector<ContourResidual> residuals)
{
  removeCommonShift(fieldViews, views, residuals);
  return noiseShare(residuals);
}

} // namespace

std::vector<int> everyThirdView(int views)
{
  std::vector<int> some;
  for (int view = 0; view < views; view += 3)
  {
    some.push_back(view);
  }
  return some;
}

ContourDeficit::ContourDeficit(const FieldViews& fieldViews, const Mesh& surface, double limit, double smallest, double shiftNoise, Execution& execution)
{
  const std::vector<int> some = everyThirdView(fieldViews.size());
  this->residuals.resize(some.size());
  const auto measure = [&](bool later)
  {
    std::vector<int> views;
    std::vector<std::size_t> places;
    for (std::size_t n = 0; n < some.size(); ++n)
    {
      if ((n / 2 % 2 != 0) == later)
      {
        views.push_back(some[n]);
        places.push_back(n);
      }
    }
    const auto measured = contourResiduals(fieldViews, surface, views, limit, execution);
    for (std::size_t n = 0; n < places.size(); ++n)
    {
      this->residuals[places[n]] = measured[n];
    }
  };
  measure(false);
  this->chance = shareOfChance(fieldViews, some, this->residuals);
  if (some.size() > 2 && typicalResidual(this->residuals) >= NearShare * smallest &&
    (countSaying(this->residuals) < ViewsToJudgeBy || this->chance <= SureOfChance * shiftNoise))
  {
    measure(true);
    this->chance = shareOfChance(fieldViews, some, this->residuals);
  }
  this->octants = std::max(0.0, typicalResidual(this->residuals));
  this->shift = typicalShift(this->residuals, some, fieldViews);
}

} // namespace silhouette
