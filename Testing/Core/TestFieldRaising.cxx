// SPDX-License-Identifier: BSD-3-Clause
#include "FieldRaising.h"

#include "BrickTestFields.h"
#include "CarvingTestCaptures.h"
#include "CornerShell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Size = 160;
constexpr double Margin = 0.1; // octants, as the page has it

/** Views of a sphere, what survives of them, and a field whose ball is dented where x is large. */
struct Scene
{
  explicit Scene(int backgroundVotes = 0, double radius = 0.72, double dent = 2.5)
    : views(prepareViews(viewsOf(sphereMesh(4, 0.7), swayingRing(12, Size), Size)))
    , octree(carveViews(this->views, unitCube(1.05), 5, backgroundVotes))
    , survivors(leafCells(this->octree, OctantState::Intersection))
    , seen(this->views, this->octree.lattice, 4.0)
  {
    Execution execution;
    std::vector<int> all(std::size_t(this->seen.size()));
    std::iota(all.begin(), all.end(), 0);
    this->seen.observe(all, execution);
    this->field = BrickField(this->octree.lattice, this->survivors, 4, execution);
    const double leaf = this->octree.lattice.leafEdge();
    for (std::size_t n = 0; n < this->field.size(); ++n)
    {
      const Vector3 p = this->octree.lattice.position(fromMorton(this->field.code(n)));
      this->field.values()[n] = float(std::clamp((radius - p.norm()) / leaf - (p.x() > 0.45 ? dent : 0.0), -4.0, 4.0));
    }
  }

  std::vector<std::uint64_t> lost(const BrickField& by) const { return cellsOutside(by, this->survivors); }

  /** The least but `votes` of the views' distances. */
  double bound(const LatticePoint& p, int votes) const
  {
    std::vector<float> distances;
    for (int view = 0; view < this->seen.size(); ++view)
    {
      distances.push_back(this->seen.inside(this->seen.observed(view), this->seen.place(view, p)));
    }
    std::sort(distances.begin(), distances.end());
    return distances[std::size_t(votes)];
  }

  PreparedViews views;
  Octree octree;
  std::vector<std::uint64_t> survivors;
  FieldViews seen;
  BrickField field;
};

/** Sums of Gaussians, cut off at three deviations, of the corners of some cells; how much is left of one's own where a cell is alone counts as 1. */
class BruteWeights
{
public:
  BruteWeights(const std::vector<std::uint64_t>& cells, double width)
    : Reach(int(std::ceil(3.0 * width)))
  {
    for (const std::uint64_t cell : cells)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        this->Corners.insert(mortonCode(fromMorton(cell) + cornerOffset(corner)));
      }
    }
    double sum = 0.0;
    for (int d = -this->Reach; d <= this->Reach; ++d)
    {
      this->Kernel.push_back(std::exp(-0.5 * d * d / (width * width)));
      sum += this->Kernel.back();
    }
    for (double& weight : this->Kernel)
    {
      weight /= sum;
    }
    this->Alone = std::pow(this->Kernel[std::size_t(this->Reach)] + this->Kernel[std::size_t(this->Reach) + 1], 3);
  }

  double at(const LatticePoint& p) const
  {
    const int side = int(this->Kernel.size());
    double sum = 0.0;
    for (int n = 0; n < side * side * side; ++n)
    {
      const int x = n % side, y = n / side % side, z = n / side / side;
      const LatticePoint q = p + LatticePoint{ x - this->Reach, y - this->Reach, z - this->Reach };
      if (std::min({ q.i, q.j, q.k }) >= 0 && this->Corners.count(mortonCode(q)) != 0)
      {
        sum += this->Kernel[std::size_t(x)] * this->Kernel[std::size_t(y)] * this->Kernel[std::size_t(z)];
      }
    }
    const double w = std::min(1.0, sum / this->Alone);
    return w * w * (3.0 - 2.0 * w);
  }

