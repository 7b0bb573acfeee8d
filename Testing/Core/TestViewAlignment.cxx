// SPDX-License-Identifier: BSD-3-Clause
#include "ViewAlignment.h"

#include "CarvingTestCaptures.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 256;
constexpr int Views = 12;
constexpr double Limit = 3.0; // octants

Mesh coarse(SyntheticShape shape)
{
  SyntheticShapeOptions options;
  options.refinement = 0.5;
  return syntheticShape(shape, options);
}

/** A mesh's clean silhouettes, their projections' principal points then shifted. */
PreparedViews shiftedViews(const Mesh& mesh, const std::vector<Vector2>& shifts)
{
  auto views = viewsOf(mesh, syntheticCameras(mesh, Views, Size, Size), Size);
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
    shift.col(2).head<2>() = shifts[i];
    views[i].projection = shift * views[i].projection;
  }
  return prepareViews(views);
}

std::vector<int> all()
{
  std::vector<int> views(Views);
  std::iota(views.begin(), views.end(), 0);
  return views;
}

std::vector<ContourResidual> residualsOf(const PreparedViews& views, const Mesh& surface, Execution& execution)
{
  FieldViews fieldViews(views, { unitCube(1.05), 6 }, 5.0);
  fieldViews.observe(all(), execution);
  return contourResiduals(fieldViews, surface, all(), Limit, execution);
}

std::vector<Vector2> randomShifts(std::uint64_t seed, double most)
{
  Random random(seed);
  std::vector<Vector2> shifts;
  for (int i = 0; i < Views; ++i)
  {
    const double u = random.uniform(-most, most);
    shifts.emplace_back(u, random.uniform(-most, most));
  }
  return shifts;
}

} // namespace

TEST(ViewAlignment, TheTrueSurfaceTellsEachViewsShift)
{
  Execution execution;
  for (const SyntheticShape shape : { SyntheticShape::Jug, SyntheticShape::Torus })
  {
    const Mesh mesh = coarse(shape);
    for (const double most : { 0.0, 0.7, 2.5 })
    {
      const auto shifts = randomShifts(std::uint64_t(shape) + 1, most);
      const auto residuals = residualsOf(shiftedViews(mesh, shifts), mesh, execution);
      ASSERT_EQ(residuals.size(), shifts.size());
      for (int view = 0; view < Views; ++view)
      {
        EXPECT_GT(residuals[view].count, 200u);
        // The distance of what lies askew is less than the shift: a large one is found in rounds.
        EXPECT_LT((residuals[view].shift + shifts[view]).norm(), 0.06 + 0.16 * shifts[view].norm())
          << "shape " << int(shape) << " view " << view << ": " << residuals[view].shift.transpose() << " for "
          << shifts[view].transpose();
        EXPECT_NEAR(residuals[view].mean, 0.0, 0.02 + 0.005 * most) << "shape " << int(shape) << " view " << view;
      }
      EXPECT_NEAR(typicalResidual(residuals), 0.0, 0.05);
    }
    const auto shifts = randomShifts(7, 2.5);
    const PreparedViews views = shiftedViews(mesh, shifts);
    FieldViews fieldViews(views, { unitCube(1.05), 6 }, 5.0);
    fieldViews.observe(all(), execution);
    for (int round = 0; round < 2; ++round)
    {
      const auto residuals = contourResiduals(fieldViews, mesh, all(), Limit, execution);
      for (int view = 0; view < Views; ++view)
      {
        fieldViews.addShift(view, residuals[view].shift);
      }
    }
    for (int view = 0; view < Views; ++view)
    {
      EXPECT_LT((fieldViews.shift(view) + shifts[view]).norm(), 0.2) << "shape " << int(shape) << " view " << view;
    }
  }
}

TEST(ViewAlignment, ASurfaceThatIsTooSmallOrTooLargeIsNotShifted)
{
  Execution execution;
  const Mesh truth = torusMesh(64, 32, 0.6, 0.25);
  const PreparedViews views = shiftedViews(truth, {});
  const double leaf = 2.1 / 64;
  const double pixels = FieldViews(views, { unitCube(1.05), 6 }, 5.0).pixelsPerOctant(0);
  for (const double octants : { -1.5, -0.6, 0.6, 1.5 })
  {
    const Mesh mesh = torusMesh(64, 32, 0.6, 0.25 + octants * leaf);
    const auto residuals = residualsOf(views, mesh, execution);
    for (const auto& residual : residuals)
    {
      EXPECT_GT(residual.count, 200u);
      EXPECT_LT(residual.mean * octants, 0.0) << octants; // outside what is too small, inside what is too large
      EXPECT_NEAR(residual.mean, -octants, 0.3 * std::abs(octants));
      EXPECT_LT(residual.shift.norm(), 0.2 * std::abs(octants) * pixels);
    }
    EXPECT_NEAR(typicalResidual(residuals), -octants, 0.2 * std::abs(octants));
  }
}

