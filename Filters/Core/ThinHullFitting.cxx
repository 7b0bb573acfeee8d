// SPDX-License-Identifier: BSD-3-Clause
#include "ThinHullFitting.h"

#include "BoxTree.h"
#include "CoverageNear.h"
#include "IndicesWhere.h"
#include "IntersectionsNear.h"
#include "MeshComponents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace silhouette
{
namespace
{

/** The union of the hulls and of what is inside all silhouettes, lattice coordinates. */
class ThinSolid
{
public:
  ThinSolid(const std::vector<ThinHull>& hulls, const Lattice& lattice, const SilhouetteDepth* depth)
    : Hulls(onLattice(hulls, lattice))
    , Tree(boxesOf(this->Hulls))
    , Depth(depth)
  {
  }

  /** Is a point, lattice coordinates, nearer to the silhouettes' contours than another? */
  bool isBetter(const Vector3& p, const Vector3& other) const
  {
    return !this->Depth || std::abs((*this->Depth)(p)) < std::abs((*this->Depth)(other));
  }

  /**
   * Where the surface lies between a covering corner and the lattice point beyond it: seen from the nearest hull's inside, before that
   * point. False where no hull is near.
   */
  bool surfaceBetween(const Vector3& inside, const Vector3& outside, Vector3& target) const
  {
    const Vector3 middle = 0.5 * (inside + outside);
    std::vector<std::int32_t> near;
    this->Tree.overlapping(Box(middle - Vector3::Constant(1.5), middle + Vector3::Constant(1.5)),
      [&](std::int32_t hull) { near.push_back(hull); });
    const NearestBall from = this->nearest(near, middle);
    // Not quite the point beyond: edges that end at one point are to lead to different places.
    const Vector3 ray = inside + 0.85 * (outside - inside) - from.centre;
    const double length = ray.norm();
    if (near.empty() || length < 1e-6)
    {
      return false;
    }
    const Vector3 heading = ray / length;
    const double farthest = length + 0.3;
    double before = 0.0, behind = 0.0;
    for (; behind < farthest; before = behind)
    {
      const double depth = this->depthAt(near, from.centre + behind * heading);
      if (depth <= 0.0)
      {
        break;
      }
      behind += std::max(0.8 * depth, 0.02);
    }
    for (int halving = 0; halving < 7; ++halving)
    {
      const double half = 0.5 * (before + behind);
      (this->depthAt(near, from.centre + half * heading) > 0.0 ? before : behind) = half;
    }
    target = from.centre + before * heading;
    return true;
  }

private:
  static std::vector<ThinHull> onLattice(std::vector<ThinHull> hulls, const Lattice& lattice)
  {
    for (ThinHull& hull : hulls)
    {
      for (int end = 0; end < 2; ++end)
      {
        hull.centre[end] = (hull.centre[end] - lattice.root.origin) / lattice.leafEdge();
        hull.radius[end] /= lattice.leafEdge();
      }
    }
    return hulls;
  }

  static std::vector<Box> boxesOf(const std::vector<ThinHull>& hulls)
  {
    std::vector<Box> boxes;
    for (const ThinHull& hull : hulls)
    {
      Box box(hull.centre[0]);
      boxes.push_back(box.extend(hull.centre[1]));
    }
    return boxes;
  }

  NearestBall nearest(const std::vector<std::int32_t>& hulls, const Vector3& p) const
  {
    NearestBall best;
    best.distance = 1e300;
    for (const std::int32_t hull : hulls)
    {
      const NearestBall ball = nearestBall(this->Hulls[hull], p);
      best = ball.distance < best.distance ? ball : best;
    }
    return best;
  }

  double depthAt(const std::vector<std::int32_t>& hulls, const Vector3& p) const
  {
    const double inHulls = -this->nearest(hulls, p).distance;
    return this->Depth && inHulls <= 0.0 ? std::max(inHulls, (*this->Depth)(p)) : inHulls;
  }

  std::vector<ThinHull> Hulls;
  BoxTree Tree;
  const SilhouetteDepth* Depth;
};

/** Moves points out, and back where that does harm. */
class Motion
{
public:
  Motion(const ThinSurface& thin, const ThinSolid& solid, double reach, Mesh& mesh, Execution& execution)
    : Thin(thin)
    , TheMesh(mesh)
    , Run(execution)
    , Number(mesh.points.size(), -1)
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
  static constexpr int Rounds = 5; ///< after so many a point stays where it was

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

  void aim(const ThinSolid& solid, double reach)
  {
    const auto& edges = this->Thin.surface.edges;
    const CornerShell& shell = this->Thin.shell;
    const std::vector<std::int32_t> candidates = indicesWhere(reach > 0.0 ? edges.size() : 0, 4096, this->Run,
      [&](std::size_t e)
      { return std::binary_search(this->Thin.added.begin(), this->Thin.added.end(), shell.corners[edges[e].inside]); });
    std::vector<Vector3> moves(candidates.size(), Vector3::Zero());
    this->Run.forRanges(candidates.size(), 16,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          const CrossedEdge& edge = edges[std::size_t(candidates[n])];
          const Vector3 start = this->TheMesh.points[std::size_t(candidates[n])];
          Vector3 target;
          if (solid.surfaceBetween(toVector(fromMorton(shell.corners[edge.inside])),
                toVector(fromMorton(shell.corners[edge.outside])), target) &&
            (!this->onSolid(shell.corners[edge.inside]) ||
              solid.isBetter(target, (start - this->lattice().root.origin) / this->lattice().leafEdge())))
          {
            const Vector3 move = this->lattice().root.origin + target * this->lattice().leafEdge() - start;
            moves[n] = move * std::min(1.0, reach * this->lattice().leafEdge() / std::max(move.norm(), 1e-300));
          }
        }
      });
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
    this->Run.checkpoint(0.3);
  }

  /** Where a point of the mesh was before any has moved. */
  const Vector3& original(std::int32_t point) const
  {
    const std::int32_t m = this->Number[std::size_t(point)];
    return m >= 0 ? this->Original[std::size_t(m)] : this->TheMesh.points[std::size_t(point)];
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
      box.extend(this->original(p));
      if (this->Number[std::size_t(p)] >= 0)
      {
        box.extend(this->original(p) + this->Moves[std::size_t(this->Number[std::size_t(p)])]);
      }
    }
    return box;
  }

  /** The triangles that may meet a moving one. */
  void findNeighbourhood()
  {
    const std::size_t count = this->TheMesh.triangles.size();
    const Vector3 slack = Vector3::Constant(1e-3 * this->lattice().leafEdge()); // for rounding
    this->Moving = indicesWhere(count, 4096, this->Run, [&](std::size_t n) { return this->moves(n); });
    for (const std::int32_t t : this->Moving)
    {
      const Box box = this->sweptBy(std::size_t(t));
      this->Swept.emplace_back(box.min() - slack, box.max() + slack);
    }
    const BoxTree tree(this->Swept, this->Run);
    const auto isNear = [&](std::size_t t)
    {
      bool near = false;
      tree.overlapping(this->sweptBy(t), [&](std::int32_t) { near = true; });
      return near;
    };
    this->Near = IntersectionsNear(this->TheMesh, indicesWhere(count, 1024, this->Run, isNear));
    this->Run.checkpoint(0.4);
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

  /** Six times the signed volume of a component. */
  struct Volume
  {
    double before = 0.0, now = 0.0;
  };

  using Volumes = std::map<std::uint32_t, Volume>; ///< of components, by their first points

  /** Adds a triangle's share to its component's; the points of one component are measured from its first. */
  void addVolume(const Triangle& t, Volumes& volumes)
  {
    const auto product = [](const Vector3& o, const Vector3& a, const Vector3& b, const Vector3& c)
    { return (a - o).cross(b - o).dot(c - o); };
    const auto& points = this->TheMesh.points;
    const std::uint32_t first = this->Components.find(std::uint32_t(t[0]));
    Volume& volume = volumes[first];
    const double now = product(points[first], points[t[0]], points[t[1]], points[t[2]]);
    const auto isStill = [&](std::int32_t p) { return this->Number[std::size_t(p)] < 0; };
    volume.now += now;
    volume.before += isStill(std::int32_t(first)) && std::all_of(t.begin(), t.end(), isStill)
      ? now
      : product(this->original(std::int32_t(first)), this->original(t[0]), this->original(t[1]), this->original(t[2]));
  }

  Volumes volumes()
  {
    constexpr std::size_t RunSize = 1 << 15; // triangles whose shares are summed one after another, whatever the threads
    const auto& triangles = this->TheMesh.triangles;
    std::vector<Volumes> runs((triangles.size() + RunSize - 1) / RunSize);
    this->Run.forRanges(runs.size(), 1,
      [&](std::size_t firstRun, std::size_t lastRun)
      {
        for (std::size_t run = firstRun; run < lastRun; ++run)
        {
          for (std::size_t t = run * RunSize; t < std::min((run + 1) * RunSize, triangles.size()); ++t)
          {
            this->addVolume(triangles[t], runs[run]);
          }
        }
      });
    Volumes all;
    for (const Volumes& run : runs)
    {
      for (const auto& [component, volume] : run)
      {
        all[component].before += volume.before;
        all[component].now += volume.now;
      }
    }
    return all;
  }

  /** Withdraw components that the moves have turned inside out; false where there are none. */
  bool withdrawInverted()
  {
    if (this->Components.size() == 0)
    {
      this->Components = connectPoints(this->TheMesh.triangles, this->TheMesh.points.size(), this->Run);
    }
    const Volumes volumes = this->volumes();
    bool any = false;
    for (std::size_t m = 0; m < this->Points.size(); ++m)
    {
      const Volume& own = volumes.at(this->Components.find(std::uint32_t(this->Points[m])));
      if (own.before > 0.0 && !(own.now > 0.0))
      {
        any = this->withdraw(m) || any;
      }
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
      this->Survivors.emplace(this->Thin.octree, this->TheMesh, this->Swept, this->Run);
      this->Lost = this->Survivors->lost(this->TheMesh, phase);
    }
    else
    {
      this->Lost = this->Survivors->lostWithin(this->changedBoxes(), this->TheMesh, phase);
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

  /** The points that lay within `ring` octants of one of the octants. */
  std::vector<std::size_t> pointsAround(const std::vector<std::uint64_t>& octants, int ring) const
  {
    std::vector<std::size_t> result;
    for (std::size_t m = 0; m < this->Points.size(); ++m)
    {
      const Vector3 p = (this->Original[m] - this->lattice().root.origin) / this->lattice().leafEdge();
      for (const std::uint64_t code : octants)
      {
        const Vector3 away = p - toVector(fromMorton(code)) - Vector3::Constant(0.5);
        if (away.cwiseAbs().maxCoeff() <= 0.5 + ring + 1e-3)
        {
          result.push_back(this->Points[m]);
          break;
        }
      }
    }
    return result;
  }

  const ThinSurface& Thin;
  Mesh& TheMesh;
  Execution& Run;
  std::vector<std::int32_t> Number; ///< of each point among those that move, or -1
  std::vector<std::size_t> Points;  ///< that move
  std::vector<Vector3> Original;    ///< their places before
  std::vector<Vector3> Moves;
  ConcurrentUnionFind Components; ///< of the mesh's points
  std::vector<double> Scale;
  std::vector<int> Withdrawn;
  std::uint64_t Now = 1;                ///< grows with each look for intersections and for what is lost
  std::vector<std::uint64_t> ChangedAt; ///< when each point was withdrawn last
  IntersectionsNear Near;               ///< of the triangles that may meet a moving one
  std::uint64_t MetAt = 0;              ///< when these were looked for last
  std::vector<std::int32_t> Moving; ///< triangles
  std::vector<Box> Swept;           ///< by each of them
  std::optional<CoverageNear> Survivors;
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
