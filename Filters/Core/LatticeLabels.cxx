// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeLabels.h"

#include "BlockBits.h"
#include "CornerVotes.h"
#include "FirstTouch.h"
#include "IndicesWhere.h"
#include "LargePages.h"
#include "MarchingCubesTable.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <deque>
#include <tuple>

namespace silhouette
{
namespace
{

constexpr double OnEdgeTolerance = 1e-3;
constexpr std::uint8_t Unknown = 2;
constexpr std::uint64_t NoEdge = ~std::uint64_t(0);

/** The lattice edge that `p` lies on; false where it lies on none. */
bool locateCrossing(const Eigen::Vector3d& p, const Lattice& lattice, LatticeCrossing& crossing)
{
  const Eigen::Array3d g = (p - lattice.root.origin).array() / lattice.leafEdge();
  if (!((g >= -0.5).all() && (g <= lattice.cells() + 0.5).all())) // not finite ones either
  {
    return false;
  }
  // Not below -1/2: cutting off is rounding, and cheaper than a call.
  std::int32_t nearest[3];
  double off[3];
  int axis = 0;
  for (int a = 0; a < 3; ++a)
  {
    nearest[a] = std::int32_t(g[a] + 0.5);
    off[a] = std::abs(g[a] - nearest[a]);
    axis = off[a] > off[axis] ? a : axis;
  }
  for (int other = 0; other < 3; ++other)
  {
    if (other != axis && off[other] > OnEdgeTolerance)
    {
      return false;
    }
  }
  const std::int32_t whole = std::clamp(std::int32_t(std::max(g[axis], 0.0)), 0, lattice.cells() - 1);
  nearest[axis] = whole;
  crossing.edge = edgeKey(mortonCode({ nearest[0], nearest[1], nearest[2] }), axis);
  crossing.fraction = std::clamp(g[axis] - whole, 0.0, 1.0);
  return true;
}

int axisOf(std::uint64_t edge)
{
  return int(edge & 3);
}

/** Outward, not normalised: only the sign along an edge counts. */
std::vector<Eigen::Vector3d> pointNormals(const Mesh& surface)
{
  std::vector<Eigen::Vector3d> normals(surface.points.size(), Eigen::Vector3d::Zero());
  for (const auto& t : surface.triangles)
  {
    const auto& a = surface.points[t[0]];
    const Eigen::Vector3d normal = (surface.points[t[1]] - a).cross(surface.points[t[2]] - a);
    for (const auto corner : t)
    {
      normals[corner] += normal;
    }
  }
  return normals;
}

struct LocatedPoint
{
  LatticeCrossing crossing{ NoEdge, 0.0 };
  std::uint8_t lowerInside = 0;
  bool operator<(const LocatedPoint& b) const
  {
    return std::tie(this->crossing.edge, this->crossing.fraction, this->lowerInside) <
      std::tie(b.crossing.edge, b.crossing.fraction, b.lowerInside);
  }
};

/** Are they all on edges, ascending, no edge twice? */
bool areInOrder(const std::vector<LocatedPoint>& points, Execution& execution)
{
  std::atomic<bool> inOrder{ points.empty() || points.front().crossing.edge != NoEdge };
  execution.forRanges(points.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t n = std::max<std::size_t>(first, 1); n < last; ++n)
      {
        if (points[n].crossing.edge == NoEdge || points[n].crossing.edge <= points[n - 1].crossing.edge)
        {
          inOrder = false;
          return;
        }
      }
    });
  return inOrder;
}

} // namespace

std::ptrdiff_t SurfaceCrossings::find(std::uint64_t edge) const
{
  const auto at = std::lower_bound(this->crossings.begin(), this->crossings.end(), edge,
    [](const LatticeCrossing& crossing, std::uint64_t key) { return crossing.edge < key; });
  return at != this->crossings.end() && at->edge == edge ? at - this->crossings.begin() : -1;
}