TEST(ViewAlignment, NothingIsSaidOfWhatIsThinOrFarAway)
{
  Execution execution;
  const Mesh twig = coarse(SyntheticShape::Twig);
  const auto thin = residualsOf(shiftedViews(twig, randomShifts(3, 1.0)), twig, execution);
  for (const auto& residual : thin)
  {
    EXPECT_EQ(residual.count, 0u);
    EXPECT_EQ(residual.mean, 0.0);
    EXPECT_EQ(residual.shift, Vector2(0.0, 0.0));
  }
  EXPECT_EQ(typicalResidual(thin), 0.0);

  const PreparedViews views = shiftedViews(torusMesh(64, 32, 0.6, 0.25), {});
  Mesh small = sphereMesh(4, 0.2); // in the torus's hole and nowhere near its contour
  for (const auto& residual : residualsOf(views, small, execution))
  {
    EXPECT_LT(residual.count, 200u);
  }
  for (Vector3& p : small.points)
  {
    p += Vector3(0.0, 0.0, 50.0); // out of every view
  }
  for (const auto& residual : residualsOf(views, small, execution))
  {
    EXPECT_EQ(residual.count, 0u);
  }
}

TEST(ViewAlignment, WhatAMoveOfTheObjectDoesToTheViewsIsTakenFromTheirShifts)
{
  const Mesh mesh = coarse(SyntheticShape::Jug);
  const PreparedViews views = shiftedViews(mesh, {});
  const FieldViews fieldViews(views, { unitCube(1.05), 6 }, 5.0);
  // The pixels of a move, by projecting the lattice's middle and its neighbours.
  const auto movedBy = [&](int view, const Vector3& octants)
  {
    const auto at = [&](int i, int j, int k) { return fieldViews.place(view, { 32 + i, 32 + j, 32 + k }); };
    const auto step = [&](const FieldViews::Place& to, const FieldViews::Place& from)
    { return Vector2(0.5 * (to.u - from.u), 0.5 * (to.v - from.v)); };
    return Vector2(octants[0] * step(at(1, 0, 0), at(-1, 0, 0)) + octants[1] * step(at(0, 1, 0), at(0, -1, 0)) +
      octants[2] * step(at(0, 0, 1), at(0, 0, -1)));
  };
  const Vector3 move(0.4, -0.7, 0.2);
  const auto own = randomShifts(5, 1.0);
  std::vector<ContourResidual> residuals(Views), kept(Views);
  for (int view = 0; view < Views; ++view)
  {
    kept[view] = { 100, 0.1, own[view] };
    residuals[view] = { 100, 0.1, own[view] + movedBy(view, move) };
  }
  residuals[3].count = kept[3].count = 0; // says nothing
  const Vector2 silent = residuals[3].shift;
  const Vector3 inKept = removeCommonShift(fieldViews, all(), kept);
  const Vector3 found = removeCommonShift(fieldViews, all(), residuals);
  EXPECT_LT((found - inKept - move).norm(), 1e-3) << found.transpose();
  EXPECT_GT(inKept.norm(), 0.01); // random shifts have a common part as well
  EXPECT_EQ(residuals[3].shift, silent);
  EXPECT_EQ(kept[3].shift, own[3]);
  residuals[3] = kept[3];
  for (int view = 0; view < Views; ++view)
  {
    EXPECT_LT((residuals[view].shift - kept[view].shift).norm(), 2e-3) << view;
    EXPECT_EQ(residuals[view].mean, 0.1);
  }
  const Vector3 again = removeCommonShift(fieldViews, all(), residuals); // nothing is left of it
  EXPECT_LT(again.norm(), 1e-12);
}

