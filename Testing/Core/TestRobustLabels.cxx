// SPDX-License-Identifier: BSD-3-Clause
#include "RobustLabels.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 200;
constexpr int Views = 20;

/** Views, their octree, its surface and its shell. */
struct Scene
{
  Scene(const std::vector<View>& captured, int depth)
    : views(prepareViews(captured))
    , octree(carveViews(this->views, unitCube(1.05), depth))
    , shell(makeCornerShell(leafCells(this->octree, OctantState::Intersection), this->execution))
    , surface(votingMarchingCubes(this->octree, this->views, {}, this->execution).mesh)
  {
  }
  CorrectedCapture correct() { return this->correct(this->execution); }
  CorrectedCapture correct(Execution& used) const
  {
    return correctCapture(this->surface, this->octree, this->shell, this->views, {}, used);
  }
  LatticeLabels labels(const CorrectedCapture& capture, const std::vector<std::uint64_t>& points = {})
  {
    return correctedLabels(this->octree, this->shell, points, this->views, capture, this->execution);
  }

  Execution execution;
  PreparedViews views;
  Octree octree;
  CornerShell shell;
  Mesh surface;
};

std::vector<View> captureOf(const Mesh& mesh)
{
  return viewsOf(mesh, swayingRing(Views, Size), Size);
}

Mesh torus()
{
  return torusMesh(48, 24, 0.65, 0.28);
}

/** Cut a disc of background where a point of the world falls. */
void cut(View& view, const Vector3& at, double radius)
{
  const Vector3 h = view.projection * at.homogeneous();
  BinaryImage& image = view.silhouette;
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      if (std::hypot(column - h[0] / h[2], row - h[1] / h[2]) <= radius)
      {
        image.at(column, row) = 0;
      }
    }
  }
}

/** Pixels beside the contour flip, as the eye of somebody who cuts masks by hand would. */
void roughen(std::vector<View>& views, std::uint64_t seed)
{
  Random random(seed);
  for (View& view : views)
  {
    const BinaryImage before = view.silhouette;
    for (int cuts = 0; cuts < 4000; ++cuts)
    {
      const int column = 2 + random.below(before.width - 4), row = 2 + random.below(before.height - 4);
      const int du = random.below(5) - 2, dv = random.below(5) - 2;
      view.silhouette.at(column, row) = before.at(column + du, row + dv);
    }
  }
}

std::vector<LatticePoint> allPoints(const Lattice& lattice, int past)
{
  std::vector<LatticePoint> points;
  const int n = lattice.cells() + past;
  for (int p = 0; p < n * n * n; ++p)
  {
    points.push_back({ p % n, p / n % n, p / n / n });
  }
  return points;
}

int insideCorners(const LatticeLabels& labels, const LatticePoint& cell)
{
  int inside = 0;
  for (int n = 0; n < 8; ++n)
  {
    inside += labels.insideAt(cell + cornerOffset(n));
  }
  return inside;
}

/** What has to hold of the labels whatever the capture: asked of every cell of the lattice. */
void expectPromise(const LatticeLabels& labels, const Octree& octree, const std::string& what, int mostIdle = 0)
{
  int lost = 0, unmarked = 0, wronglyMarked = 0, unheld = 0, idle = 0;
  for (const LatticePoint& cell : allPoints(octree.lattice, 0))
  {
    const auto at = labels.shell().findCell(cell);
    const auto location = octree.locate(cell);
    const bool last = location.generation == octree.lattice.depth;
    const bool survives = last && location.state == OctantState::Intersection;
    const bool kept = last && location.state == OctantState::Inside;
    const bool marked = at >= 0 && labels.isSurvivor(at);
    const int inside = insideCorners(labels, cell);
    const bool isWhole = labels.field() && inside == 8; // a field's shell has nothing to do there
    lost += survives && at < 0 && !isWhole;
    unmarked += ((survives && !isWhole) || (kept && inside == 0)) && !marked;
    idle += at >= 0 && isWhole;
    wronglyMarked += marked && !survives && !kept;
    unheld += inside > 0 && inside < 8 && at < 0;
  }
  EXPECT_EQ(lost, 0) << what;
  EXPECT_EQ(unmarked, 0) << what;
  EXPECT_EQ(wronglyMarked, 0) << what;
  EXPECT_EQ(unheld, 0) << what; // the surface passes nothing but the shell
  EXPECT_LE(idle, mostIdle) << what;
}

} // namespace

