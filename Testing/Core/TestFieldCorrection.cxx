// SPDX-License-Identifier: BSD-3-Clause
#include "FieldCorrection.h"

#include "BrickTestFields.h"
#include "FieldCorrectionScene.h"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Stops at the given question for it. */
class CancelledAt : public Execution
{
public:
  explicit CancelledAt(int calls)
    : Left(calls)
  {
  }
  bool cancelled() const override { return --this->Left < 0; }
  mutable int Left;
};

} // namespace

TEST(FieldCorrection, CleanSilhouettesAreTakenAsTheyAre)
{
  for (const SyntheticShape shape : { SyntheticShape::Sphere, SyntheticShape::Torus })
  {
    captureOf(shape).draw(0, 0, 1);
    const Corrected clean(captureOf(shape));
    EXPECT_FALSE(clean.correction.field) << int(shape);
    EXPECT_GE(clean.correction.deficit, 0.0);
    EXPECT_LE(clean.correction.deficit, FieldCorrectionOptions().smallestDeficit) << int(shape);
    EXPECT_EQ(clean.correction.alignment, 0.0);
    FieldCorrectionOptions always;
    EXPECT_LE(clean.correction.shift, FieldCorrectionOptions().smallestShift) << int(shape);
    always.smallestDeficit = always.smallestShift = 0.0;
    Execution execution;
    const bool any = clean.correction.deficit > 0.0 || clean.correction.shift > 0.0;
    EXPECT_EQ(clean.correct(always, execution).field.has_value(), any);
  }
}

TEST(FieldCorrection, UnderContourNoiseTheFieldIsNearerToTheCleanHull)
{
  Execution execution;
  for (const SyntheticShape shape : { SyntheticShape::Sphere, SyntheticShape::Torus })
  {
    for (const std::uint64_t seed : { 1, 2 })
    {
      Capture& capture = captureOf(shape);
      capture.draw(1.2, 0, seed);
      const Corrected noisy(capture);
      const std::string what = "shape " + std::to_string(int(shape)) + " seed " + std::to_string(seed);
      ASSERT_TRUE(noisy.correction.field) << what;
      const Mesh mesh = noisy.correction.field->contourMesh(execution);
      if (seed == 1)
      {
        EXPECT_EQ(assessMesh(mesh, execution).openEdges, 0u) << what;
      }
      const double before = errorOf(noisy.exact, capture.cleanHull(), noisy.lattice);
      const double after = errorOf(mesh, capture.cleanHull(), noisy.lattice);
      EXPECT_GT(before, 0.1) << what;
      EXPECT_LT(after, 0.75 * before) << what;
      EXPECT_GT(noisy.correction.deficit, FieldCorrectionOptions().smallestDeficit) << what;
    }
  }
}

TEST(FieldCorrection, SmoothingIsNoWiderThanTheLattice)
{
  Execution execution;
  captureOf(SyntheticShape::Sphere).draw(3.0, 0.0, 4);
  const Corrected noisy(captureOf(SyntheticShape::Sphere));
  FieldCorrectionOptions options;
  options.smoothing = options.greatestSmoothing = std::numeric_limits<double>::infinity();
  const FieldCorrection widest = noisy.correct(options, execution);
  ASSERT_TRUE(widest.field.has_value());
  for (const float value : widest.field->values())
  {
    ASSERT_TRUE(std::isfinite(value));
  }
  EXPECT_NE(widest.field->values(), noisy.correction.field->values());
}

