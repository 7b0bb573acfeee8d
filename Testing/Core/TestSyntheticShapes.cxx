// SPDX-License-Identifier: BSD-3-Clause
#include "SyntheticShapes.h"

#include "ConvexHull.h"
#include "Error.h"
#include "MeshSoundness.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

using namespace silhouette;

namespace
{

constexpr double Pi = 3.14159265358979323846;

double volume(const Mesh& mesh)
{
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    sum += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6.0;
  }
  return sum;
}

/** Number of times that the line from `origin` along `direction` passes through the mesh. */
int crossings(const Mesh& mesh, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
  int count = 0;
  for (const Triangle& t : mesh.triangles)
  {
    int positive = 0;
    for (int c = 0; c < 3; ++c)
    {
      const Eigen::Vector3d a = mesh.points[t[c]] - origin;
      const Eigen::Vector3d b = mesh.points[t[(c + 1) % 3]] - origin;
      positive += direction.dot(a.cross(b)) > 0.0 ? 1 : 0;
    }
    count += positive % 3 == 0 ? 1 : 0;
  }
  return count;
}

void expectSound(const Mesh& mesh, std::int64_t genus)
{
  Execution execution;
  const MeshSoundness soundness = assessMesh(mesh, execution);
  EXPECT_TRUE(soundness.sound());
  EXPECT_EQ(soundness.unusedPoints, 0u);
  EXPECT_EQ(soundness.components, 1u);
  EXPECT_EQ(soundness.genus, std::optional<std::int64_t>(genus));

  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.points)
  {
    box.extend(p);
  }
  const double reach = std::max(-box.min().minCoeff(), box.max().maxCoeff());
  EXPECT_LT(reach, 0.98);
  EXPECT_GT(reach, 0.8);
}

TEST(SyntheticShapes, sphere)
{
  const Mesh mesh = syntheticShape(SyntheticShape::Sphere);
  expectSound(mesh, 0);
  const double exact = 4.0 / 3.0 * Pi * std::pow(sphereRadius, 3);
  EXPECT_LT(volume(mesh), exact);
  EXPECT_GT(volume(mesh), exact * (1.0 - 3e-4));
  for (const Triangle& t : mesh.triangles)
  {
    const Eigen::Vector3d middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
    EXPECT_GT(middle.norm(), sphereRadius - 0.1 * 2.0 / 512.0);
  }
  for (const Eigen::Vector3d& p : mesh.points)
  {
    EXPECT_NEAR(p.norm(), sphereRadius, 1e-12);
  }
}

TEST(SyntheticShapes, torus)
{
  const Mesh mesh = syntheticShape(SyntheticShape::Torus);
  expectSound(mesh, 1);
  EXPECT_NEAR(torusAxis().norm(), 1.0, 1e-12);
  EXPECT_NEAR(volume(mesh), 2.0 * Pi * Pi * torusRingRadius * torusTubeRadius * torusTubeRadius, 3e-4);
  const auto distance = [](const Eigen::Vector3d& p)
  {
    const double along = p.dot(torusAxis());
    const double outward = (p - along * torusAxis()).norm() - torusRingRadius;
    return std::hypot(outward, along) - torusTubeRadius;
  };
  for (const Triangle& t : mesh.triangles)
  {
    EXPECT_NEAR(distance(mesh.points[t[0]]), 0.0, 1e-12);
    const Eigen::Vector3d middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
    EXPECT_NEAR(distance(middle), 0.0, 0.1 * 2.0 / 512.0);
  }
}

TEST(SyntheticShapes, jugHasAHandleAndAnOpenMouth)
{
  const Mesh mesh = syntheticShape(SyntheticShape::Jug);
  expectSound(mesh, 1);
  const Eigen::Vector3d bodyCentre(0.001, 0.002, -0.2);
  EXPECT_EQ(crossings(mesh, bodyCentre, Eigen::Vector3d::UnitZ()), 2);        // the floor alone
  EXPECT_EQ(crossings(mesh, bodyCentre, Eigen::Vector3d::UnitY()), 4);        // two walls
  EXPECT_EQ(crossings(mesh, {0.0, 0.002, 0.5}, Eigen::Vector3d::UnitX()), 6); // two walls and the handle
  EXPECT_EQ(crossings(mesh, {-0.55, 0.0, 0.4}, Eigen::Vector3d::UnitY()), 0); // through the handle
  Eigen::Vector3d spout = mesh.points[0];
  for (const Eigen::Vector3d& p : mesh.points)
  {
    spout = p.z() > spout.z() ? p : spout;
  }
  EXPECT_GT(spout.x(), 0.4);
}

