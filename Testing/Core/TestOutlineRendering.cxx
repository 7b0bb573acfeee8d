// SPDX-License-Identifier: BSD-3-Clause
#include "OutlineRendering.h"

#include "Error.h"
#include "SilhouetteRendering.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace silhouette;

namespace
{

std::size_t objectPixels(const BinaryImage& image)
{
  return std::accumulate(image.pixels.begin(), image.pixels.end(), std::size_t(0));
}

std::size_t differing(const BinaryImage& a, const BinaryImage& b)
{
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.pixels.size(); ++n)
  {
    count += a.pixels[n] != b.pixels[n];
  }
  return count;
}

BinaryImage rendered(const Mesh& mesh, const Projection& projection, int width, int height)
{
  Execution execution;
  return imageOf(OutlineRenderer(mesh, { { projection, width, height } }, execution).render(0));
}

} // namespace

TEST(OutlineRendering, IsTheSilhouetteOfAllTriangles)
{
  for (const SyntheticShape shape : { SyntheticShape::Jug, SyntheticShape::Torus, SyntheticShape::Twig })
  {
    SyntheticShapeOptions options;
    options.refinement = 0.5;
    const Mesh mesh = syntheticShape(shape, options);
    for (Projection projection : syntheticCameras(mesh, 7, 200, 160))
    {
      const BinaryImage expected = renderSilhouette(mesh, projection, 200, 160);
      EXPECT_GT(objectPixels(expected), 400u);
      EXPECT_LE(differing(rendered(mesh, projection, 200, 160), expected), 1u);
      // Mirrored: all triangles turn the other way round.
      projection.row(0) = 199.0 * projection.row(2) - projection.row(0);
      EXPECT_LE(differing(rendered(mesh, projection, 200, 160), renderSilhouette(mesh, projection, 200, 160)), 1u);
      // Cut by all four borders of the image.
      projection.row(0) -= 60.0 * projection.row(2);
      projection.row(1) -= 50.0 * projection.row(2);
      EXPECT_LE(differing(rendered(mesh, projection, 70, 40), renderSilhouette(mesh, projection, 70, 40)), 1u);
    }
  }
}

TEST(OutlineRendering, SeesFromInsideAndFromInfinity)
{
  SyntheticShapeOptions options;
  options.refinement = 0.5;
  const Mesh mesh = syntheticShape(SyntheticShape::Sphere, options);
  Projection inside; // from the sphere's middle everything is object
  inside << 50, 0, 20, 0, 0, 50, 20, 0, 0, 0, 1, 0;
  EXPECT_EQ(objectPixels(rendered(mesh, inside, 41, 41)), 41u * 41u);
  Projection parallel;
  parallel << 40, 0, 0, 50, 0, 40, 0, 50, 0, 0, 0, 1;
  const BinaryImage expected = renderSilhouette(mesh, parallel, 101, 101);
  EXPECT_GT(objectPixels(expected), 3000u);
  EXPECT_LE(differing(rendered(mesh, parallel, 101, 101), expected), 8u); // by symmetry, points lie on rows
}

TEST(OutlineRendering, NoImageShowsInTheNext)
{
  SyntheticShapeOptions options;
  options.refinement = 0.5;
  const Mesh mesh = syntheticShape(SyntheticShape::Torus, options);
  const int sizes[][2] = { { 160, 120 }, { 37, 90 }, { 200, 50 }, { 160, 120 } };
  for (const auto& size : sizes)
  {
    Projection projection = syntheticCameras(mesh, 4, size[0], size[1])[1];
    for (const double shift : { 0.0, 0.4, -0.4 }) // cut by neither side, by the right one, by the left one
    {
      Projection moved = projection;
      moved.row(0) += shift * size[0] * projection.row(2);
      const BinaryImage expected = renderSilhouette(mesh, moved, size[0], size[1]);
      EXPECT_GT(objectPixels(expected), 50u);
      EXPECT_LE(differing(rendered(mesh, moved, size[0], size[1]), expected), 1u) << size[0] << " " << shift;
    }
  }
}

TEST(OutlineRendering, RefusesWhatCannotBeRendered)
{
  Execution execution;
  const Mesh bad{ { { 0, 0, 0 } }, { { 0, 1, 2 } } };
  EXPECT_THROW(OutlineRenderer(bad, { { Projection::Zero(), 5, 5 } }, execution), InvalidInput);
  const Mesh none;
  EXPECT_THROW(rendered(none, Projection::Zero(), 0, 5), InvalidInput);
  EXPECT_EQ(objectPixels(rendered(none, Projection::Zero(), 5, 5)), 0u);
}

/** More than are looked at together, from one mesh: each is what it is alone. */
TEST(OutlineRendering, ManyCamerasAtOnce)
{
  Execution execution;
  SyntheticShapeOptions options;
  options.refinement = 0.5;
  const Mesh mesh = syntheticShape(SyntheticShape::Jug, options);
  std::vector<ImageCamera> cameras;
  for (const Projection& projection : syntheticCameras(mesh, 70, 60, 50))
  {
    cameras.push_back({ projection, 60, 50 });
  }
  const OutlineRenderer renderer(mesh, cameras, execution);
  ASSERT_EQ(renderer.size(), 70u);
  for (std::size_t n = 0; n < cameras.size(); n += 3)
  {
    const BinaryImage image = imageOf(renderer.render(n));
    EXPECT_EQ(image.pixels, rendered(mesh, cameras[n].projection, 60, 50).pixels) << n;
    EXPECT_LE(differing(image, renderSilhouette(mesh, cameras[n].projection, 60, 50)), 1u) << n;
  }
}

/** Two cubes that share an edge: four triangles meet there, and still each pixel is covered as often as triangles that face the camera cover it. */
TEST(OutlineRendering, WhereFourTrianglesMeet)
{
  Mesh mesh;
  for (int cube = 0; cube < 2; ++cube)
  {
    for (int n = 0; n < 8; ++n)
    {
      mesh.points.emplace_back(cube + (n & 1), cube + (n >> 1 & 1), n >> 2);
    }
    const int faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    for (const auto& f : faces)
    {
      const auto name = [&](int n) { return std::int32_t(cube == 1 && n == 0 ? 3 : cube == 1 && n == 4 ? 7 : 8 * cube + n); };
      mesh.triangles.push_back({ name(f[0]), name(f[1]), name(f[2]) });
      mesh.triangles.push_back({ name(f[0]), name(f[2]), name(f[3]) });
    }
  }
  for (const Projection& projection : syntheticCameras(mesh, 9, 90, 80))
  {
    const BinaryImage expected = renderSilhouette(mesh, projection, 90, 80);
    EXPECT_GT(objectPixels(expected), 300u);
    EXPECT_LE(differing(rendered(mesh, projection, 90, 80), expected), 2u);
  }
}