TEST(FieldCorrection, EachPartDoesWhatItSaysAlone)
{
  captureOf(SyntheticShape::Torus).draw(1.2, 1.0, 4);
  Corrected noisy(captureOf(SyntheticShape::Torus));
  const FieldCorrection& both = noisy.correction;
  ASSERT_TRUE(both.field);
  Execution execution;
  FieldCorrectionOptions options;
  options.alignViews = options.moveSurface = false;
  const auto none = noisy.correct(options, execution);
  EXPECT_FALSE(none.field);
  EXPECT_EQ(none.alignment, 0.0);

  options.moveSurface = true;
  const auto moved = noisy.correct(options, execution);
  ASSERT_TRUE(moved.field);
  EXPECT_EQ(moved.alignment, 0.0);
  EXPECT_EQ(moved.deficit, both.deficit);
  EXPECT_EQ(moved.remainingDeficit, moved.deficit);

  options.moveSurface = false;
  options.alignViews = true;
  const auto aligned = noisy.correct(options, execution);
  ASSERT_TRUE(aligned.field);
  EXPECT_EQ(aligned.alignment, both.alignment);
  EXPECT_GT(aligned.alignment, 0.3);
  EXPECT_EQ(aligned.remainingDeficit, both.remainingDeficit);
  EXPECT_LT(aligned.remainingDeficit, aligned.deficit);
  // The shifts alone leave the noise's bias: the hull stays too small.
  const double hull = assessMesh(captureOf(SyntheticShape::Torus).cleanHull(), execution).volume;
  const double least = assessMesh(aligned.field->contourMesh(execution), execution).volume;
  const double corrected = assessMesh(both.field->contourMesh(execution), execution).volume;
  EXPECT_GT(least, assessMesh(noisy.exact, execution).volume);
  EXPECT_LT(least, 0.98 * hull);
  EXPECT_LT(std::abs(corrected - hull), 0.5 * std::abs(least - hull));

  options = {};
  for (const auto& [deficit, shift, corrects] :
    { std::tuple(1.001, 1.001, false), std::tuple(0.999, 1.001, true), std::tuple(1.001, 0.999, true),
      std::tuple(2.002, 0.999, false) })
  {
    options.smallestDeficit = deficit * both.deficit;
    options.smallestShift = shift * both.shift;
    EXPECT_EQ(noisy.correct(options, execution).field.has_value(), corrects) << deficit << " " << shift;
  }
  EXPECT_FALSE(correctField(Mesh(), noisy.lattice, noisy.views, {}, {}, 0, execution).field);
}

TEST(FieldCorrection, TheHullIsTheBaseOfNearConvexModelsAlone)
{
  Execution execution;
  FieldCorrectionOptions without;
  without.hullConvexity = 1.0;
  Capture& sphere = captureOf(SyntheticShape::Sphere);
  sphere.draw(1.2, 0, 1);
  const Corrected convex(sphere), smoothed(sphere, without);
  ASSERT_TRUE(convex.correction.field && smoothed.correction.field);
  EXPECT_TRUE(convex.correction.hull.applied);
  EXPECT_GT(convex.correction.hull.convexity, 0.98);
  EXPECT_FALSE(smoothed.correction.hull.applied);
  EXPECT_LT(errorOf(convex.correction.field->contourMesh(execution), sphere.cleanHull(), convex.lattice),
    0.97 * errorOf(smoothed.correction.field->contourMesh(execution), sphere.cleanHull(), convex.lattice));

  Capture& torus = captureOf(SyntheticShape::Torus);
  torus.draw(1.2, 0, 1);
  const Corrected concave(torus), same(torus, without);
  ASSERT_TRUE(concave.correction.field);
  EXPECT_FALSE(concave.correction.hull.applied);
  EXPECT_GT(concave.correction.hull.convexity, 0.5);
  EXPECT_LT(concave.correction.hull.convexity, 0.86);
  EXPECT_EQ(concave.correction.field->values(), same.correction.field->values());
}