SurfaceCrossings locateCrossings(const Mesh& surface, const Lattice& lattice, CrossingSides sides, Execution& execution)
{
  const std::vector<Eigen::Vector3d> normals = sides == CrossingSides::Located ? pointNormals(surface) : std::vector<Eigen::Vector3d>();
  std::vector<LocatedPoint> all;
  resizeSideBySide(all, surface.points.size(), execution);
  execution.forRanges(all.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        if (locateCrossing(surface.points[i], lattice, all[i].crossing) && !normals.empty())
        {
          all[i].lowerInside = normals[i][axisOf(all[i].crossing.edge)] > 0.0;
        }
      }
    });
  SurfaceCrossings found;
  if (areInOrder(all, execution)) // as those of a surface made on this lattice are
  {
    resizeSideBySide(found.crossings, all.size(), execution);
    found.lowerInside.resize(normals.empty() ? 0 : all.size());
    execution.forRanges(all.size(), 4096,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          found.crossings[n] = all[n].crossing;
          if (!normals.empty())
          {
            found.lowerInside[n] = all[n].lowerInside;
          }
        }
      });
    return found;
  }
  std::sort(all.begin(), all.end());
  found.crossings.reserve(all.size());
  // Several points may lie on one edge of a strange surface: the first by position counts.
  for (const LocatedPoint& one : all)
  {
    found.ignoredPoints += one.crossing.edge == NoEdge;
    if (one.crossing.edge != NoEdge && (found.crossings.empty() || found.crossings.back().edge != one.crossing.edge))
    {
      found.crossings.push_back(one.crossing);
      if (!normals.empty())
      {
        found.lowerInside.push_back(one.lowerInside);
      }
    }
  }
  return found;
}

std::vector<std::uint16_t> shellVotes(
  const Octree& octree, const CornerShell& shell, const LatticeViews& views, Execution& execution)
{
  Unannounced voting(execution);
  return cornerVotes(shell, CellViews(octree, shell, views, voting), views, voting);
}

LatticeLabels::LatticeLabels(
  const Octree& octree, CornerShell shell, const PreparedViews& views, Execution& execution)
  : Far(octree)
  , Shell(std::move(shell))
{
  this->labelByVotes(shellVotes(octree, this->Shell, LatticeViews(views, octree.lattice), execution), execution);
}

LatticeLabels::LatticeLabels(const Octree& octree, CornerShell shell, const std::vector<std::uint16_t>& votes, Execution& execution)
  : Far(octree)
  , Shell(std::move(shell))
{
  this->labelByVotes(votes, execution);
}

void LatticeLabels::labelByVotes(const std::vector<std::uint16_t>& votes, Execution& execution)
{
  // Mostly the shell has no other cells than the octree's intersection octants, all of which it has.
  if (this->octree().count(OctantState::Intersection, this->octree().lattice.depth) == this->Shell.cells.size())
  {
    this->Survivor = largeVector<std::uint8_t>(this->Shell.cells.size(), 1);
  }
  else
  {
    this->setSurvivors(leafCells(this->octree(), OctantState::Intersection, execution), execution);
  }
  const int required = this->octree().viewCount - this->octree().backgroundVotes;
  resizeSideBySide(this->Support, votes.size(), execution);
  resizeSideBySide(this->Inside, votes.size(), execution);
  execution.forRanges(votes.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        this->Support[c] = votes[c];
        this->Inside[c] = votes[c] >= required && !this->octree().lattice.onBorder(fromMorton(this->Shell.corners[c]));
      }
    });
}

LatticeLabels::LatticeLabels(const Octree& octree, CornerShell shell, const SurfaceCrossings& crossings)
  : Far(octree)
  , Shell(std::move(shell))
  , Inside(Shell.corners.size(), Unknown)
  , Support(Shell.corners.size(), 0.0f)
{
  Execution alone;
  this->setSurvivors(leafCells(octree, OctantState::Intersection, alone), alone);
  this->fromOctree();
  const auto label = [&](std::ptrdiff_t corner, std::uint8_t value)
  {
    if (corner >= 0 && this->Inside[corner] == Unknown)
    {
      this->Inside[corner] = value;
    }
  };
  const auto upperEnd = [](std::uint64_t lower, int axis)
  { return mortonCode(fromMorton(lower) + LatticePoint{ axis == 0, axis == 1, axis == 2 }); };
  for (std::size_t i = 0; i < crossings.crossings.size(); ++i)
  {
    const std::uint64_t edge = crossings.crossings[i].edge;
    label(this->Shell.find(edge >> 2), crossings.lowerInside[i]);
    label(this->Shell.find(upperEnd(edge >> 2, axisOf(edge))), !crossings.lowerInside[i]);
  }
  this->spread(crossings);
  std::replace(this->Inside.begin(), this->Inside.end(), Unknown, std::uint8_t(0));
}

