// SPDX-License-Identifier: BSD-3-Clause
#include "ShadedRendering.h"

#include "Error.h"
#include "SilhouetteRendering.h"
#include "SyntheticShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace silhouette;

namespace
{

constexpr int Size = 200;

/** A camera at (0, 0, -4) that looks along z, x to the right, y down. */
Projection camera()
{
  Projection projection;
  projection << 300, 0, 99.5, 4 * 99.5, 0, 300, 99.5, 4 * 99.5, 0, 0, 1, 4;
  return projection;
}

std::vector<std::uint8_t> photograph(const Mesh& mesh)
{
  const BinaryImage mask = renderSilhouette(mesh, camera(), Size, Size);
  return shadePhotograph(mesh, shadingNormals(mesh), camera(), mask);
}

/** A square at z, of this half edge, facing the camera or away from it. */
Mesh square(double z, double half, bool facing)
{
  Mesh mesh;
  mesh.points = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  if (!facing)
  {
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  }
  return mesh;
}

std::array<int, 3> pixel(const std::vector<std::uint8_t>& image, int column, int row)
{
  const std::size_t i = 3 * (std::size_t(row) * Size + column);
  return {image[i], image[i + 1], image[i + 2]};
}

TEST(ShadedRendering, keyGivesBackTheMask)
{
  SyntheticShapeOptions coarse;
  coarse.refinement = 0.5;
  for (const SyntheticShape shape :
       {SyntheticShape::Jug, SyntheticShape::Sphere, SyntheticShape::Torus, SyntheticShape::Twig,
        SyntheticShape::Pebble, SyntheticShape::Pumpkin})
  {
    const Mesh mesh = syntheticShape(shape, coarse);
    const BinaryImage mask = renderSilhouette(mesh, camera(), Size, Size);
    const std::vector<std::uint8_t> image = photograph(mesh);
    ASSERT_EQ(image.size(), std::size_t(3 * Size * Size));
    int wrong = 0;
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    {
      const double excess = image[3 * i + 2] - std::max(image[3 * i], image[3 * i + 1]);
      wrong += (excess > 0.1 * 255.0) == (mask.pixels[i] != 0) ? 1 : 0;
      EXPECT_TRUE(mask.pixels[i] == 0 || excess <= 0.0);
    }
    EXPECT_EQ(wrong, 0) << int(shape);
  }
}

TEST(ShadedRendering, nearestSurfaceIsSeen)
{
  // A slanted square behind a straight one, in both orders.
  const Mesh front = square(-0.5, 0.3, true);
  Mesh back = square(0.5, 1.0, true);
  back.points[0].z() += 1.5;
  back.points[1].z() += 1.5;
  for (const bool backFirst : {false, true})
  {
    Mesh both = backFirst ? back : front;
    const Mesh& other = backFirst ? front : back;
    both.points.insert(both.points.end(), other.points.begin(), other.points.end());
    for (const Triangle& t : other.triangles)
    {
      both.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    }
    const auto image = photograph(both);
    EXPECT_EQ(pixel(image, 100, 100), pixel(photograph(front), 100, 100));
    EXPECT_EQ(pixel(image, 60, 140), pixel(photograph(back), 60, 140));
    EXPECT_NE(pixel(image, 100, 100), pixel(image, 60, 140));
  }
}

TEST(ShadedRendering, bothSidesAreLitAlike)
{
  const auto front = photograph(square(0.0, 0.5, true));
  const auto back = photograph(square(0.0, 0.5, false));
  EXPECT_EQ(front, back);
  EXPECT_GT(pixel(front, 100, 100)[0], 150);
}

TEST(ShadedRendering, lightComesFromAboveTheLeftShoulder)
{
  const auto image = photograph(syntheticShape(SyntheticShape::Sphere));
  const int brightest = pixel(image, 80, 76)[0];
  EXPECT_GT(brightest, pixel(image, 130, 130)[0] + 40);
  EXPECT_GT(brightest, pixel(image, 100, 150)[0] + 20);
  EXPECT_GT(brightest, pixel(image, 150, 100)[0] + 20);
}

TEST(ShadedRendering, smoothNormalsOfASphereAreTheSpheres)
{
  const Mesh mesh = syntheticShape(SyntheticShape::Sphere);
  const ShadingNormals normals = shadingNormals(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    EXPECT_GT(normals.points[i].dot(mesh.points[i].normalized()), 0.9999);
  }
}

TEST(ShadedRendering, refusesWhatDoesNotFit)
{
  const Mesh mesh = square(0.0, 0.5, true);
  const ShadingNormals normals = shadingNormals(mesh);
  BinaryImage mask = renderSilhouette(mesh, camera(), Size, Size);
  EXPECT_THROW(shadePhotograph(mesh, ShadingNormals(), camera(), mask), InvalidInput);
  EXPECT_THROW(shadePhotograph(mesh, normals, -camera(), mask), InvalidInput);
  mask.pixels.pop_back();
  EXPECT_THROW(shadePhotograph(mesh, normals, camera(), mask), InvalidInput);
}

} // namespace
