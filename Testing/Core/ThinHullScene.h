// SPDX-License-Identifier: BSD-3-Clause
/**
 * Thin shapes carved and covered, for the tests of thin hulls and of fitting a surface to them.
 */
#pragma once

#include "CarvingTestCaptures.h"
#include "CellSafety.h"
#include "EdgeCrossing.h"
#include "LatticeRegions.h"
#include "RobustLabels.h"
#include "SurvivorCoverage.h"
#include "SurvivorCovering.h"
#include "ThinHullFitting.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace silhouette::test
{

/** Everything up to the covered surface, and the thin hulls on it. */
struct Covered
{
  Covered(PreparedViews given, const RootCube& cube, int depth, int k)
    : prepared(std::move(given))
    , views(prepared, { cube, depth })
    , octree(carveViews(prepared, cube, depth, k))
    , labels(octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), prepared, execution)
  {
    for (std::uint32_t c = 0; c < this->labels.shell().cells.size(); ++c)
    {
      const auto& corners = this->labels.shell().cellCorners[c];
      if (this->labels.isSurvivor(c) && std::none_of(corners.begin(), corners.end(),
            [&](std::uint32_t corner) { return this->labels.inside()[corner] != 0; }))
      {
        this->cells.push_back(c);
      }
    }
    for (const std::uint32_t corner : coverSurvivors(this->labels, {}, 0, nullptr, execution).coveringCorners)
    {
      this->added.push_back(this->labels.shell().corners[corner]);
    }
    std::sort(this->added.begin(), this->added.end());
    this->shell = extendedShell(this->labels.shell(), this->added, this->execution);
    std::vector<std::uint8_t> inside;
    for (const std::uint64_t corner : this->shell.corners)
    {
      inside.push_back(this->labels.insideAt(fromMorton(corner)));
    }
    this->surface = contour(this->shell, inside, this->execution);
  }

  Mesh place(bool singlePrecision)
  {
    std::vector<double> fractions;
    for (const CrossedEdge& edge : this->surface.edges)
    {
      const std::uint64_t a = this->shell.corners[edge.inside], b = this->shell.corners[edge.outside];
      const bool covering = std::binary_search(this->added.begin(), this->added.end(), a);
      const double t = exactCrossing(this->views, fromMorton(a), fromMorton(b), this->octree.backgroundVotes);
      fractions.push_back(covering ? 0.03 : std::clamp(t, CrossingMargin, 1.0 - CrossingMargin));
    }
    Mesh mesh = placePoints(this->octree.lattice, this->shell, this->surface, fractions, singlePrecision, this->execution);
    removeCellIntersections(
      this->octree.lattice, this->shell, this->surface, singlePrecision, mesh, this->execution);
    return mesh;
  }

  Execution execution;
  PreparedViews prepared;
  LatticeViews views;
  Octree octree;
  LatticeLabels labels;
  std::vector<std::uint32_t> cells;
  std::vector<std::uint64_t> added;
  CornerShell shell;
  LatticeSurface surface;
};

struct Moved
{
  std::vector<ThinHull> hulls;
  Mesh mesh;
  std::uint64_t points = 0;
};

inline Moved move(Covered& covered, const ThinHullOptions& options, Execution& execution, bool singlePrecision = false,
  bool withDepth = true)
{
  Moved moved;
  const SilhouetteDepth depth(covered.views, covered.octree.backgroundVotes, 1.0, execution);
  moved.hulls = thinHulls(covered.labels, covered.cells, depth, options, execution);
  moved.mesh = covered.place(singlePrecision);
  const ThinSurface thin{ covered.labels, covered.labels.octree(), covered.added, covered.shell, covered.surface, singlePrecision };
  moved.points =
    moveToThinHulls(moved.hulls, thin, withDepth ? &depth : nullptr, options, moved.mesh, execution);
  return moved;
}

/** A straight tube of half an octant's radius or so, across the lattice's directions. */
inline Mesh tube(double radius)
{
  Mesh mesh = sphereMesh(4, 1.0);
  const Vector3 along = Vector3(0.5, 0.3, 0.8).normalized();
  for (Vector3& p : mesh.points)
  {
    const double t = p.dot(along);
    p = radius * p + 0.7 * (t > 0.0 ? 1.0 : (t < 0.0 ? -1.0 : 0.0)) * along;
  }
  return mesh;
}

inline PreparedViews look(const Mesh& mesh, int kind, std::uint64_t seed, int count, int size)
{
  Random random(seed);
  auto captured = viewsOf(mesh, swayingRing(count, size), size);
  disturb(captured, kind, random);
  return prepareViews(captured);
}

inline void expectSound(const Mesh& mesh, const Octree& octree, const std::string& what)
{
  Execution execution;
  const MeshSoundness s = assessMesh(mesh, execution);
  EXPECT_TRUE(s.sound()) << what << ": " << s.selfIntersections << " self-intersections";
  EXPECT_EQ(lostSurvivors(octree, mesh, execution), 0u) << what;
}

} // namespace silhouette::test
