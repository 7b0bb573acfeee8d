// SPDX-License-Identifier: BSD-3-Clause
#include "OctantTest.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

struct Scene
{
  PreparedViews views;
  LatticeProjection projection;
  OctantBox octant;
};

Scene randomScene(Random& random, OutsidePolicy policy, bool nearCamera)
{
  View view;
  const int size = 8 + random.below(60);
  const double share = random.uniform();
  Vector3 eye(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  eye = eye.normalized() * (nearCamera ? random.uniform(0.3, 1.5) : random.uniform(3, 20));
  view.projection = lookAtOrigin(eye, size * random.uniform(0.3, 1.5) * std::max(0.5, eye.norm()), size);
  view.silhouette = { size, size, {} };
  const double cx = random.uniform(0, size), cy = random.uniform(0, size), r = random.uniform(0, size);
  for (int i = 0; i < size * size; ++i)
  {
    const bool disc = std::hypot(i % size - cx, i / size - cy) < r;
    view.silhouette.pixels.push_back(std::uint8_t(share < 0.3 ? random.uniform() < share : disc));
  }
  Scene scene{ prepareViews({ view }, policy), {}, {} };
  const int depth = 5, level = random.below(6);
  scene.projection = LatticeProjection(view.projection, { unitCube(1.0), depth });
  scene.octant.size = 1 << level;
  const int n = 32 >> level;
  scene.octant.lowest = { random.below(n) << level, random.below(n) << level, random.below(n) << level };
  return scene;
}

/** The answer of the pixels of many points within the octant, each found by itself. */
PixelContent sampledContent(const Scene& s, int samples, bool& straddles)
{
  PixelContent content;
  int behind = 0, front = 0;
  for (int n = 0; n < samples * samples * samples; ++n)
  {
    const double x = double(n % samples) / (samples - 1), y = double(n / samples % samples) / (samples - 1),
                 z = double(n / samples / samples) / (samples - 1);
    const double p[3] = { s.octant.lowest.i + x * s.octant.size, s.octant.lowest.j + y * s.octant.size,
      s.octant.lowest.k + z * s.octant.size };
    double h[3];
    for (int c = 0; c < 3; ++c)
    {
      h[c] = s.projection.constant[c] + s.projection.step[0][c] * p[0] + s.projection.step[1][c] * p[1] +
        s.projection.step[2][c] * p[2];
    }
    if (!(h[2] > s.projection.minimumDepth))
    {
      ++behind;
      content.abstain = true;
      continue;
    }
    ++front;
    const auto& v = s.views[0];
    const Vote vote = v.pixelVote(
      PreparedView::nearestPixel(h[0] / h[2], v.width), PreparedView::nearestPixel(h[1] / h[2], v.height));
    content.object |= vote == Vote::Object;
    content.background |= vote == Vote::Background;
    content.abstain |= vote == Vote::Abstain;
  }
  straddles = behind > 0 && front > 0;
  return content;
}

/** What the polygon's pixels hold, pixel by pixel: the square against the convex hull of the corners (separating axes). */
PixelContent bruteForcePolygon(const Scene& s)
{
  std::vector<Vector2> corners;
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint d = cornerOffset(c);
    const auto h = s.projection({ s.octant.lowest.i + d.i * s.octant.size,
      s.octant.lowest.j + d.j * s.octant.size, s.octant.lowest.k + d.k * s.octant.size });
    corners.emplace_back(h.U / h.W, h.V / h.W);
  }
  std::vector<Vector2> axes = { Vector2::UnitX(), Vector2::UnitY() };
  for (int a = 0; a < 8; ++a)
  {
    for (int b = a + 1; b < 8; ++b)
    {
      const Vector2 d = corners[b] - corners[a];
      if (d.norm() > 0)
      {
        axes.emplace_back(-d.y() / d.norm(), d.x() / d.norm());
      }
    }
  }
  PixelContent content;
  const auto& v = s.views[0];
  for (int row = -1; row <= v.height; ++row)
  {
    for (int column = -1; column <= v.width; ++column)
    {
      // Beyond the image a pixel stands for all that are further out.
      const double far = 1e7;
      const double x0 = column < 0 ? -far : column - 0.5, x1 = column >= v.width ? far : column + 0.5;
      const double y0 = row < 0 ? -far : row - 0.5, y1 = row >= v.height ? far : row + 0.5;
      bool apart = false;
      for (const auto& axis : axes)
      {
        double least = 1e300, greatest = -1e300, squareLeast = 1e300, squareGreatest = -1e300;
        for (const auto& p : corners)
        {
          least = std::min(least, axis.dot(p));
          greatest = std::max(greatest, axis.dot(p));
        }
        for (const Vector2& q : { Vector2(x0, y0), Vector2(x1, y0), Vector2(x0, y1), Vector2(x1, y1) })
        {
          squareLeast = std::min(squareLeast, axis.dot(q));
          squareGreatest = std::max(squareGreatest, axis.dot(q));
        }
        apart = apart || least > squareGreatest || squareLeast > greatest;
      }
      if (!apart)
      {
        const Vote vote = v.pixelVote(column, row);
        content.object |= vote == Vote::Object;
        content.background |= vote == Vote::Background;
        content.abstain |= vote == Vote::Abstain;
      }
    }
  }
  return content;
}

} // namespace

