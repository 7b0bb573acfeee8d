// SPDX-License-Identifier: BSD-3-Clause
#include "ViewAgreement.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

/** By the exponential function, in double precision. */
TEST(ViewAgreement, IsTheWeightedMeanOfTheViewsThatAreNear)
{
  constexpr std::size_t Points = ViewAgreement::Points;
  constexpr float far = 4.0f, deviation = 0.7f, limit = 3.0f;
  Random random(6);
  std::vector<std::vector<float>> modelled(9), observed(9);
  ViewAgreement agreement(far);
  for (std::size_t view = 0; view < modelled.size(); ++view)
  {
    for (std::size_t n = 0; n < Points; ++n)
    {
      modelled[view].push_back(float(random.uniform(-far, far)));
      observed[view].push_back(modelled[view].back() + float(random.uniform(-4.0, 4.0)));
    }
    agreement.approach(modelled[view].data());
  }
  for (std::size_t view = 0; view < modelled.size(); ++view)
  {
    agreement.hear(modelled[view].data(), observed[view].data(), 1.0f / deviation, limit);
  }
  int heard = 0, unheard = 0;
  for (std::size_t n = 0; n < Points; ++n)
  {
    double least = far, sum = 0.0, weights = 0.0;
    for (const auto& view : modelled)
    {
      least = std::min(least, double(view[n]));
    }
    EXPECT_EQ(agreement.least[n], float(least));
    for (std::size_t view = 0; view < modelled.size(); ++view)
    {
      const double x = (modelled[view][n] - least) / deviation, residual = double(observed[view][n]) - modelled[view][n];
      const bool counts = x < ViewAgreement::GreatestDeviation && std::abs(residual) < limit;
      ++(counts ? heard : unheard);
      sum += counts ? std::exp(-0.5 * x * x) * residual : 0.0;
      weights += counts ? std::exp(-0.5 * x * x) : 0.0;
    }
    EXPECT_NEAR(agreement.weights[n], weights, 2e-5 * weights);
    EXPECT_NEAR(agreement.sum[n], sum, 1e-4 * std::max(weights, 1e-3));
  }
  EXPECT_GT(heard, 100);
  EXPECT_GT(unheard, 100);
}

/** Of one view that is further and further from the contour of another. */
TEST(ViewAgreement, WeightsAreRightUpToTheGreatestDeviation)
{
  for (double x = 0.0; x < 2.999; x += 0.001)
  {
    std::vector<float> near(ViewAgreement::Points, 0.0f), away(ViewAgreement::Points, float(x));
    ViewAgreement agreement(4.0f);
    agreement.approach(near.data());
    agreement.approach(away.data());
    agreement.hear(away.data(), away.data(), 1.0f, 3.0f);
    ASSERT_NEAR(agreement.weights[17], std::exp(-0.5 * x * x), 2e-5 * std::exp(-0.5 * x * x)) << x;
  }
}