TEST(RobustLabels, CleanCapturesKeepTheLabelsOfTheVotes)
{
  Scene clean(captureOf(torus()), 5);
  const CorrectedCapture capture = clean.correct();
  EXPECT_FALSE(capture.repaired);
  EXPECT_FALSE(capture.recarved);
  EXPECT_FALSE(capture.surface);
  EXPECT_FALSE(capture.correction.field);
  EXPECT_EQ(capture.repairedPixels, 0u);
  const LatticeLabels expected(clean.octree, clean.shell, clean.views, clean.execution);
  const LatticeLabels labels = clean.labels(capture);
  EXPECT_EQ(labels.shell().cells, expected.shell().cells);
  EXPECT_EQ(labels.shell().corners, expected.shell().corners);
  EXPECT_EQ(labels.inside(), expected.inside());
  expectPromise(labels, clean.octree, "clean");

  // Further points, with the cells around them: in the middle of nothing, and deep inside.
  const std::vector<std::uint64_t> points{ mortonCode({ 2, 3, 29 }), mortonCode({ 16, 16, 16 }),
    mortonCode({ 6, 16, 16 }) };
  const LatticeLabels further = clean.labels(capture, points);
  EXPECT_EQ(further.shell().cells, extendedShell(clean.shell, points, clean.execution).cells);
  for (const LatticePoint& p : allPoints(clean.octree.lattice, 1))
  {
    EXPECT_EQ(further.insideAt(p), expected.insideAt(p));
  }
  expectPromise(further, clean.octree, "clean, further points");
}

TEST(RobustLabels, TheCornersOfATunnelAreInsideAgain)
{
  const Mesh mesh = sphereMesh(4, 0.9);
  Scene clean(captureOf(mesh), 5);
  auto captured = captureOf(mesh);
  cut(captured[3], Vector3(0.1, 0.1, 0.1), 9.0);
  cut(captured[8], Vector3(-0.2, 0.2, 0.1), 7.0);
  Scene noisy(captured, 5);
  const CorrectedCapture capture = noisy.correct();
  ASSERT_TRUE(capture.repaired);
  ASSERT_TRUE(capture.recarved);
  ASSERT_TRUE(capture.surface);
  EXPECT_GT(capture.repairedPixels, 300u);
  const LatticeLabels labels = noisy.labels(capture);
  const LatticeLabels before(noisy.octree, noisy.shell, noisy.views, noisy.execution);
  const LatticeLabels truth(clean.octree, clean.shell, clean.views, clean.execution);
  int tunnel = 0, open = 0, wrong = 0;
  for (const LatticePoint& p : allPoints(noisy.octree.lattice, 1))
  {
    const bool inTunnel = truth.insideAt(p) && !before.insideAt(p);
    tunnel += inTunnel;
    open += inTunnel && !labels.insideAt(p);
    wrong += labels.insideAt(p) != truth.insideAt(p);
  }
  EXPECT_GT(tunnel, 100);
  EXPECT_EQ(open, 0);
  EXPECT_EQ(wrong, 0);
  expectPromise(labels, noisy.octree, "tunnels");
}

TEST(RobustLabels, EverySurvivorIsMarkedWhateverTheNoise)
{
  int fields = 0, repairs = 0;
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    for (const int depth : { 3, 4 })
    {
      auto captured = captureOf(seed == 3 ? sphereMesh(3, 0.8) : torus());
      if (seed != 4)
      {
        roughen(captured, seed);
      }
      Random random(seed);
      if (seed == 2)
      {
        disturb(captured, 2, random);
      }
      if (seed >= 3)
      {
        cut(captured[5], Vector3(0.62, 0.05, 0.0), 8.0);
        cut(captured[11], Vector3(0.0, 0.3, 0.1), 8.0);
      }
      Scene noisy(captured, depth);
      const CorrectedCapture capture = noisy.correct();
      fields += capture.correction.field.has_value();
      repairs += capture.repaired.has_value();
      const LatticePoint middle{ 1 << (depth - 1), 1 << (depth - 1), 1 << (depth - 1) }, before{ middle.i - 2, middle.j, middle.k - 1 };
      const std::string what = "seed " + std::to_string(seed) + " depth " + std::to_string(depth);
      expectPromise(noisy.labels(capture), noisy.octree, what);
      const LatticeLabels further = noisy.labels(capture, { mortonCode(middle), mortonCode(before) }); // in no order
      expectPromise(further, noisy.octree, what + ", further points", 16);
      for (int n = 0; n < 8; ++n)
      {
        const LatticePoint o = cornerOffset(n);
        EXPECT_GE(further.shell().findCell({ middle.i - o.i, middle.j - o.j, middle.k - o.k }), 0) << what;
        EXPECT_GE(further.shell().findCell({ before.i - o.i, before.j - o.j, before.k - o.k }), 0) << what;
      }
    }
  }
  EXPECT_GE(fields, 3);
  EXPECT_GE(repairs, 1);
}

