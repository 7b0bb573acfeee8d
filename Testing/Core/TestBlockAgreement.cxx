// SPDX-License-Identifier: BSD-3-Clause
#include "BlockAgreement.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr std::size_t Points = 24; ///< three groups

} // namespace

/** By the exponential function, in double precision. */
TEST(BlockAgreement, IsTheWeightedMeanOfTheViewsThatAreNear)
{
  constexpr float far = 4.0f, deviation = 0.4f, limit = 3.0f;
  Random random(6);
  std::vector<std::vector<float>> modelled(9), observed(9);
  BlockAgreement agreement(Points, far, deviation, limit);
  for (std::size_t view = 0; view < modelled.size(); ++view)
  {
    for (std::size_t n = 0; n < Points; ++n)
    {
      const bool isFar = n / BlockGroups::Points == view % 3; // in all of a group
      modelled[view].push_back(float(isFar ? random.uniform(0.0, far) : random.uniform(-far, -2.0)));
      observed[view].push_back(modelled[view].back() + float(random.uniform(-4.0, 4.0)));
    }
    agreement.approach(modelled[view].data());
  }
  for (std::size_t view = 0; view < modelled.size(); ++view)
  {
    const BlockGroups heard = agreement.heard(modelled[view].data());
    std::vector<float> seen;
    for (std::size_t n = 0; n < heard.points(); ++n)
    {
      seen.push_back(observed[view][heard.point(n)]);
    }
    agreement.hear(heard, modelled[view].data(), seen.data());
    EXPECT_EQ(heard.size(), 2u) << view;
  }
  int counted = 0, others = 0;
  for (std::size_t n = 0; n < Points; ++n)
  {
    double least = far, sum = 0.0, weights = 0.0;
    for (const auto& view : modelled)
    {
      least = std::min(least, double(view[n]));
    }
    EXPECT_EQ(agreement.least(n), float(least));
    for (std::size_t view = 0; view < modelled.size(); ++view)
    {
      const double x = (modelled[view][n] - least) / deviation, residual = double(observed[view][n]) - modelled[view][n];
      const bool counts = x < BlockAgreement::GreatestDeviation && std::abs(residual) < limit;
      ++(counts ? counted : others);
      sum += counts ? std::exp(-0.5 * x * x) * residual : 0.0;
      weights += counts ? std::exp(-0.5 * x * x) : 0.0;
    }
    EXPECT_NEAR(agreement.weight(n), weights, 2e-5 * weights);
    EXPECT_NEAR(agreement.difference(n) * weights, sum, 1e-4 * std::max(weights, 1e-3));
  }
  EXPECT_GT(counted, 50);
  EXPECT_GT(others, 50);
}

TEST(BlockAgreement, WhereNoViewIsHeardThereIsNoDifference)
{
  const std::vector<float> modelled(Points, 1.0f), observed(Points, 6.0f);
  BlockAgreement agreement(Points, 4.0f, 1.0f, 3.0f);
  agreement.approach(modelled.data());
  agreement.hear(agreement.heard(modelled.data()), modelled.data(), observed.data()); // further apart than the limit
  for (std::size_t n = 0; n < Points; ++n)
  {
    EXPECT_EQ(agreement.weight(n), 0.0f);
    EXPECT_EQ(agreement.difference(n), 0.0f);
    EXPECT_EQ(agreement.least(n), 1.0f);
  }
}

/** Of one view that is further and further from the contour of another. */
TEST(BlockAgreement, WeightsAreRightUpToTheGreatestDeviation)
{
  for (double x = 0.0; x < 2.999; x += 0.001)
  {
    const std::vector<float> near(Points, 0.0f), away(Points, float(x));
    BlockAgreement agreement(Points, 4.0f, 1.0f, 3.0f);
    agreement.approach(near.data());
    agreement.approach(away.data());
    agreement.hear(agreement.heard(away.data()), away.data(), away.data());
    ASSERT_NEAR(agreement.weight(17), std::exp(-0.5 * x * x), 2e-5 * std::exp(-0.5 * x * x)) << x;
  }
}