/** The jug's handle is two octants thick here, the noise a third of one: the second-least distance leaves crumbs of it. */
TEST(FieldCorrection, ViewsThatMayDissentFromTheModelLeaveMoreOfAThinHandle)
{
  static Capture jug(SyntheticShape::Jug);
  const auto handlePoints = [](const Corrected& corrected)
  {
    int count = 0;
    const BrickField& field = *corrected.correction.field;
    for (std::size_t n = 0; n < field.size(); ++n)
    {
      const Eigen::Vector3d p = corrected.lattice.position(fromMorton(field.code(n)));
      count += p[0] < -0.6 && p[2] > 0.1 && field.values()[n] > 0.0f;
    }
    return count;
  };
  int with = 0, without = 0;
  for (int n = 0; n < 6; ++n)
  {
    jug.draw(n % 2 == 0 ? 1.2 : 1.6, 0, 1 + n / 2);
    FieldCorrectionOptions second;
    second.modelDissent = 0.0;
    const Corrected corrected(jug), before(jug, second);
    ASSERT_TRUE(corrected.correction.field && before.correction.field);
    with += handlePoints(corrected);
    without += handlePoints(before);
  }
  EXPECT_GT(with, 1.5 * without);
  FieldCorrectionOptions same;
  same.modelDissent = 2.0 / 24.0;
  FieldCorrectionOptions none;
  none.modelDissent = 0.0;
  EXPECT_EQ(Corrected(jug, same).correction.field->values(), Corrected(jug, none).correction.field->values())
    << "the second-least is the least that counts";
}

/** Of 24 views the third-least distance counts at depth 7, but the second-least at depth 8, where fewer compete. */
TEST(FieldCorrection, FewerViewsMayDissentWhereOctantsAreSmaller)
{
  Capture& capture = captureOf(SyntheticShape::Sphere);
  capture.draw(0.8, 0, 1);
  FieldCorrectionOptions third, second;
  third.alignViews = second.alignViews = false; // for time's sake
  second.modelDissent = 0.0;
  for (const int depth : { 7, 8 })
  {
    const Corrected corrected(capture, third, depth), before(capture, second, depth);
    ASSERT_TRUE(corrected.correction.field && before.correction.field);
    EXPECT_EQ(corrected.correction.field->values() == before.correction.field->values(), depth == 8) << depth;
  }
}

/** Where smoothing is wide the field comes from a coarser lattice: that of depth 7, whose octants are twice as large. */
TEST(FieldCorrection, StrongNoiseIsCorrectedOnACoarserLattice)
{
  Capture& capture = captureOf(SyntheticShape::Torus);
  capture.draw(1.4, 0, 1);
  FieldCorrectionOptions second;
  second.alignViews = false; // for time's sake
  second.modelDissent = 0.0; // the second-least at both depths
  const Corrected corrected(capture, second, 7);
  ASSERT_GT(corrected.correction.deficit, 0.3);
  Execution execution;
  const auto finer = correctField(corrected.exact, { corrected.lattice.root, 8 }, corrected.views, second, {}, 0, execution);
  ASSERT_TRUE(corrected.correction.field && finer.field);
  EXPECT_NEAR(finer.deficit, 2.0 * corrected.correction.deficit, 0.02);
  EXPECT_EQ(finer.field->lattice().depth, 8);
  EXPECT_EQ(finer.hull.convexity > 0.0, corrected.correction.hull.convexity > 0.0);
  int compared = 0, near = 0;
  for (std::size_t n = 0; n < corrected.correction.field->size(); ++n)
  {
    const float value = corrected.correction.field->values()[n];
    const std::ptrdiff_t at = finer.field->find(corrected.correction.field->code(n) << 3);
    if (std::abs(value) < 1.0f && at >= 0)
    {
      ++compared;
      near += std::abs(finer.field->values()[std::size_t(at)] - 2.0f * value) < 0.2f;
    }
  }
  EXPECT_GT(compared, 20000);
  EXPECT_GT(near, 0.95 * compared); // what is thin, and counts for no deficit, is half as thick
}

TEST(FieldCorrection, ASurfaceThatViewsMayDissentFromIsNotPulledBack)
{
  Execution execution;
  Capture& capture = captureOf(SyntheticShape::Torus);
  capture.draw(0.5, 0, 1);
  const Corrected strict(capture);
  EXPECT_TRUE(strict.correction.field);
  VotingOptions voting;
  voting.share = 1.0 - 3.0 / strict.views.size();
  const Octree octree = carveViews(strict.views, unitCube(1.05), Depth, 3);
  const Mesh tolerant = votingMarchingCubes(octree, strict.views, voting, execution).mesh;
  const FieldCorrection correction = correctField(tolerant, octree.lattice, strict.views, {}, {}, 0, execution);
  EXPECT_GT(correction.shift, FieldCorrectionOptions().smallestShift);
  EXPECT_FALSE(correction.field) << correction.deficit;
}

