// SPDX-License-Identifier: BSD-3-Clause
#include "MovedVolumes.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

double volumeOf(const Mesh& mesh, std::size_t first, std::size_t last)
{
  double volume = 0.0;
  for (std::size_t t = first; t < last; ++t)
  {
    const Triangle& triangle = mesh.triangles[t];
    volume += mesh.points[std::size_t(triangle[0])].cross(mesh.points[std::size_t(triangle[1])]).dot(mesh.points[std::size_t(triangle[2])]) / 6.0;
  }
  return volume;
}

/** Two balls; some of their points may move. */
struct Scene
{
  Mesh mesh = joined(sphereMesh(2, 1.0), moved(sphereMesh(1, 0.2), Vector3(3.0, 0.0, 0.0)));
  std::size_t firstOfSmall = sphereMesh(2, 1.0).triangles.size(), pointsOfLarge = sphereMesh(2, 1.0).points.size();
  std::vector<std::int32_t> number = std::vector<std::int32_t>(mesh.points.size(), -1);
  std::vector<Vector3> original;
  MovedVolumes volumes{ mesh, number, original };
  Execution execution;

  static Mesh moved(Mesh ball, const Vector3& by)
  {
    for (Vector3& p : ball.points)
    {
      p += by;
    }
    return ball;
  }

  void move(std::size_t point, const Vector3& to)
  {
    this->number[point] = std::int32_t(this->original.size());
    this->original.push_back(this->mesh.points[point]);
    this->mesh.points[point] = to;
  }

  std::vector<std::int32_t> moving() const
  {
    std::vector<std::int32_t> triangles;
    for (std::size_t t = 0; t < this->mesh.triangles.size(); ++t)
    {
      const Triangle& triangle = this->mesh.triangles[t];
      if (std::any_of(triangle.begin(), triangle.end(), [&](std::int32_t p) { return this->number[std::size_t(p)] >= 0; }))
      {
        triangles.push_back(std::int32_t(t));
      }
    }
    return triangles;
  }
};

} // namespace

/** Any points, moved anywhere: whether a component has less volume than it had is told. */
TEST(MovedVolumes, MayShrinkWhereOneHasLessVolume)
{
  int shrunk = 0, grown = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    Random random(trial);
    Scene scene;
    const Mesh before = scene.mesh;
    const double towards = random.uniform(-0.3, 0.3);
    for (int n = 0; n < 1 + trial % 7; ++n)
    {
      const auto point = std::size_t(random.below(int(before.points.size())));
      const Vector3 centre = point < scene.pointsOfLarge ? Vector3::Zero() : Vector3(3.0, 0.0, 0.0);
      if (scene.number[point] < 0)
      {
        scene.move(point, centre + (1.0 + towards) * (before.points[point] - centre));
      }
    }
    const std::size_t all = before.triangles.size();
    const bool isLess = volumeOf(scene.mesh, 0, scene.firstOfSmall) < volumeOf(before, 0, scene.firstOfSmall) - 1e-12 ||
      volumeOf(scene.mesh, scene.firstOfSmall, all) < volumeOf(before, scene.firstOfSmall, all) - 1e-12;
    EXPECT_EQ(scene.volumes.mayShrink(scene.moving()), isLess) << trial;
    (isLess ? shrunk : grown) += 1;
    EXPECT_TRUE(scene.volumes.inverted(scene.execution).empty());
  }
  EXPECT_GT(shrunk, 50);
  EXPECT_GT(grown, 50);
}

/** A ball mirrored in its middle is inside out, though the other grows by more. */
TEST(MovedVolumes, TellWhichPointsAreOfAComponentTurnedInsideOut)
{
  Scene scene;
  std::vector<std::size_t> expected;
  for (std::size_t point = 0; point < scene.mesh.points.size(); ++point)
  {
    const Vector3 p = scene.mesh.points[point], centre(3.0, 0.0, 0.0);
    const bool isSmall = point >= scene.pointsOfLarge;
    if (isSmall)
    {
      expected.push_back(scene.original.size());
    }
    scene.move(point, isSmall ? Vector3(2.0 * centre - p) : Vector3(1.5 * p));
  }
  EXPECT_TRUE(scene.volumes.mayShrink(scene.moving()));
  EXPECT_EQ(scene.volumes.inverted(scene.execution), expected);
  EXPECT_EQ(scene.volumes.original(5), scene.original[5]);
}

TEST(MovedVolumes, OfNothingThatMovesNothingIsTold)
{
  Scene scene;
  EXPECT_FALSE(scene.volumes.mayShrink(scene.moving()));
  EXPECT_TRUE(scene.volumes.inverted(scene.execution).empty());
  EXPECT_EQ(scene.volumes.original(5), scene.mesh.points[5]);
}
