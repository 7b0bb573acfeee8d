// SPDX-License-Identifier: BSD-3-Clause
#include "ContourDeficit.h"

#include "FieldCorrectionScene.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr double Limit = 3.0;

double deficitOf(const Corrected& corrected, const std::vector<int>& views)
{
  Execution execution;
  const FieldViews fieldViews(corrected.views, corrected.lattice, 4.0);
  return std::max(0.0, typicalResidual(contourResiduals(fieldViews, corrected.exact, views, Limit, execution)));
}

ContourDeficit measure(const Corrected& corrected, double smallest)
{
  Execution execution;
  return { FieldViews(corrected.views, corrected.lattice, 4.0), corrected.exact, Limit, smallest, FieldCorrectionOptions().shiftNoise, execution };
}

const std::vector<int> Thirds{ 0, 3, 6, 9, 12, 15, 18, 21 }, First{ 0, 3, 12, 15 };

} // namespace

TEST(ContourDeficit, IsThatOfEveryThirdViewWhicheverOfTwoCamerasIsNoisy)
{
  EXPECT_EQ(everyThirdView(24), Thirds);
  Capture& capture = captureOf(SyntheticShape::Torus);
  capture.draw(1.2, 0, 3);
  for (const std::size_t noisy : { 0, 1 }) // of two that take turns
  {
    const Corrected one(capture.preparedWhere([&](std::size_t view) { return view % 2 != noisy; }));
    const ContourDeficit deficit = measure(one, FieldCorrectionOptions().smallestDeficit);
    EXPECT_GT(deficit.octants, FieldCorrectionOptions().smallestDeficit) << noisy;
    EXPECT_EQ(deficit.octants, deficitOf(one, Thirds)) << noisy;
    EXPECT_TRUE(one.correction.field) << noisy;
    EXPECT_EQ(one.correction.deficit, deficit.octants) << noisy;
  }
}

TEST(ContourDeficit, OfHalfOfThemWhereThatIsFarFromWhatCounts)
{
  Capture& capture = captureOf(SyntheticShape::Torus);
  const Corrected clean(capture.prepared(true));
  const double half = deficitOf(clean, First), all = deficitOf(clean, Thirds);
  ASSERT_GT(half, 0.0); // few pixels
  ASSERT_NE(half, all);
  EXPECT_EQ(measure(clean, 3.1 * half).octants, half);
  EXPECT_EQ(measure(clean, 2.9 * half).octants, all);
  const ContourDeficit some = measure(clean, 3.1 * half);
  ASSERT_EQ(some.residuals.size(), Thirds.size());
  for (std::size_t n = 0; n < Thirds.size(); ++n)
  {
    EXPECT_EQ(some.residuals[n].count > 0, n % 4 < 2) << n;
  }
}

/** Contour noise is in all views alike, wrong cameras are not. */
TEST(ContourDeficit, OfHalfOfThemWhereContoursAreNoisyAndOfAllWhereCamerasAreWrong)
{
  Capture capture(SyntheticShape::Torus, 36);
  const std::vector<int> thirds = everyThirdView(36), first{ 0, 3, 12, 15, 24, 27 };
  for (const bool isCamera : { false, true })
  {
    for (const std::uint64_t seed : { 1, 2, 3 })
    {
      capture.draw(isCamera ? 0.0 : 1.2, isCamera ? 1.0 : 0.0, seed);
      const Corrected one(capture);
      const ContourDeficit deficit = measure(one, FieldCorrectionOptions().smallestDeficit);
      EXPECT_EQ(deficit.octants, deficitOf(one, isCamera ? thirds : first)) << isCamera << ", seed " << seed;
      EXPECT_EQ(one.correction.deficit, deficit.octants) << isCamera << ", seed " << seed;
      EXPECT_EQ(one.correction.alignment > 0.0, isCamera) << "seed " << seed;
      if (!isCamera)
      {
        EXPECT_NEAR(deficit.octants, deficitOf(one, thirds), 0.2 * deficit.octants) << "seed " << seed;
      }
    }
  }
}

TEST(ContourDeficit, ShiftIsTheMeanOfTheViewsThatSayAnything)
{
  Capture& capture = captureOf(SyntheticShape::Torus);
  capture.draw(0, 1.0, 2);
  const Corrected corrected(capture);
  const ContourDeficit deficit = measure(corrected, 0.0);
  const FieldViews fieldViews(corrected.views, corrected.lattice, 4.0);
  double pixels = 0.0, octants = 0.0;
  for (std::size_t n = 0; n < Thirds.size(); ++n)
  {
    ASSERT_GT(deficit.residuals[n].count, 0u);
    pixels += deficit.residuals[n].shift.norm() / double(Thirds.size());
    octants += deficit.residuals[n].shift.norm() / fieldViews.pixelsPerOctant(Thirds[n]) / double(Thirds.size());
  }
  EXPECT_NEAR(deficit.shift.pixels, pixels, 1e-12);
  EXPECT_NEAR(deficit.shift.octants, octants, 1e-12);
  EXPECT_GT(pixels, 0.3); // cameras are a pixel off
}
