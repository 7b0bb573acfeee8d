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

} // namespace

TEST(OutlineRendering, IsTheSilhouetteOfAllTriangles)
{
  for (const SyntheticShape shape : { SyntheticShape::Jug, SyntheticShape::Torus, SyntheticShape::Twig })
  {
    SyntheticShapeOptions options;
    options.refinement = 0.5;
    const Mesh mesh = syntheticShape(shape, options);
    const OutlineRenderer renderer(mesh);
    for (Projection projection : syntheticCameras(mesh, 7, 200, 160))
    {
      const BinaryImage expected = renderSilhouette(mesh, projection, 200, 160);
      EXPECT_GT(objectPixels(expected), 400u);
      EXPECT_LE(differing(renderer.render(projection, 200, 160), expected), 1u);
      // Mirrored: all triangles turn the other way round.
      projection.row(0) = 199.0 * projection.row(2) - projection.row(0);
      EXPECT_LE(differing(renderer.render(projection, 200, 160), renderSilhouette(mesh, projection, 200, 160)), 1u);
      // Cut by all four borders of the image.
      projection.row(0) -= 60.0 * projection.row(2);
      projection.row(1) -= 50.0 * projection.row(2);
      EXPECT_LE(differing(renderer.render(projection, 70, 40), renderSilhouette(mesh, projection, 70, 40)), 1u);
    }
  }
}

TEST(OutlineRendering, SeesFromInsideAndFromInfinity)
{
  SyntheticShapeOptions options;
  options.refinement = 0.5;
  const Mesh mesh = syntheticShape(SyntheticShape::Sphere, options);
  const OutlineRenderer renderer(mesh);
  Projection inside; // from the sphere's middle everything is object
  inside << 50, 0, 20, 0, 0, 50, 20, 0, 0, 0, 1, 0;
  EXPECT_EQ(objectPixels(renderer.render(inside, 41, 41)), 41u * 41u);
  Projection parallel;
  parallel << 40, 0, 0, 50, 0, 40, 0, 50, 0, 0, 0, 1;
  const BinaryImage expected = renderSilhouette(mesh, parallel, 101, 101);
  EXPECT_GT(objectPixels(expected), 3000u);
  EXPECT_LE(differing(renderer.render(parallel, 101, 101), expected), 8u); // by symmetry, points lie on rows
}

TEST(OutlineRendering, NoImageShowsInTheNext)
{
  SyntheticShapeOptions options;
  options.refinement = 0.5;
  const Mesh mesh = syntheticShape(SyntheticShape::Torus, options);
  const OutlineRenderer renderer(mesh);
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
      EXPECT_LE(differing(renderer.render(moved, size[0], size[1]), expected), 1u) << size[0] << " " << shift;
    }
  }
}

TEST(OutlineRendering, RefusesWhatCannotBeRendered)
{
  const Mesh bad{ { { 0, 0, 0 } }, { { 0, 1, 2 } } };
  EXPECT_THROW(OutlineRenderer renderer(bad), InvalidInput);
  const Mesh none;
  const OutlineRenderer renderer(none);
  EXPECT_THROW(renderer.render(Projection::Zero(), 0, 5), InvalidInput);
  EXPECT_EQ(objectPixels(renderer.render(Projection::Zero(), 5, 5)), 0u);
}
