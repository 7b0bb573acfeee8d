// SPDX-License-Identifier: BSD-3-Clause
/**
 * The shifts of the views within the field's correction: for whom, and how well.
 */
#include "FieldCorrection.h"

#include "FieldCorrectionScene.h"
#include "ViewAlignment.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

double meanLength(const std::vector<Vector2>& shifts)
{
  return std::accumulate(shifts.begin(), shifts.end(), 0.0,
           [](double sum, const Vector2& shift) { return sum + shift.norm(); }) /
    double(shifts.size());
}

/** The shifts without what a translation of the whole object explains: no silhouette shows that. */
std::vector<Vector2> withoutTranslation(std::vector<Vector2> shifts, const SyntheticCapture& capture)
{
  using Rows = Eigen::Matrix<double, 2, 3>;
  std::vector<Rows> derivatives;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vector3 right = Vector3::Zero();
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    const Projection& P = capture.views[i].trueProjection;
    Rows rows;
    for (int r = 0; r < 2; ++r)
    {
      rows.row(r) = (P.block<1, 3>(r, 0) - P(r, 3) / P(2, 3) * P.block<1, 3>(2, 0)) / P(2, 3);
    }
    derivatives.push_back(rows);
    normal += rows.transpose() * rows;
    right += rows.transpose() * shifts[i];
  }
  const Vector3 translation = normal.ldlt().solve(right);
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    shifts[i] -= derivatives[i] * translation;
  }
  return shifts;
}

} // namespace

TEST(FieldAlignment, UnderCameraNoiseTheViewsAreShiftedBack)
{
  Execution execution;
  for (const SyntheticShape shape : { SyntheticShape::Sphere, SyntheticShape::Torus })
  {
    for (const std::uint64_t seed : { 1, 2 })
    {
      Capture& capture = captureOf(shape);
      capture.draw(0, 1.0, seed);
      const Corrected noisy(capture);
      const std::string what = "shape " + std::to_string(int(shape)) + " seed " + std::to_string(seed);
      ASSERT_TRUE(noisy.correction.field) << what;
      const Mesh mesh = noisy.correction.field->contourMesh(execution);
      const double before = errorOf(noisy.exact, capture.cleanHull(), noisy.lattice);
      const double after = errorOf(mesh, capture.cleanHull(), noisy.lattice);
      EXPECT_LT(after, 0.75 * before) << what;
      EXPECT_LT(noisy.correction.remainingDeficit, 0.5 * noisy.correction.deficit) << what;

      // Seen from the corrected surface the views lie where the noise has put them, but for a common translation.
      const auto applied = capture.applied();
      const double length = meanLength(withoutTranslation(applied, capture.views()));
      FieldViews fieldViews(noisy.views, noisy.lattice, 5.0);
      std::vector<int> all(applied.size());
      std::iota(all.begin(), all.end(), 0);
      fieldViews.observe(all, execution);
      const auto residuals = contourResiduals(fieldViews, mesh, all, 3.0, execution);
      std::vector<Vector2> difference;
      for (const int view : all)
      {
        difference.push_back(applied[view] + residuals[view].shift);
      }
      EXPECT_GT(length, 0.7) << what;
      EXPECT_LT(meanLength(withoutTranslation(difference, capture.views())), 0.5 * length) << what;
      EXPECT_NEAR(noisy.correction.alignment, meanLength(applied), 0.35 * length) << what;
    }
  }
}

TEST(FieldAlignment, ASurfaceThatIsMovedAsAWholeShiftsNoView)
{
  Execution execution;
  captureOf(SyntheticShape::Torus).draw(3.0, 0.0, 4);
  Corrected noisy(captureOf(SyntheticShape::Torus));
  ASSERT_TRUE(noisy.correction.field.has_value());
  FieldCorrectionOptions options;
  options.shiftNoise = 1e9; // the contours are noisy, not the cameras wrong
  const FieldCorrection unmoved = noisy.correct(options, execution);
  EXPECT_GT(unmoved.alignment, 0.1);
  const double octants = 0.6;
  for (Vector3& p : noisy.exact.points)
  {
    p += octants * noisy.lattice.leafEdge() * Vector3(0.6, 0.0, 0.8);
  }
  const FieldCorrection moved = noisy.correct(options, execution);
  ASSERT_TRUE(moved.field.has_value());
  const double pixels = FieldViews(noisy.views, noisy.lattice, 4.0).pixelsPerOctant(0);
  EXPECT_GT(moved.shift, unmoved.shift + 0.2 * octants); // the views see it
  EXPECT_LT(moved.alignment, unmoved.alignment + 0.15 * octants * pixels);
  EXPECT_EQ(noisy.correct({}, execution).alignment, 0.0); // nor does it make them seem wrong
}

TEST(FieldAlignment, ViewsAreShiftedForWrongCamerasNotForNoisyContours)
{
  Execution execution;
  FieldCorrectionOptions always, never;
  always.shiftNoise = 1e9;
  never.alignViews = false;
  for (const SyntheticShape shape : { SyntheticShape::Sphere, SyntheticShape::Torus })
  {
    Capture& capture = captureOf(shape);
    for (const bool few : { false, true }) // too few thirds to be judged by alone
    {
      const auto correctionOf = [&](double contour, double camera, const FieldCorrectionOptions& options)
      {
        capture.draw(contour, camera, 3);
        return Corrected(few ? capture.preparedHalf() : capture.prepared(), options);
      };
      const std::string what = "shape " + std::to_string(int(shape)) + (few ? ", few views" : "");
      const Corrected noisy = correctionOf(1.2, 0.0, {});
      ASSERT_TRUE(noisy.correction.field) << what;
      EXPECT_EQ(noisy.correction.alignment, 0.0) << what;
      EXPECT_EQ(noisy.correction.remainingDeficit, noisy.correction.deficit) << what;
      EXPECT_EQ(noisy.correction.field->values(), noisy.correct(never, execution).field->values()) << what;
      EXPECT_GT(noisy.correct(always, execution).alignment, 0.05) << what;
      const Corrected wrong = correctionOf(0.0, 1.0, {});
      ASSERT_TRUE(wrong.correction.field) << what;
      EXPECT_GT(wrong.correction.alignment, 0.5) << what;
      EXPECT_EQ(wrong.correction.field->values(), wrong.correct(always, execution).field->values()) << what;
    }
  }
}

TEST(FieldAlignment, ASecondRoundOfShiftsComesCloser)
{
  Execution execution;
  for (const SyntheticShape shape : { SyntheticShape::Sphere, SyntheticShape::Torus })
  {
    Capture& capture = captureOf(shape);
    capture.draw(0.0, 1.5, 2);
    const Corrected wrong(capture);
    double last = errorOf(wrong.exact, capture.cleanHull(), wrong.lattice);
    for (const int rounds : { 1, 2 })
    {
      FieldCorrectionOptions options;
      options.alignments = rounds;
      const auto correction = wrong.correct(options, execution);
      ASSERT_TRUE(correction.field);
      const double error = errorOf(correction.field->contourMesh(execution), capture.cleanHull(), wrong.lattice);
      EXPECT_LT(error, (rounds == 1 ? 0.75 : 0.98) * last) << "shape " << int(shape) << ", rounds " << rounds;
      last = error;
    }
  }
}