TEST(FieldCorrection, TheLatticesBorderStaysOutside)
{
  Execution execution;
  captureOf(SyntheticShape::Sphere).draw(1.2, 0, 2);
  const PreparedViews views = captureOf(SyntheticShape::Sphere).prepared();
  const Octree octree = carveViews(views, { Vector3(-0.5, -0.4, -0.3), 1.6 }, 4);
  const Mesh exact = votingMarchingCubes(octree, views, {}, execution).mesh;
  const auto correction = correctField(exact, octree.lattice, views, {}, {}, 0, execution);
  ASSERT_TRUE(correction.field);
  int border = 0;
  for (std::size_t n = 0; n < correction.field->size(); ++n)
  {
    if (octree.lattice.onBorder(fromMorton(correction.field->code(n))))
    {
      ++border;
      EXPECT_LT(correction.field->values()[n], 0.0f);
    }
  }
  EXPECT_GT(border, 500);
}

/** Where cameras are wrong the corrected field leaves survivors outside; raised, a few of them, whether or not it comes from a coarser lattice. */
TEST(FieldCorrection, TheFieldIsRaisedToTheSurvivorsFromTheViewsAsTheirCamerasSay)
{
  Execution execution;
  Capture& capture = captureOf(SyntheticShape::Torus);
  for (const auto& [camera, depth] : { std::pair(1.5, 6), std::pair(1.5, 7) })
  {
    capture.draw(0, camera, 3);
    const Corrected corrected(capture, {}, depth);
    ASSERT_TRUE(corrected.correction.field);
    ASSERT_GT(corrected.correction.alignment, 0.3);
    const auto lost = [&](const BrickField& field) { return cellsOutside(field, corrected.survivors).size(); };
    const auto raised =
      correctField(corrected.exact, corrected.lattice, corrected.views, {}, corrected.survivors, 0, execution);
    FieldCorrectionOptions none;
    none.raiseWidth = 0.0;
    const auto same = correctField(corrected.exact, corrected.lattice, corrected.views, none, corrected.survivors, 0, execution);
    ASSERT_TRUE(raised.field && same.field);
    EXPECT_EQ(same.field->values(), corrected.correction.field->values());
    ASSERT_EQ(raised.field->bricks(), same.field->bricks());
    for (std::size_t n = 0; n < raised.field->size(); ++n)
    {
      EXPECT_GE(raised.field->values()[n], same.field->values()[n]);
    }
    EXPECT_GT(lost(*same.field), 50u) << depth;
    EXPECT_LT(double(lost(*raised.field)), 0.7 * double(lost(*same.field))) << depth;
  }
}

TEST(FieldCorrection, OptionsOutOfRangeAreErrorsThatNameTheValue)
{
  captureOf(SyntheticShape::Sphere).draw(0, 0, 1);
  const Corrected clean(captureOf(SyntheticShape::Sphere));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Execution execution;
  using Options = FieldCorrectionOptions;
  const auto expectError = [&](const Options& options, const std::string& value)
  {
    try
    {
      clean.correct(options, execution);
      ADD_FAILURE() << value << " was accepted";
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(value), std::string::npos) << error.what();
    }
  };
  for (const auto member : { &Options::smallestDeficit, &Options::smallestShift, &Options::hullConvexity,
         &Options::modelDissent, &Options::smoothing, &Options::greatestSmoothing,
         &Options::gentleness, &Options::shiftNoise, &Options::contourReach, &Options::raiseWidth })
  {
    Options options;
    options.*member = -1.5;
    const bool isShare = member == &Options::modelDissent, isWidth = member == &Options::raiseWidth;
    expectError(options, isShare ? " -1.5 is outside 0 to 1" : isWidth ? " -1.5 is outside 0 to 8"
        : member == &Options::contourReach                             ? " -1.5: above 0 is needed"
                                                                       : " -1.5: at least 0 is needed");
    options.*member = nan;
    expectError(options, "nan");
    options.*member = 0.0;
    if (member == &Options::contourReach)
    {
      expectError(options, "contour reach 0: above 0 is needed");
    }
    else
    {
      EXPECT_NO_THROW(clean.correct(options, execution));
    }
  }
  Options options;
  options.raiseWidth = 8.5;
  expectError(options, "raise width 8.5 is outside 0 to 8");
  options = {};
  options.modelDissent = 1.25;
  expectError(options, "1.25");
  options = {};
  options.alignments = 0;
  expectError(options, "alignments 0 is outside 1 to 100");
  options.alignments = 101;
  expectError(options, "alignments 101 is outside 1 to 100");
  options.alignments = -3;
  expectError(options, "-3");
}