private:
  int Reach;
  double Alone;
  std::vector<double> Kernel;
  std::set<std::uint64_t> Corners;
};

} // namespace

TEST(FieldRaising, EachValueIsWhatTheFormulaSays)
{
  Execution execution;
  for (const int votes : { 0, 2 })
  {
    for (const double width : { 0.7, 1.5 })
    {
      const Scene scene(votes);
      const auto lost = scene.lost(scene.field);
      ASSERT_GT(lost.size(), 100u);
      const BruteWeights weights(lost, width);
      BrickField raised = scene.field;
      raiseToSurvivors(raised, scene.survivors, scene.seen, votes, width, execution);
      int whole = 0, part = 0, same = 0;
      for (std::size_t n = 0; n < raised.size(); n += 7)
      {
        const LatticePoint p = fromMorton(raised.code(n));
        const double before = scene.field.values()[n], w = weights.at(p);
        const double rise = scene.octree.lattice.onBorder(p) ? 0.0 : std::max(0.0, scene.bound(p, votes) - Margin - before);
        EXPECT_NEAR(raised.values()[n], before + w * rise, 0.006) << p.i << " " << p.j << " " << p.k << ", width " << width;
        whole += rise > 0.1 && w == 1.0;
        part += rise > 0.1 && w > 0.05 && w < 0.95;
        same += raised.values()[n] == scene.field.values()[n];
      }
      EXPECT_GT(whole, 20);
      EXPECT_GT(part, 20);
      EXPECT_GT(same, 500);
    }
  }
}

TEST(FieldRaising, MostOfTheLostAreNotAnyMoreAndTheOthersStickOutByNoMoreThanTheMargin)
{
  Execution execution;
  for (const int votes : { 0, 2 })
  {
    const Scene scene(votes);
    BrickField raised = scene.field;
    raiseToSurvivors(raised, scene.survivors, scene.seen, votes, 1.5, execution);
    const auto before = scene.lost(scene.field), after = scene.lost(raised);
    EXPECT_LT(after.size(), 0.4 * double(before.size()));
    for (const std::uint64_t cell : after)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        EXPECT_LT(scene.bound(fromMorton(cell) + cornerOffset(corner), votes), Margin + 0.002);
      }
    }
  }
}

TEST(FieldRaising, AFieldThatLosesNothingKeepsItsBytesAndSoDoesOneWithoutValuesThere)
{
  Execution execution;
  const Scene whole(0, 0.78, 0.0);
  ASSERT_TRUE(whole.lost(whole.field).empty());
  BrickField same = whole.field;
  raiseToSurvivors(same, whole.survivors, whole.seen, 0, 1.5, execution);
  EXPECT_EQ(same.values(), whole.field.values());

  const Scene dented(0, 0.78, 4.0);
  ASSERT_FALSE(dented.lost(dented.field).empty());
  std::vector<std::uint8_t> keep;
  for (const std::uint64_t brick : dented.field.bricks())
  {
    keep.push_back(fromMorton(brick).i < 2 ? 1 : 0);
  }
  BrickField half = dented.field;
  half.keepBricks(keep);
  const BrickField before = half;
  raiseToSurvivors(half, dented.survivors, dented.seen, 0, 1.5, execution);
  EXPECT_EQ(half.values(), before.values());
}

TEST(FieldRaising, TheSameBytesOnAnyNumberOfThreads)
{
  Execution execution;
  const Scene scene;
  BrickField serial = scene.field;
  raiseToSurvivors(serial, scene.survivors, scene.seen, 0, 1.5, execution);
  EXPECT_NE(serial.values(), scene.field.values());
  for (const int threads : { 2, 8 })
  {
    ThreadedExecution sideBySide(threads);
    BrickField raised = scene.field;
    raiseToSurvivors(raised, scene.survivors, scene.seen, 0, 1.5, sideBySide);
    EXPECT_EQ(raised.values(), serial.values()) << threads;
  }
}