/** One-sided truth for every octant: a certain answer is never contradicted by a point of the octant. */
TEST(OctantTest, NoPointOfAnOctantContradictsACertainAnswer)
{
  Random random(17);
  for (const auto policy : { OutsidePolicy::Border, OutsidePolicy::Unknown, OutsidePolicy::Background })
  {
    for (int trial = 0; trial < 1500; ++trial)
    {
      const Scene s = randomScene(random, policy, trial % 3 == 0);
      bool straddles = false;
      const PixelContent content = sampledContent(s, 7, straddles);
      for (const auto relation :
        { relate(s.views[0], s.projection, s.octant), relateBoundingBox(s.views[0], s.projection, s.octant) })
      {
        switch (relation)
        {
          case ViewRelation::Background:
            EXPECT_TRUE(!content.object && !content.abstain);
            break;
          case ViewRelation::Inside:
            EXPECT_TRUE(!content.background && !content.abstain);
            break;
          case ViewRelation::Abstain:
            EXPECT_TRUE(!content.background && !content.object);
            break;
          case ViewRelation::Partial:
            EXPECT_FALSE(content.background);
            break;
          case ViewRelation::Mixed:
            break;
        }
        EXPECT_TRUE(!straddles || relation == ViewRelation::Mixed);
      }
    }
  }
}

/** The exact polygon: the same answer as testing every pixel square against the polygon. */
TEST(OctantTest, AgreesWithBruteForceOverAllPixels)
{
  Random random(23);
  int mixed = 0, certain = 0;
  for (int trial = 0; trial < 3000; ++trial)
  {
    const auto policy = OutsidePolicy(trial % 3);
    const Scene s = randomScene(random, policy, false);
    const PixelContent c = bruteForcePolygon(s);
    const ViewRelation expected = c.background
      ? (c.object || c.abstain ? ViewRelation::Mixed : ViewRelation::Background)
      : c.abstain ? (c.object ? ViewRelation::Partial : ViewRelation::Abstain)
                  : ViewRelation::Inside;
    EXPECT_EQ(relate(s.views[0], s.projection, s.octant), expected) << "trial " << trial;
    (expected == ViewRelation::Mixed ? mixed : certain)++;
  }
  EXPECT_GT(mixed, 300);
  EXPECT_GT(certain, 300);
}

TEST(OctantTest, ThePolygonDecidesMoreThanItsBoundingBox)
{
  Random random(29);
  int more = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Scene s = randomScene(random, OutsidePolicy::Background, false);
    const auto box = relateBoundingBox(s.views[0], s.projection, s.octant);
    const auto polygon = relate(s.views[0], s.projection, s.octant);
    EXPECT_TRUE(box == ViewRelation::Mixed || box == polygon);
    more += box != polygon;
  }
  EXPECT_GT(more, 0);
}

/** Eight children at once or one after another: the same, whatever is in front of the camera or in the image. */
TEST(OctantTest, ChildrenTogetherAreChildrenApart)
{
  Random random(31);
  std::array<int, 5> seen{};
  for (int trial = 0; trial < 4000; ++trial)
  {
    Scene s = randomScene(random, OutsidePolicy(trial % 3), trial % 4 == 0);
    s.octant.size *= 2;
    std::array<ViewRelation, 8> relations;
    relations.fill(ViewRelation::Abstain);
    const unsigned children = 1u + unsigned(random.below(255));
    relateChildren(s.views[0], s.projection, s.octant, children, relations);
    for (int c = 0; c < 8; ++c)
    {
      const LatticePoint d = cornerOffset(c);
      const auto& o = s.octant.lowest;
      const int half = s.octant.size / 2;
      const auto expected = children >> c & 1u
        ? relate(s.views[0], s.projection, { { o.i + d.i * half, o.j + d.j * half, o.k + d.k * half }, half })
        : ViewRelation::Abstain;
      ASSERT_EQ(relations[c], expected) << "trial " << trial << ", child " << c;
      ++seen[std::size_t(expected)];
    }
  }
  for (const int count : seen)
  {
    EXPECT_GT(count, 20);
  }
}