LatticeLabels::LatticeLabels(const Octree& octree, CornerShell shell, const BrickField& field, Execution& execution)
  : Far(octree, &field)
  , Shell(std::move(shell))
{
  if (!this->Shell.cells.empty())
  {
    this->setSurvivors(leafCells(octree, OctantState::Intersection, execution), execution);
  }
  resizeSideBySide(this->Inside, this->Shell.corners.size(), execution);
  resizeSideBySide(this->Support, this->Shell.corners.size(), execution);
  const auto& corners = this->Shell.corners;
  execution.forRanges(corners.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      OctantCursor octants(octree);
      for (std::size_t c = first; c < last;)
      {
        const std::uint64_t block = corners[c] >> 6;
        const std::uint64_t inside = this->Far.insideOfBlock(block, octants) & withinBorder(octree.lattice, block);
        const std::ptrdiff_t point = field.find(64 * block);
        for (; c < last && corners[c] >> 6 == block; ++c)
        {
          const std::uint64_t bit = corners[c] & 63;
          this->Inside[c] = std::uint8_t(inside >> bit & 1);
          this->Support[c] = point >= 0 ? field.values()[std::size_t(point) + bit] : 0.0f;
        }
      }
    });
}

/** Labels go along the edges that the surface does not cross, breadth first in lattice order. */
void LatticeLabels::spread(const SurfaceCrossings& crossings)
{
  std::vector<std::vector<std::uint32_t>> neighbours(this->Shell.corners.size());
  for (const auto& corners : this->Shell.cellCorners)
  {
    for (int e = 0; e < 12; ++e)
    {
      const std::uint32_t a = corners[edgeCorners[e][0]], b = corners[edgeCorners[e][1]];
      if ((this->Inside[a] == Unknown || this->Inside[b] == Unknown) &&
        crossings.find(edgeKey(this->Shell.corners[a], edgeAxis(e))) < 0)
      {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
      }
    }
  }
  std::deque<std::uint32_t> front;
  for (std::uint32_t c = 0; c < this->Inside.size(); ++c)
  {
    if (this->Inside[c] != Unknown)
    {
      front.push_back(c);
    }
  }
  for (; !front.empty(); front.pop_front())
  {
    for (const std::uint32_t next : neighbours[front.front()])
    {
      if (this->Inside[next] == Unknown)
      {
        this->Inside[next] = this->Inside[front.front()];
        front.push_back(next);
      }
    }
  }
}

void LatticeLabels::setSurvivors(const std::vector<std::uint64_t>& cells, Execution& execution)
{
  this->Survivor = largeVector<std::uint8_t>(this->Shell.cells.size());
  execution.forRanges(this->Shell.cells.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      auto next = std::lower_bound(cells.begin(), cells.end(), this->Shell.cells[first]);
      for (std::size_t cell = first; cell < last; ++cell)
      {
        while (next != cells.end() && *next < this->Shell.cells[cell])
        {
          ++next;
        }
        this->Survivor[cell] = next != cells.end() && *next == this->Shell.cells[cell];
      }
    });
}

void LatticeLabels::widen(CornerShell shell, Execution& execution)
{
  std::vector<std::uint8_t> inside;
  std::vector<float> support;
  resizeSideBySide(inside, shell.corners.size(), execution);
  resizeSideBySide(support, shell.corners.size(), execution);
  execution.forRanges(shell.corners.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      Corner known = std::lower_bound(this->Shell.corners.begin(), this->Shell.corners.end(), shell.corners[first]);
      OctantCursor octants(this->octree());
      std::uint64_t block = ~std::uint64_t(0), labels = 0; // of a block with further corners
      for (std::size_t c = first; c < last; ++c)
      {
        const std::uint64_t code = shell.corners[c];
        if (known != this->Shell.corners.end() && *known == code)
        {
          const auto at = std::size_t(known++ - this->Shell.corners.begin());
          inside[c] = this->Inside[at];
          support[c] = this->Support[at];
          continue;
        }
        if (code >> 6 != block)
        {
          block = code >> 6;
          labels = withinBorder(this->octree().lattice, block) & this->Far.insideOfBlock(block, octants);
        }
        inside[c] = std::uint8_t(labels >> (code & 63) & 1);
        support[c] = 0.0f;
      }
    });
  const std::vector<std::uint64_t> survivors = selected(
    this->Shell.cells.size(), [this](std::size_t cell) { return this->Survivor[cell] != 0; }, [this](std::size_t cell) { return this->Shell.cells[cell]; }, execution);
  this->Blocks.reset();
  this->Shell = std::move(shell);
  this->Inside = std::move(inside);
  this->Support = std::move(support);
  this->setSurvivors(survivors, execution);
}

