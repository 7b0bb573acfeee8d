// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeSurface.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

TEST(LatticeSurface, OneInsideCornerIsAnOctahedron)
{
  Execution execution;
  std::vector<std::uint64_t> cells;
  for (int c = 0; c < 8; ++c)
  {
    cells.push_back(mortonCode(cornerOffset(c)));
  }
  const CornerShell shell = makeCornerShell(cells, execution);
  std::vector<std::uint8_t> inside(shell.corners.size(), 0);
  inside[shell.find(mortonCode({ 1, 1, 1 }))] = 1;
  const LatticeSurface surface = contour(shell, inside, execution);
  ASSERT_EQ(surface.edges.size(), 6u);
  ASSERT_EQ(surface.triangles.size(), 8u);
  EXPECT_EQ(surface.cellEnd.back(), 8u);
  const Lattice lattice{ { Eigen::Vector3d(1, 2, 3), 2.0 }, 1 };
  Mesh mesh;
  mesh.triangles = surface.triangles;
  for (const auto& edge : surface.edges)
  {
    EXPECT_EQ(inside[edge.inside], 1);
    EXPECT_EQ(inside[edge.outside], 0);
    mesh.points.push_back(crossingPosition(lattice, shell, edge, 0.25));
  }
  const MeshSoundness soundness = assessMesh(mesh, execution);
  EXPECT_TRUE(soundness.sound());
  EXPECT_NEAR(soundness.volume, 4.0 / 3.0 * 0.25 * 0.25 * 0.25, 1e-12);
}

TEST(LatticeSurface, DoesNotDependOnThreads)
{
  Random random(8);
  Execution serial;
  ThreadedExecution threads(8);
  std::vector<std::uint64_t> cells;
  for (int c = 0; c < 20 * 20 * 20; ++c)
  {
    cells.push_back(mortonCode({ c % 20, c / 20 % 20, c / 400 }));
  }
  std::sort(cells.begin(), cells.end());
  const CornerShell shell = makeCornerShell(cells, serial);
  std::vector<std::uint8_t> inside;
  for (std::size_t c = 0; c < shell.corners.size(); ++c)
  {
    inside.push_back(std::uint8_t(random.below(2)));
  }
  const auto a = contour(shell, inside, serial), b = contour(shell, inside, threads);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.cellEnd, b.cellEnd);
}