TEST(FieldCorrection, CanBeCancelledAtAnyTimeAndTellsItsProgress)
{
  captureOf(SyntheticShape::Torus).draw(1.2, 1.0, 5);
  const Corrected noisy(captureOf(SyntheticShape::Torus));
  CancelledAt never(1000000);
  noisy.correct({}, never);
  const int questions = 1000000 - never.Left;
  EXPECT_GE(questions, 6);
  for (int calls = 0; calls < questions; calls += 4)
  {
    CancelledAt cancelled(calls);
    EXPECT_THROW(noisy.correct({}, cancelled), Cancelled) << calls;
  }
  ProgressExecution progress;
  noisy.correct({}, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}

TEST(FieldCorrection, SameBytesForAnyNumberOfThreads)
{
  captureOf(SyntheticShape::Torus).draw(1.2, 1.0, 6);
  const Corrected noisy(captureOf(SyntheticShape::Torus));
  ASSERT_TRUE(noisy.correction.field);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = noisy.correct({}, execution);
    ASSERT_TRUE(many.field);
    EXPECT_EQ(many.field->bricks(), noisy.correction.field->bricks());
    EXPECT_EQ(many.field->values(), noisy.correction.field->values());
    EXPECT_EQ(many.deficit, noisy.correction.deficit);
    EXPECT_EQ(many.remainingDeficit, noisy.correction.remainingDeficit);
    EXPECT_EQ(many.alignment, noisy.correction.alignment);
  }
}

/**
 * At depth 8 the lattice is coarser, with 128 cells a side, from a sigma of 1.4 octants on where contours alone are noisy and from 6 on where cameras may be wrong; with less or more
 * it is the same for both. So it is at depth 7 for any sigma that there is: a lattice of 64 cells would ask for 3.8 octants.
 */
TEST(FieldCorrection, OnACoarserLatticeEarlierWhereNoCameraIsWrong)
{
  Execution execution;
  Capture& capture = captureOf(SyntheticShape::Torus);
  FieldCorrectionOptions chance, cameras;
  chance.alignViews = cameras.alignViews = false;
  chance.shiftNoise = 0.0;
  cameras.shiftNoise = 1e9;
  int between = 0, wide = 0, others = 0;
  for (const double noise : { 0.4, 0.8, 1.2, 2.0 })
  {
    for (const int depth : { 7, 8 })
    {
      capture.draw(noise, 0, 5);
      const Corrected one(capture, chance, depth);
      const FieldCorrection other = one.correct(cameras, execution);
      ASSERT_TRUE(one.correction.field && other.field);
      EXPECT_EQ(one.correction.deficit, other.deficit);
      const double sigma = std::min(chance.greatestSmoothing * one.lattice.cells() / 128.0, chance.smoothing * other.deficit);
      const bool isBetween = depth == 8 && sigma >= 1.4 && sigma < 6.0;
      EXPECT_EQ(one.correction.field->values() != other.field->values(), isBetween) << noise << " px, depth " << depth << ", sigma " << sigma;
      between += isBetween;
      wide += depth == 7 && sigma >= 1.4;
      others += depth == 8 && !isBetween;
    }
  }
  EXPECT_GT(between, 0);
  EXPECT_GT(wide, 0);
  EXPECT_GT(others, 0);
}