void LatticeLabels::fromOctree()
{
  auto& known = this->Inside;
  const Lattice& lattice = this->octree().lattice;
  for (std::size_t c = 0; c < known.size(); ++c)
  {
    const LatticePoint p = fromMorton(this->Shell.corners[c]);
    if (lattice.onBorder(p))
    {
      known[c] = 0;
      continue;
    }
    bool inside = false, background = false;
    for (int n = 0; n < 8; ++n)
    {
      const LatticePoint o = cornerOffset(n);
      const auto state = this->octree().locate({ p.i - o.i, p.j - o.j, p.k - o.k }).state;
      inside |= state == OctantState::Inside;
      background |= state == OctantState::Background;
    }
    known[c] = background ? 0 : inside ? 1 : Unknown;
  }
}

void LatticeLabels::fillOctant(int generation, std::size_t index)
{
  this->Blocks.reset();
  this->Far.fillOctant(generation, index);
}

const LabelBlocks& LatticeLabels::blocks(Execution& execution) const
{
  if (!this->Blocks)
  {
    this->Blocks = std::make_shared<const LabelBlocks>(this->Shell, this->Far, execution);
  }
  return *this->Blocks;
}

bool LatticeLabels::insideAt(const LatticePoint& p) const
{
  if (this->octree().lattice.onBorder(p))
  {
    return false;
  }
  const std::uint64_t code = mortonCode(p);
  const std::ptrdiff_t place = this->Blocks ? this->Blocks->blocks().find(code >> 6) : -1;
  if (place >= 0)
  {
    return this->Blocks->inside(std::size_t(place), int(code & 63), this->Inside);
  }
  const std::ptrdiff_t corner = this->Blocks ? -1 : this->Shell.find(code);
  return corner >= 0 ? this->Inside[std::size_t(corner)] != 0 : this->Far.insideAt(p);
}

std::uint64_t LatticeLabels::insideOfBlock(std::uint64_t block) const
{
  const std::ptrdiff_t place = this->Blocks ? this->Blocks->blocks().find(block) : -1;
  if (place >= 0)
  {
    return this->Blocks->inside(std::size_t(place), this->Inside);
  }
  OctantCursor octants(this->octree());
  Corner corner = std::lower_bound(this->Shell.corners.begin(), this->Shell.corners.end(), 64 * block);
  return this->insideOfBlock(block, corner, octants);
}

std::vector<std::uint64_t> LatticeLabels::insideOfBlocks(const std::vector<std::uint64_t>& blocks, Execution& execution) const
{
  auto inside = largeVector<std::uint64_t>(blocks.size());
  const LabelBlocks& known = this->blocks(execution);
  execution.forRanges(blocks.size(), 256,
    [&](std::size_t first, std::size_t last)
    {
      OctantCursor octants(this->octree());
      for (std::size_t b = first; b < last; ++b)
      {
        const std::ptrdiff_t place = known.blocks().find(blocks[b]);
        inside[b] = place >= 0 ? known.inside(std::size_t(place), this->Inside)
                               : withinBorder(this->octree().lattice, blocks[b]) & this->Far.insideOfBlock(blocks[b], octants);
      }
    });
  return inside;
}

/** `corner`: the shell's first that is not before the block; then the first after it. */
std::uint64_t LatticeLabels::insideOfBlock(std::uint64_t block, Corner& corner, OctantCursor& octants) const
{
  const std::uint64_t within = withinBorder(this->octree().lattice, block);
  std::uint64_t known = 0, inside = 0;
  for (; corner != this->Shell.corners.end() && *corner >> 6 == block; ++corner)
  {
    known |= std::uint64_t(1) << (*corner & 63);
    inside |= std::uint64_t(this->Inside[std::size_t(corner - this->Shell.corners.begin())] != 0) << (*corner & 63);
  }
  const std::uint64_t unknown = within & ~known;
  if (unknown != 0)
  {
    inside |= unknown & this->Far.insideOfBlock(block, octants);
  }
  return inside & within;
}

int LatticeLabels::cellsAround(const LatticePoint& p, std::array<std::uint32_t, 8>& cells) const
{
  int count = 0;
  for (int n = 0; n < 8; ++n)
  {
    const LatticePoint o = cornerOffset(n);
    const auto cell = this->Shell.findCell({ p.i - o.i, p.j - o.j, p.k - o.k });
    if (cell >= 0 && this->Survivor[cell])
    {
      cells[count++] = std::uint32_t(cell);
    }
  }
  return count;
}

} // namespace silhouette