TEST(ViewAlignment, OneViewTellsNoMoveOfTheObject)
{
  const PreparedViews views = shiftedViews(torusMesh(24, 12, 0.6, 0.25), {});
  const FieldViews fieldViews(views, { unitCube(1.05), 6 }, 5.0);
  std::vector<ContourResidual> residuals{ { 100, 0.0, Vector2(1.0, 2.0) } };
  EXPECT_EQ(removeCommonShift(fieldViews, { 4 }, residuals), Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(residuals[0].shift, Vector2(1.0, 2.0));
  residuals.assign(Views, { 0, 0.0, Vector2(1.0, 2.0) });
  EXPECT_EQ(removeCommonShift(fieldViews, all(), residuals), Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(residuals[5].shift, Vector2(1.0, 2.0));
}

TEST(ViewAlignment, ChanceIsToldFromWhatNoiseDoesToTheShifts)
{
  Execution execution;
  for (const SyntheticShape shape : { SyntheticShape::Sphere, SyntheticShape::Jug, SyntheticShape::Torus })
  {
    const Mesh mesh = coarse(shape);
    SyntheticCaptureOptions options;
    options.photographs = false;
    options.views = Views;
    options.width = options.height = Size;
    SyntheticCapture capture = synthesizeCapture(mesh, options, execution);
    const auto residualsFor = [&](double contour, double camera, std::uint64_t seed)
    {
      options.noiseContour = contour;
      options.noiseCamera = camera;
      options.seed = seed;
      redrawNoise(capture, mesh, options, execution);
      std::vector<View> views;
      for (const auto& view : capture.views)
      {
        views.push_back({ view.name, view.projection, view.mask });
      }
      return residualsOf(prepareViews(views), mesh, execution);
    };
    double noise = 0.0, squares = 0.0;
    for (const std::uint64_t seed : { 1, 2, 3, 4, 5, 6 })
    {
      for (const ContourResidual& residual : residualsFor(1.0, 0.0, seed))
      {
        ASSERT_GT(residual.noise, 0.0);
        noise += residual.noise;
        squares += residual.shift.squaredNorm();
      }
      EXPECT_GT(noiseShare(residualsFor(1.0, 0.0, seed)), 0.3) << "shape " << int(shape) << " seed " << seed;
      EXPECT_LT(noiseShare(residualsFor(0.0, 1.0, seed)), 0.05) << "shape " << int(shape) << " seed " << seed;
    }
    EXPECT_GT(noise, 0.6 * squares) << "shape " << int(shape);
    EXPECT_LT(noise, 1.5 * squares) << "shape " << int(shape);
  }
}

TEST(ViewAlignment, TheNoisesShareIsOfWhatIsLeftWithoutACommonShift)
{
  EXPECT_EQ(noiseShare({}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(noiseShare({ { 10, 0.0, Vector2::Zero(), 1.0 } }), std::numeric_limits<double>::infinity());
  const ContourResidual silent{ 0, 0.0, Vector2(9.0, 9.0), 50.0 };
  EXPECT_DOUBLE_EQ(noiseShare({ { 10, 0.0, Vector2(1.0, 2.0), 2.0 }, silent }), 2.0 / 5.0 / 2.0);
  // Six numbers less the three of a move.
  EXPECT_DOUBLE_EQ(noiseShare({ { 10, 0.0, Vector2(1.0, 0.0), 2.0 }, { 90, 0.0, Vector2(0.0, 2.0), 1.0 }, silent,
                     { 10, 0.0, Vector2(1.0, 1.0), 4.0 } }), 7.0 / 7.0 / 2.0);
}

TEST(ViewAlignment, TheTypicalResidualIsTheMeanByCount)
{
  EXPECT_EQ(typicalResidual({}), 0.0);
  EXPECT_EQ(typicalResidual({ { 0, 5.0, Vector2::Zero() } }), 0.0);
  EXPECT_DOUBLE_EQ(typicalResidual({ { 10, 1.0, Vector2::Zero() }, { 30, -0.5, Vector2::Zero() } }), -0.125);
}

TEST(ViewAlignment, SameForAnyNumberOfThreads)
{
  const Mesh mesh = torusMesh(48, 24, 0.6, 0.25);
  const PreparedViews views = shiftedViews(mesh, randomShifts(9, 2.0));
  Execution serial;
  const auto one = residualsOf(views, mesh, serial);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const auto many = residualsOf(views, mesh, execution);
    ASSERT_EQ(many.size(), one.size());
    for (int view = 0; view < Views; ++view)
    {
      EXPECT_EQ(many[view].count, one[view].count);
      EXPECT_EQ(many[view].mean, one[view].mean);
      EXPECT_EQ(many[view].shift, one[view].shift);
      EXPECT_EQ(many[view].noise, one[view].noise);
    }
  }
}