TEST(RobustLabels, AFieldsRegionWithoutASurvivorIsDropped)
{
  Scene clean(captureOf(sphereMesh(4, 0.55)), 5);
  const Lattice& lattice = clean.octree.lattice;
  std::vector<std::uint64_t> everywhere;
  for (const LatticePoint& cell : allPoints(lattice, 0))
  {
    everywhere.push_back(mortonCode(cell));
  }
  std::sort(everywhere.begin(), everywhere.end());
  // The object, a ball beside it that no silhouette shows, and a bump that touches the object.
  const auto ball = [](const LatticePoint& p, double i, double j, double k, double radius)
  { return radius - (Vector3(p.i, p.j, p.k) - Vector3(i, j, k)).norm(); };
  const double radius = 0.55 / lattice.leafEdge();
  CorrectedCapture capture;
  capture.correction.field = BrickField(lattice, everywhere, 0, clean.execution);
  BrickField& field = *capture.correction.field;
  for (std::size_t n = 0; n < field.size(); ++n)
  {
    const LatticePoint p = fromMorton(field.code(n));
    field.values()[n] = float(std::max({ ball(p, 16, 16, 16, radius), ball(p, 4, 4, 5, 2.5), ball(p, 16, 25, 16, 2.6) }));
  }
  const LatticeLabels labels = clean.labels(capture);
  int object = 0, bump = 0, beside = 0;
  for (const LatticePoint& p : allPoints(lattice, 1))
  {
    const bool inBall = ball(p, 4, 4, 5, 2.5) > 0.0;
    const bool inBump = ball(p, 16, 25, 16, 2.6) > 0.0;
    const bool inObject = ball(p, 16, 16, 16, radius) > 0.0;
    EXPECT_EQ(labels.insideAt(p), inBump || inObject) << p.i << " " << p.j << " " << p.k;
    object += inObject;
    bump += inBump && !inObject;
    beside += inBall;
  }
  EXPECT_GT(object, 1000);
  EXPECT_GT(bump, 10);
  EXPECT_GT(beside, 10);
  expectPromise(labels, clean.octree, "field by hand");
}

TEST(RobustLabels, AFieldThatKnowsNothingOfTheObjectLosesNoSurvivor)
{
  Scene clean(captureOf(torus()), 5);
  std::vector<std::uint64_t> some = leafCells(clean.octree, OctantState::Inside);
  some.insert(some.end(), clean.shell.cells.begin(), clean.shell.cells.end());
  std::sort(some.begin(), some.end());
  Random random(7);
  for (const int kind : { 0, 1 })
  {
    CorrectedCapture capture;
    capture.correction.field = BrickField(clean.octree.lattice, some, 3, clean.execution);
    BrickField& field = *capture.correction.field;
    for (std::size_t n = 0; n < field.size(); ++n)
    {
      const LatticePoint p = fromMorton(field.code(n));
      bool amidst = true; // where bricks end, the octree's say: correctCapture() sees to that
      for (int neighbour = 0; neighbour < 27 && amidst; ++neighbour)
      {
        const LatticePoint q = neighbourOf(p, neighbour);
        amidst = q.i >= 0 && q.j >= 0 && q.k >= 0 && field.find(mortonCode(q)) >= 0;
      }
      const float wild = kind == 0 ? -1.0f : float(random.uniform(-1.0, 1.0));
      field.values()[n] = amidst ? wild : (clean.octree.touchesInside(p) ? 0.5f : -0.5f);
    }
    expectPromise(clean.labels(capture), clean.octree, "kind " + std::to_string(kind));
  }
}

TEST(RobustLabels, TheExtendedShellHasTheEightCellsAroundEachPoint)
{
  Execution execution;
  const CornerShell shell = makeCornerShell({ 5, 9, 70 }, execution);
  const std::vector<std::uint64_t> points{ mortonCode({ 7, 3, 1 }), mortonCode({ 1, 1, 1 }), mortonCode({ 7, 4, 1 }) };
  std::set<std::uint64_t> expected{ 5, 9, 70 };
  for (const std::uint64_t point : points)
  {
    const LatticePoint p = fromMorton(point);
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint o = cornerOffset(n);
      expected.insert(mortonCode({ p.i - 1 + o.i, p.j - 1 + o.j, p.k - 1 + o.k }));
    }
  }
  const CornerShell wide = extendedShell(shell, points, execution);
  EXPECT_EQ(wide.cells, std::vector<std::uint64_t>(expected.begin(), expected.end()));
  EXPECT_EQ(wide.cellCorners.size(), wide.cells.size());
  EXPECT_EQ(extendedShell(shell, {}, execution).corners, shell.corners);
  std::vector<std::uint64_t> missing;
  std::set_difference(expected.begin(), expected.end(), shell.cells.begin(), shell.cells.end(), std::back_inserter(missing));
  EXPECT_EQ(cellsMissingAround(shell, points, execution), missing);
  EXPECT_TRUE(cellsMissingAround(wide, points, execution).empty());
}

TEST(RobustLabels, SameForAnyNumberOfThreadsAndItCanBeCancelled)
{
  auto captured = captureOf(torus());
  roughen(captured, 5);
  cut(captured[5], Vector3(0.62, 0.05, 0.0), 8.0);
  Scene noisy(captured, 4);
  const CorrectedCapture one = noisy.correct();
  const LatticeLabels expected = noisy.labels(one);
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution execution(threads);
    const CorrectedCapture many = noisy.correct(execution);
    EXPECT_EQ(many.repairedPixels, one.repairedPixels);
    const auto labels = correctedLabels(noisy.octree, noisy.shell, {}, noisy.views, many, execution);
    EXPECT_EQ(labels.shell().cells, expected.shell().cells);
    EXPECT_EQ(labels.inside(), expected.inside());
    EXPECT_EQ(labels.support(), expected.support());
  }
  CancelledExecution cancelled;
  EXPECT_THROW(noisy.correct(cancelled), Cancelled);
  ProgressExecution progress;
  noisy.correct(progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}
