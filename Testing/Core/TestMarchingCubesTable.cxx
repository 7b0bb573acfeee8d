// SPDX-License-Identifier: BSD-3-Clause
#include "MarchingCubesTable.h"

#include "CarvingTestCaptures.h"
#include "CornerShell.h"
#include "LatticeSurface.h"
#include "SelfIntersections.h"

#include <gtest/gtest.h>

#include <set>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

Mesh surfaceOfCase(int inside, const std::array<double, 12>& fractions)
{
  Mesh mesh;
  for (int e = 0; e < 12; ++e)
  {
    const LatticePoint a = cornerOffset(edgeCorners[e][0]);
    Eigen::Vector3d p(a.i, a.j, a.k);
    p[edgeAxis(e)] += fractions[e];
    mesh.points.push_back(p);
  }
  for (const auto& t : marchingCubesTable()[inside].triangles)
  {
    mesh.triangles.push_back({ t[0], t[1], t[2] });
  }
  return mesh;
}

/** A number from 0 to 255 with its corners turned about an axis. */
int turned(int inside, int axis)
{
  int result = 0;
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint p = cornerOffset(c);
    int q[3] = { p.i, p.j, p.k };
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int old = q[u];
    q[u] = 1 - q[v];
    q[v] = old;
    result |= (inside >> c & 1) << (q[0] | q[1] << 1 | q[2] << 2);
  }
  return result;
}

} // namespace

TEST(MarchingCubesTable, EveryCrossedEdgeIsInExactlyOneLoop)
{
  std::size_t loops = 0;
  for (int inside = 0; inside < 256; ++inside)
  {
    std::array<int, 12> uses{};
    loops += marchingCubesTable()[inside].loops.size();
    for (const auto& loop : marchingCubesTable()[inside].loops)
    {
      EXPECT_GE(loop.size(), 3u);
      EXPECT_LE(loop.size(), 7u);
      for (const auto e : loop)
      {
        ++uses[e];
      }
    }
    for (int e = 0; e < 12; ++e)
    {
      const bool crossed = (inside >> edgeCorners[e][0] & 1) != (inside >> edgeCorners[e][1] & 1);
      EXPECT_EQ(uses[e], int(crossed)) << "case " << inside << " edge " << e;
    }
  }
  EXPECT_EQ(loops, 358u);
}

TEST(MarchingCubesTable, HasFourteenClassesBesideTheEmptyUnderRotationAndReversal)
{
  std::set<int> classes;
  for (int inside = 0; inside < 256; ++inside)
  {
    std::set<int> orbit = { inside, 255 - inside };
    for (std::size_t before = 0; before != orbit.size();)
    {
      before = orbit.size();
      for (const int member : std::set<int>(orbit))
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          orbit.insert(turned(member, axis));
        }
      }
    }
    classes.insert(*orbit.begin());
  }
  EXPECT_EQ(classes.size(), 15u); // the fourteen, and the empty one
}

TEST(MarchingCubesTable, NoDiagonalLiesInACubeFace)
{
  for (int inside = 0; inside < 256; ++inside)
  {
    const auto& c = marchingCubesTable()[inside];
    std::set<std::pair<int, int>> sides;
    for (const auto& loop : c.loops)
    {
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        sides.insert(std::minmax<int>(loop[i], loop[(i + 1) % loop.size()]));
      }
    }
    const Mesh mesh = surfaceOfCase(inside, { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 });
    for (const auto& t : mesh.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const auto side = std::minmax<int>(t[k], t[(k + 1) % 3]);
        const auto& a = mesh.points[side.first];
        const auto& b = mesh.points[side.second];
        bool inFace = false;
        for (int axis = 0; axis < 3; ++axis)
        {
          inFace |= a[axis] == b[axis] && (a[axis] == 0.0 || a[axis] == 1.0);
        }
        EXPECT_EQ(inFace, sides.count(side) > 0) << "case " << inside;
      }
    }
  }
}

TEST(MarchingCubesTable, NoCaseIntersectsItselfWithItsPointsInTheMiddle)
{
  Execution execution;
  for (int inside = 0; inside < 256; ++inside)
  {
    const Mesh mesh = surfaceOfCase(inside, { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 });
    EXPECT_TRUE(selfIntersections(mesh, execution).empty()) << "case " << inside;
  }
}

TEST(MarchingCubesTable, NoCaseIntersectsItselfForRandomAndExtremeCrossings)
{
  Execution execution;
  Random random(7);
  for (int inside = 0; inside < 256; ++inside)
  {
    for (int trial = 0; trial < 60; ++trial)
    {
      std::array<double, 12> fractions;
      for (double& f : fractions)
      {
        f = trial % 2 ? random.uniform(0.01, 0.99) : (random.below(2) ? 0.01 : 0.99);
      }
      EXPECT_TRUE(selfIntersections(surfaceOfCase(inside, fractions), execution).empty()) << "case " << inside;
    }
  }
}

/** All 256 cases, each with a cell all around it: every neighbour has to agree on the faces between. */
TEST(MarchingCubesTable, AnyLabelsGiveClosedManifoldSurfacesOrientedOutwards)
{
  Execution execution;
  Random random(1);
  for (int run = 0; run < 400; ++run)
  {
    const int n = run < 256 ? 4 : 7;
    std::vector<std::uint64_t> cells;
    for (int c = 0; c < (n - 1) * (n - 1) * (n - 1); ++c)
    {
      cells.push_back(mortonCode({ c % (n - 1), c / (n - 1) % (n - 1), c / (n - 1) / (n - 1) }));
    }
    std::sort(cells.begin(), cells.end());
    const CornerShell shell = makeCornerShell(cells, execution);
    std::vector<std::uint8_t> inside(shell.corners.size(), 0);
    int count = 0;
    for (std::size_t c = 0; c < inside.size(); ++c)
    {
      const LatticePoint p = fromMorton(shell.corners[c]);
      const bool border = p.i == 0 || p.j == 0 || p.k == 0 || p.i == n - 1 || p.j == n - 1 || p.k == n - 1;
      const int bit = (p.i - 1) | (p.j - 1) << 1 | (p.k - 1) << 2;
      inside[c] = !border && (run < 256 ? (run >> bit & 1) : random.below(2));
      count += inside[c];
    }
    const LatticeSurface surface = contour(shell, inside, execution);
    Mesh mesh;
    mesh.triangles = surface.triangles;
    const Lattice lattice{ { Eigen::Vector3d::Zero(), 8.0 }, 3 };
    for (const auto& edge : surface.edges)
    {
      mesh.points.push_back(crossingPosition(lattice, shell, edge, random.uniform(0.01, 0.99)));
    }
    const MeshSoundness soundness = assessMesh(mesh, execution);
    EXPECT_EQ(count > 0, soundness.sound()) << "run " << run;
    EXPECT_EQ(soundness.unusedPoints, 0u);
  }
}