TEST(SyntheticShapes, twigIsThinnerThanAnOctantOfDepth7)
{
  const Mesh mesh = syntheticShape(SyntheticShape::Twig);
  expectSound(mesh, 0);
  // A tube of diameter d has 4 / d of surface for each unit of volume; forks have less.
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    area += 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm();
  }
  const double diameter = 4.0 * volume(mesh) / area;
  EXPECT_GT(diameter, 0.010);
  EXPECT_LT(diameter, 0.014);
}

TEST(SyntheticShapes, pebbleIsConvexAndTilted)
{
  const Mesh mesh = syntheticShape(SyntheticShape::Pebble);
  expectSound(mesh, 0);
  for (const Triangle& t : mesh.triangles)
  {
    EXPECT_NEAR(pebbleLevel(mesh.points[t[0]]), 1.0, 1e-12);
    const Eigen::Vector3d middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
    EXPECT_NEAR(pebbleLevel(middle), 1.0, 1e-3);
  }
  for (std::size_t i = 0; i + 1 < mesh.points.size(); ++i) // the solid between any two of its points
  {
    const Eigen::Vector3d& other = mesh.points[(i * 7919 + 1) % mesh.points.size()];
    EXPECT_LE(pebbleLevel(0.5 * (mesh.points[i] + other)), 1.0 + 1e-12);
  }
  const std::optional<Mesh> hull = convexHull(mesh.points);
  ASSERT_TRUE(hull.has_value());
  EXPECT_NEAR(volume(mesh) / volume(*hull), 1.0, 1e-4);
  // Turned by half a turn about z, or seen from behind, it is another shape.
  double turned = 0.0;
  double opposite = 0.0;
  for (const Eigen::Vector3d& p : mesh.points)
  {
    turned = std::max(turned, std::abs(pebbleLevel({-p.x(), -p.y(), p.z()}) - 1.0));
    opposite = std::max(opposite, std::abs(pebbleLevel(-p) - 1.0));
  }
  EXPECT_GT(turned, 0.1);
  EXPECT_GT(opposite, 0.05);
}

TEST(SyntheticShapes, pumpkinHasLobesHollowsAndAStalk)
{
  const Mesh mesh = syntheticShape(SyntheticShape::Pumpkin);
  expectSound(mesh, 0);
  EXPECT_EQ(crossings(mesh, {0.001, 0.002, -0.16}, Eigen::Vector3d::UnitX()), 2); // one solid, no cavity
  const std::optional<Mesh> hull = convexHull(mesh.points);
  ASSERT_TRUE(hull.has_value());
  EXPECT_LT(volume(mesh), 0.9 * volume(*hull));
  // A ray that grazes the lobes goes in and out of several.
  int most = 0;
  for (double y = 0.5; y < 0.9; y += 0.01)
  {
    most = std::max(most, crossings(mesh, {-0.99, y, -0.1612}, {1.0, 0.0013, 0.0017}));
  }
  EXPECT_GE(most, 4);
  Eigen::Vector3d tip = mesh.points[0];
  for (const Eigen::Vector3d& p : mesh.points)
  {
    tip = p.z() > tip.z() ? p : tip;
  }
  EXPECT_GT(tip.head<2>().norm(), 0.1); // the stalk bends away
}

TEST(SyntheticShapes, refinementMultipliesTheFaces)
{
  SyntheticShapeOptions coarse;
  coarse.refinement = 0.5;
  for (const SyntheticShape shape :
       {SyntheticShape::Jug, SyntheticShape::Sphere, SyntheticShape::Torus, SyntheticShape::Twig,
        SyntheticShape::Pebble, SyntheticShape::Pumpkin})
  {
    const Mesh mesh = syntheticShape(shape, coarse);
    expectSound(mesh, shape == SyntheticShape::Jug || shape == SyntheticShape::Torus ? 1 : 0);
  }
  const double ratio = double(syntheticShape(SyntheticShape::Sphere).triangles.size()) /
                       double(syntheticShape(SyntheticShape::Sphere, coarse).triangles.size());
  EXPECT_EQ(ratio, 4.0);
}

TEST(SyntheticShapes, refusesWhatItDoesNotKnow)
{
  for (const double refinement : {0.4, 5.0, std::numeric_limits<double>::quiet_NaN()})
  {
    SyntheticShapeOptions options;
    options.refinement = refinement;
    EXPECT_THROW(syntheticShape(SyntheticShape::Sphere, options), InvalidInput);
  }
  EXPECT_THROW(syntheticShape(SyntheticShape(17)), InvalidInput);
}

} // namespace
