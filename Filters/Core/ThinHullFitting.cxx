// SPDX-License-Identifier: BSD-3-Clause
#include "ThinHullFitting.h"

#include "BoxTree.h"
#include "CellBoxes.h"
#include "CellTriangles.h"
#include "CoverageNear.h"
#include "IndicesWhere.h"
#include "IntersectionsNear.h"
#include "MovedVolumes.h"
#include "NearOctants.h"
#include "PointBlocks.h"
#include "ThinSolid.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace silhouette
{
namespace
{

/** Moves points out, and back where that does harm. */
class Motion
{
public:
  Motion(const ThinSurface& thin, const ThinSolid& solid, double reach, Mesh& mesh, Execution& execution)
    : Thin(thin)
    , TheMesh(mesh)
    , Run(execution)
    , Cells(thin.shell, thin.surface)
    , Number(mesh.points.size(), -1)
    , Volumes(mesh, this->Number, this->Original)
  {
    this->aim(solid, reach);
  }

  std::uint64_t run()
  {
    if (this->Points.empty())
    {
      return 0;
    }
    this->findNeighbourhood();
    for (const std::size_t m : this->Points)
    {
      this->place(this->Number[m]);
    }
    this->withdrawIntersections();
    while (this->withdrawLost() || this->withdrawInverted())
    {
      this->withdrawIntersections();
    }
    this->Run.checkpoint(1.0);
    return std::uint64_t(std::count_if(
      this->Scale.begin(), this->Scale.end(), [](double scale) { return scale > 0.0; }));
  }

private:
  static constexpr int Rounds = 5;           ///< after so many a point stays where it was
  static constexpr std::size_t Batches = 16; ///< times that aiming asks whether it is cancelled

  const Lattice& lattice() const { return this->Thin.labels.octree().lattice; }

  /** Does a covering corner touch the solid that was there before? Then it may lie nearer to the surface than any hull. */
  bool onSolid(std::uint64_t corner) const
  {
    for (int n = 0; n < 27; ++n)
    {
      const LatticePoint p = neighbourOf(fromMorton(corner), n);
      if (this->Thin.labels.insideAt(p) &&
        !std::binary_search(this->Thin.added.begin(), this->Thin.added.end(), mortonCode(p)))
      {
        return true;
      }
    }
    return false;
  }

  /** Of a covering corner's point: 0 where no hull ends on its edge, or none of those is better than what is there. */
  Vector3 moveOf(std::size_t point, const ThinSolid& solid, double reach) const
  {
    const CrossedEdge& edge = this->Thin.surface.edges[point];
    const std::uint64_t inside = this->Thin.shell.corners[edge.inside], outside = this->Thin.shell.corners[edge.outside];
    const Vector3 start = this->TheMesh.points[point];
    const double leaf = this->lattice().leafEdge();
    Vector3 target;
    if (!solid.surfaceBetween(toVector(fromMorton(inside)), toVector(fromMorton(outside)), target) ||
      (this->onSolid(inside) && !solid.isBetter(target, (start - this->lattice().root.origin) / leaf)))
    {
      return Vector3::Zero();
    }
    const Vector3 move = this->lattice().root.origin + target * leaf - start;
    return move * std::min(1.0, reach * leaf / std::max(move.norm(), 1e-300));
  }

  void aim(const ThinSolid& solid, double reach)
  {
    const auto& edges = this->Thin.surface.edges;
    const CornerShell& shell = this->Thin.shell;
    std::vector<std::uint8_t> isAdded(shell.corners.size(), 0);
    CodeCursor corners(shell.corners);
    for (const std::uint64_t code : this->Thin.added)
    {
      isAdded[std::size_t(corners.find(code))] = 1;
    }
    const std::vector<std::int32_t> candidates =
      indicesWhere(reach > 0.0 ? edges.size() : 0, 4096, this->Run, [&](std::size_t e) { return isAdded[edges[e].inside] != 0; });
    std::vector<Vector3> moves(candidates.size(), Vector3::Zero());
    for (std::size_t batch = 0; batch < Batches; ++batch)
    {
      const std::size_t begin = candidates.size() * batch / Batches;
      this->Run.forRanges(candidates.size() * (batch + 1) / Batches - begin, 16,
        [&](std::size_t first, std::size_t last)
        {
          for (std::size_t n = begin + first; n < begin + last; ++n)
          {
            moves[n] = this->moveOf(std::size_t(candidates[n]), solid, reach);
          }
        });
      this->Run.checkpoint(0.3 * double(batch + 1) / Batches);
    }
    for (std::size_t n = 0; n < candidates.size(); ++n)
    {
      if (moves[n] != Vector3::Zero())
      {
        const auto point = std::size_t(candidates[n]);
        this->Number[point] = std::int32_t(this->Points.size());
        this->Points.push_back(point);
        this->Original.push_back(this->TheMesh.points[point]);
        this->Moves.push_back(moves[n]);
      }
    }
    this->Scale.assign(this->Points.size(), 1.0);
    this->Withdrawn.assign(this->Points.size(), 0);
    this->ChangedAt.assign(this->Points.size(), 0);
  }

  void place(std::size_t m)
  {
    Vector3 p = this->Original[m];
    if (this->Scale[m] > 0.0)
    {
      p += this->Scale[m] * this->Moves[m];
      p = this->Thin.singlePrecision ? roundedToFloat(p) : p;
    }
    this->TheMesh.points[this->Points[m]] = p;
  }

  bool withdraw(std::size_t m)
  {
    if (this->Scale[m] == 0.0)
    {
      return false;
    }
    this->Scale[m] = ++this->Withdrawn[m] >= Rounds ? 0.0 : this->Scale[m] * 0.6;
    this->place(m);
    this->ChangedAt[m] = this->Now;
    return true;
  }

  bool moves(std::size_t t) const
  {
    const Triangle& triangle = this->TheMesh.triangles[t];
    return std::any_of(triangle.begin(), triangle.end(), [&](std::int32_t p) { return this->Number[std::size_t(p)] >= 0; });
  }

  /** Has one of a triangle's points been withdrawn since a moment of Now? */
  bool hasChanged(std::size_t t, std::uint64_t since) const
  {
    const Triangle& triangle = this->TheMesh.triangles[t];
    return std::any_of(triangle.begin(), triangle.end(), [&](std::int32_t p)
      { return this->Number[std::size_t(p)] >= 0 && this->ChangedAt[std::size_t(this->Number[std::size_t(p)])] > since; });
  }

  /** Of all places of a triangle, whatever the scales: a point stays between two. */
  Box sweptBy(std::size_t t) const
  {
    Box box;
    for (const std::int32_t p : this->TheMesh.triangles[t])
    {
      box.extend(this->Volumes.original(p));
      if (this->Number[std::size_t(p)] >= 0)
      {
        box.extend(this->Volumes.original(p) + this->Moves[std::size_t(this->Number[std::size_t(p)])]);
      }
    }
    return box;
  }

  /** The triangles with a moving point: they lie in the cells around that point's edge. */
  std::vector<std::int32_t> movingTriangles() const
  {
    const CornerShell& shell = this->Thin.shell;
    std::vector<std::uint64_t> starts; // of the edges
    for (const std::size_t point : this->Points)
    {
      const CrossedEdge& edge = this->Thin.surface.edges[point];
      starts.push_back(std::min(shell.corners[edge.inside], shell.corners[edge.outside]));
    }
    const std::vector<std::uint64_t> cells = cellsAround(std::move(starts), this->Run);
    std::vector<std::int32_t> triangles = this->Cells.ofCells(cells);
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), [&](std::int32_t t) { return !this->moves(std::size_t(t)); }), triangles.end());
    return triangles;
  }

  /** Some triangles and those that move, all ascending. */
  std::vector<std::int32_t> withMoving(const std::vector<std::int32_t>& triangles) const
  {
    std::vector<std::int32_t> all;
    std::set_union(triangles.begin(), triangles.end(), this->Moving.begin(), this->Moving.end(), std::back_inserter(all));
    return all;
  }

  /** The triangles that may meet a moving one. */
  void findNeighbourhood()
  {
    const Vector3 slack = Vector3::Constant(1e-3 * this->lattice().leafEdge()); // for rounding
    this->Moving = this->movingTriangles();
    this->Run.checkpoint(0.32);
    for (const std::int32_t t : this->Moving)
    {
      const Box box = this->sweptBy(std::size_t(t));
      this->Swept.emplace_back(box.min() - slack, box.max() + slack);
    }
    const BoxTree tree(this->Swept, this->Run);
    this->Run.checkpoint(0.34);
    this->CellsMet = cellsMet(this->lattice(), this->Swept);
    this->Run.checkpoint(0.36);
    const std::vector<std::int32_t> triangles = this->withMoving(this->Cells.ofCells(this->CellsMet));
    this->Run.checkpoint(0.37);
    const auto isNear = [&](std::size_t n)
    {
      bool near = false;
      tree.overlapping(this->sweptBy(std::size_t(triangles[n])), [&](std::int32_t) { near = true; });
      return near;
    };
    std::vector<std::int32_t> near;
    for (const std::int32_t n : indicesWhere(triangles.size(), 256, this->Run, isNear))
    {
      near.push_back(triangles[std::size_t(n)]);
    }
    this->Run.checkpoint(0.39);
    this->Near = IntersectionsNear(this->TheMesh, std::move(near));
    this->Run.checkpoint(0.4);
  }

  /** The triangles that may lie in the rows along x of octants that are swept. */
  MeshPart inSweptRows() const
  {
    const int cells = this->lattice().cells();
    std::vector<std::uint8_t> rows(std::size_t(cells) * std::size_t(cells), 0);
    for (const std::uint64_t code : this->CellsMet)
    {
      const LatticePoint p = fromMorton(code);
      for (int k = std::max(p.k - 1, 0); k <= std::min(p.k + 1, cells - 1); ++k)
      {
        for (int j = std::max(p.j - 1, 0); j <= std::min(p.j + 1, cells - 1); ++j)
        {
          rows[std::size_t(k) * std::size_t(cells) + std::size_t(j)] = 1;
        }
      }
    }
    return { this->TheMesh, this->withMoving(this->Cells.inRows(rows, this->lattice(), this->Run)) };
  }

  void withdrawIntersections()
  {
    for (;;)
    {
      Phase phase(this->Run, 0.4, 0.4);
      const auto& pairs = this->Near.pairs(this->TheMesh, [this](std::size_t t) { return this->hasChanged(t, this->MetAt); }, phase);
      this->MetAt = this->Now++;
      if (pairs.empty())
      {
        return;
      }
      std::vector<std::size_t> points;
      for (const TrianglePair& pair : pairs)
      {
        for (const std::int32_t t : pair)
        {
          for (const std::int32_t p : this->TheMesh.triangles[std::size_t(t)])
          {
            points.push_back(std::size_t(p));
          }
        }
      }
      this->withdrawAll(points);
    }
  }

  bool withdrawAll(std::vector<std::size_t>& points)
  {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    bool any = false;
    for (const std::size_t p : points)
    {
      any = (this->Number[p] >= 0 && this->withdraw(std::size_t(this->Number[p]))) || any;
    }
    return any;
  }

  /** Withdraw components that the moves have turned inside out; false where there are none. */
  bool withdrawInverted()
  {
    bool any = false;
    for (const std::size_t m : this->Volumes.mayShrink(this->Moving) ? this->Volumes.inverted(this->Run) : std::vector<std::size_t>())
    {
      any = this->withdraw(m) || any;
    }
    return any;
  }

  /** Where a survivor may be lost that was not, or was: what triangles sweep that have changed since, and the octants that were lost. */
  std::vector<Box> changedBoxes() const
  {
    std::vector<Box> boxes;
    for (std::size_t n = 0; n < this->Moving.size(); ++n)
    {
      if (this->hasChanged(std::size_t(this->Moving[n]), this->LostAt))
      {
        boxes.push_back(this->Swept[n]);
      }
    }
    for (const std::uint64_t code : this->Lost)
    {
      const Vector3 corner = this->lattice().root.origin + toVector(fromMorton(code)) * this->lattice().leafEdge();
      boxes.emplace_back(corner, corner + Vector3::Constant(this->lattice().leafEdge()));
    }
    return boxes;
  }

  /** Withdraw around the survivors that the surface has lost; false where there are none. */
  bool withdrawLost()
  {
    Phase phase(this->Run, 0.9, 0.9);
    if (!this->Survivors)
    {
      this->InRows = this->inSweptRows();
      const Mesh part = this->InRows.of(this->TheMesh);
      this->Survivors.emplace(this->Thin.octree, part, this->Swept, this->CellsMet, this->Run);
      this->Lost = this->Survivors->lost(part, phase);
    }
    else
    {
      this->Lost = this->Survivors->lostWithin(this->changedBoxes(), this->InRows.of(this->TheMesh), phase);
    }
    this->LostAt = this->Now++;
    const auto& lost = this->Lost;
    if (lost.empty())
    {
      return false;
    }
    for (int ring = 0; ring <= 2; ++ring)
    {
      std::vector<std::size_t> points = this->pointsAround(lost, ring);
      if (this->withdrawAll(points))
      {
        return true;
      }
    }
    bool any = false;
    for (std::size_t m = 0; m < this->Points.size(); ++m)
    {
      any = this->withdraw(m) || any;
    }
    return any;
  }

  /** The points that lay within `ring` octants of one of the octants, which are ascending. */
  std::vector<std::size_t> pointsAround(const std::vector<std::uint64_t>& octants, int ring) const
  {
    const auto lay = [&](std::size_t m)
    { return isNearOctant(octants, (this->Original[m] - this->lattice().root.origin) / this->lattice().leafEdge(), ring, this->lattice().cells()); };
    std::vector<std::size_t> result;
    for (const std::int32_t m : indicesWhere(this->Points.size(), 256, this->Run, lay))
    {
      result.push_back(this->Points[std::size_t(m)]);
    }
    return result;
  }

  const ThinSurface& Thin;
  Mesh& TheMesh;
  Execution& Run;
  CellTriangles Cells;
  std::vector<std::int32_t> Number; ///< of each point among those that move, or -1
  std::vector<std::size_t> Points;  ///< that move
  std::vector<Vector3> Original;    ///< their places before
  std::vector<Vector3> Moves;
  MovedVolumes Volumes;
  std::vector<double> Scale;
  std::vector<int> Withdrawn;
  std::uint64_t Now = 1;                ///< grows with each look for intersections and for what is lost
  std::vector<std::uint64_t> ChangedAt; ///< when each point was withdrawn last
  IntersectionsNear Near;               ///< of the triangles that may meet a moving one
  std::uint64_t MetAt = 0;              ///< when these were looked for last
  std::vector<std::int32_t> Moving; ///< triangles
  std::vector<Box> Swept;           ///< by each of them
  std::vector<std::uint64_t> CellsMet; ///< by these boxes
  MeshPart InRows;                  ///< what may lie in their rows
  std::optional<CoverageNear> Survivors; ///< of that part
  std::vector<std::uint64_t> Lost; ///< when they were looked at last
  std::uint64_t LostAt = 0;
};

} // namespace

std::uint64_t moveToThinHulls(const std::vector<ThinHull>& hulls, const ThinSurface& thin, const SilhouetteDepth* depth,
  const ThinHullOptions& options, Mesh& mesh, Execution& execution)
{
  checkThinHullOptions(options);
  if (hulls.empty())
  {
    return 0;
  }
  const ThinSolid solid(hulls, thin.labels.octree().lattice, depth);
  return Motion(thin, solid, options.reach, mesh, execution).run();
}

} // namespace silhouette
