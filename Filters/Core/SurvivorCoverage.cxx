// SPDX-License-Identifier: BSD-3-Clause
#include "SurvivorCoverage.h"

#include "ExactPredicates.h"
#include "MeshCheck.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>

namespace silhouette
{

namespace
{

using Point = Eigen::Vector3d;
using Corners = std::array<Point, 3>;

constexpr std::size_t Block = 2048; ///< triangles whose ray hits are written to one place
constexpr std::size_t Batches = 8;  ///< times that a run asks whether it is cancelled

/** The lattice's planes and its cells' centres along each axis, as Lattice::coordinate has them. */
struct Grid
{
  explicit Grid(const Lattice& lattice)
    : cells(lattice.cells())
    , edge(lattice.leafEdge())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (std::int32_t t = 0; t <= this->cells; ++t)
      {
        this->plane[axis].push_back(lattice.coordinate(axis, t));
        this->centre[axis].push_back(lattice.coordinate(axis, t + 0.5));
      }
    }
  }

  std::int32_t cells;
  double edge;
  std::array<std::vector<double>, 3> plane;
  std::array<std::vector<double>, 3> centre;
};

/** Cells [first, last) along an axis. */
struct CellRange
{
  std::int32_t first = 0;
  std::int32_t last = 0;
};

/**
 * The least t in 0 to n for which `holds`, which is false and then true; `guess` may be off. n where none.
 */
template <typename Holds>
std::int32_t firstThat(std::int32_t n, double guess, Holds&& holds)
{
  auto t = std::int32_t(std::clamp(std::isfinite(guess) ? guess : 0.0, 0.0, double(n)));
  while (t > 0 && holds(t - 1))
  {
    --t;
  }
  while (t < n && !holds(t))
  {
    ++t;
  }
  return t;
}

/** The cells whose open interval meets [low, high]. */
CellRange cellsMet(const Grid& grid, int axis, double low, double high)
{
  const std::vector<double>& plane = grid.plane[axis];
  CellRange range;
  range.first = firstThat(grid.cells, std::floor((low - plane[0]) / grid.edge),
    [&](std::int32_t t) { return plane[t + 1] > low; });
  range.last = firstThat(grid.cells, std::ceil((high - plane[0]) / grid.edge),
    [&](std::int32_t t) { return plane[t] >= high; });
  return range;
}

/** Are all corners of the rectangle on one side of the directed line, or on it? -1 right, 1 left, 0 no. */
int sideOfLine(
  const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& low, const Eigen::Vector2d& high)
{
  // The corners farthest to the left and to the right of the line's direction.
  const Eigen::Vector2d left(q[1] > p[1] ? low[0] : high[0], q[0] > p[0] ? high[1] : low[1]);
  const Eigen::Vector2d right(q[1] > p[1] ? high[0] : low[0], q[0] > p[0] ? low[1] : high[1]);
  if (orient2d(p, q, left) <= 0)
  {
    return -1;
  }
  return orient2d(p, q, right) >= 0 ? 1 : 0;
}

/** Seen along an axis: does an edge of the triangle keep the open rectangle outside of it? */
bool edgeSeparates(int axis, const Corners& t, const Point& low, const Point& high)
{
  const auto flat = [axis](const Point& p) { return Eigen::Vector2d(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
  const std::array<Eigen::Vector2d, 3> f{ flat(t[0]), flat(t[1]), flat(t[2]) };
  const int turn = orient2d(f[0], f[1], f[2]);
  for (int c = 0; c < 3; ++c)
  {
    if (f[c] == f[(c + 1) % 3])
    {
      continue;
    }
    const int side = sideOfLine(f[c], f[(c + 1) % 3], flat(low), flat(high));
    // A triangle seen from its edge is a line, which separates with either side.
    if (side != 0 && side != turn)
    {
      return true;
    }
  }
  return false;
}

bool planeSeparates(const Corners& t, const Point& low, const Point& high)
{
  bool above = false;
  bool below = false;
  for (int c = 0; c < 8 && !(above && below); ++c)
  {
    const Point corner(c & 1 ? high[0] : low[0], c & 2 ? high[1] : low[1], c & 4 ? high[2] : low[2]);
    const int side = orient3d(t[0], t[1], t[2], corner);
    above = above || side > 0;
    below = below || side < 0;
  }
  // A degenerate triangle has no plane; edges seen along the axes decide.
  return above != below;
}

bool strictlyWithin(const Point& p, const Point& low, const Point& high)
{
  return (p.array() > low.array()).all() && (p.array() < high.array()).all();
}

/**
 * Triangle and open box are apart iff one of the separating axes of box and triangle (three of the box, the
 * triangle's normal, nine cross products of edges) has them apart, touching allowed. The nine are lines in
 * the plane, seen along an axis.
 */
bool meetsOpenBox(const Corners& t, const Point& low, const Point& high)
{
  if (strictlyWithin(t[0], low, high) || strictlyWithin(t[1], low, high) || strictlyWithin(t[2], low, high))
  {
    return true;
  }
  const Point least = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
  const Point greatest = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  if ((least.array() >= high.array()).any() || (greatest.array() <= low.array()).any())
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (edgeSeparates(axis, t, low, high))
    {
      return false;
    }
  }
  return !planeSeparates(t, low, high);
}

using Cells = std::array<CellRange, 3>;

Cells cellsOfTriangle(const Grid& grid, const Corners& t)
{
  Cells cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax({ t[0][axis], t[1][axis], t[2][axis] });
    cells[axis] = cellsMet(grid, axis, low, high);
  }
  return cells;
}

/** Does the triangle meet the open cube of a block of cells, each of which its box meets on every axis? */
bool meetsBlock(const Grid& grid, const Cells& cells, bool oneCell, const Corners& t)
{
  const Point low(
    grid.plane[0][cells[0].first], grid.plane[1][cells[1].first], grid.plane[2][cells[2].first]);
  const Point high(grid.plane[0][cells[0].last], grid.plane[1][cells[1].last], grid.plane[2][cells[2].last]);
  // A triangle within one closed cell that lies in none of its faces has its centroid in the open one.
  const auto within = [&](const Point& p)
  { return (p.array() >= low.array()).all() && (p.array() <= high.array()).all(); };
  return (oneCell && within(t[0]) && within(t[1]) && within(t[2])) || meetsOpenBox(t, low, high);
}

/** Calls visit(cell) for the cells of the block whose open cube the triangle meets; halves the block. */
template <typename Visit>
void visitCellsMet(const Grid& grid, const Cells& cells, const Corners& t, Visit&& visit)
{
  int longest = 0;
  std::int32_t size = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int32_t length = cells[axis].last - cells[axis].first;
    if (length <= 0)
    {
      return;
    }
    longest = length > size ? axis : longest;
    size = std::max(size, length);
  }
  if (!meetsBlock(grid, cells, size == 1, t))
  {
    return;
  }
  if (size == 1)
  {
    visit(LatticePoint{ cells[0].first, cells[1].first, cells[2].first });
    return;
  }
  Cells half = cells;
  half[longest].last = cells[longest].first + size / 2;
  visitCellsMet(grid, half, t, visit);
  half[longest] = { cells[longest].first + size / 2, cells[longest].last };
  visitCellsMet(grid, half, t, visit);
}

/** An octant's row along x and its place in it, in one number that sorts by row. */
std::uint64_t rowKey(std::int32_t i, std::int32_t j, std::int32_t k)
{
  return std::uint64_t(k) << 40 | std::uint64_t(j) << 20 | std::uint64_t(i);
}

/**
 * Seen along x: on which side of line p q is the row's centre, moved by (e, e^2) for an infinitely small e >
 * 0? Never 0 but for p = q, and the opposite for q p.
 */
int sideOfEdge(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& centre)
{
  const int side = orient2d(p, q, centre);
  if (side != 0)
  {
    return side;
  }
  if (p[1] != q[1])
  {
    return q[1] > p[1] ? -1 : 1;
  }
  return q[0] > p[0] ? 1 : (q[0] < p[0] ? -1 : 0);
}

/**
 * Calls hit(t, j, k) for each row (j, k) of centres whose line passes the triangle: the centres of cells 0 to
 * t - 1 of that row lie before it.
 */
template <typename Hit>
void visitRowHits(const Grid& grid, const Corners& t, Hit&& hit)
{
  const auto flat = [](const Point& p) { return Eigen::Vector2d(p[1], p[2]); };
  const std::array<Eigen::Vector2d, 3> f{ flat(t[0]), flat(t[1]), flat(t[2]) };
  const int turn = orient2d(f[0], f[1], f[2]);
  if (turn == 0)
  {
    return;
  }
  const Cells cells = cellsOfTriangle(grid, t);
  const Point normal = (t[1] - t[0]).cross(t[2] - t[0]);
  for (std::int32_t k = cells[2].first; k < cells[2].last; ++k)
  {
    for (std::int32_t j = cells[1].first; j < cells[1].last; ++j)
    {
      const Eigen::Vector2d centre(grid.centre[1][j], grid.centre[2][k]);
      if (sideOfEdge(f[0], f[1], centre) != turn || sideOfEdge(f[1], f[2], centre) != turn ||
        sideOfEdge(f[2], f[0], centre) != turn)
      {
        continue;
      }
      const Eigen::Vector2d offset = centre - f[0];
      const double x = t[0][0] - (offset[0] * normal[1] + offset[1] * normal[2]) / normal[0];
      const auto behind = [&](std::int32_t i)
      { return orient3d(t[0], t[1], t[2], { grid.centre[0][i], centre[0], centre[1] }) == turn; };
      const double guess = std::ceil((x - grid.centre[0][0]) / grid.edge);
      hit(firstThat(grid.cells, guess, behind), j, k);
    }
  }
}

/** The lattice of the last generation. */
Lattice lastLattice(const Octree& octree)
{
  if (octree.generations.empty())
  {
    throw InvalidInput("an octree without generations");
  }
  Lattice lattice = octree.lattice;
  lattice.depth = int(octree.generations.size()) - 1;
  return lattice;
}

Corners cornersOf(const Mesh& mesh, std::size_t t)
{
  const Triangle& triangle = mesh.triangles[t];
  return { mesh.points[triangle[0]], mesh.points[triangle[1]], mesh.points[triangle[2]] };
}

void markCrossed(const Octree& octree, const Grid& grid, const Mesh& mesh, Execution& execution,
  std::vector<Coverage>& coverage)
{
  const std::vector<std::uint64_t>& codes = octree.last().code;
  // Several triangles may mark one octant at the same time: all write the same.
  const std::unique_ptr<std::atomic<bool>[]> crossed(new std::atomic<bool>[codes.size()]);
  std::for_each_n(crossed.get(), codes.size(), [](std::atomic<bool>& c) { c.store(false); });
  const auto mark = [&](const LatticePoint& cell)
  {
    const std::uint64_t code = mortonCode(cell);
    const auto place = std::lower_bound(codes.begin(), codes.end(), code);
    if (place != codes.end() && *place == code)
    {
      crossed[std::size_t(place - codes.begin())].store(true, std::memory_order_relaxed);
    }
  };
  for (std::size_t batch = 0; batch < Batches; ++batch)
  {
    execution.checkpoint(double(batch) / Batches);
    const std::size_t begin = mesh.triangles.size() * batch / Batches;
    execution.forRanges(mesh.triangles.size() * (batch + 1) / Batches - begin, 256,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t t = begin + first; t < begin + last; ++t)
        {
          const Corners corners = cornersOf(mesh, t);
          visitCellsMet(grid, cellsOfTriangle(grid, corners), corners, mark);
        }
      });
  }
  for (std::size_t o = 0; o < codes.size(); ++o)
  {
    coverage[o] = crossed[o].load() ? Coverage::Crossed : Coverage::Lost;
  }
}

/** All places, sorted, where the surface passes a row of centres. */
std::vector<std::uint64_t> rowHits(const Grid& grid, const Mesh& mesh, Execution& execution)
{
  const std::size_t count = mesh.triangles.size();
  std::vector<std::vector<std::uint64_t>> blocks((count + Block - 1) / Block);
  for (std::size_t batch = 0; batch < Batches; ++batch)
  {
    execution.checkpoint(double(batch) / Batches);
    const std::size_t firstBlock = blocks.size() * batch / Batches;
    execution.forRanges(blocks.size() * (batch + 1) / Batches - firstBlock, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t b = firstBlock + first; b < firstBlock + last; ++b)
        {
          for (std::size_t t = b * Block; t < std::min(count, (b + 1) * Block); ++t)
          {
            visitRowHits(grid, cornersOf(mesh, t), [&](std::int32_t i, std::int32_t j, std::int32_t k)
              { blocks[b].push_back(rowKey(i, j, k)); });
          }
        }
      });
  }
  std::vector<std::uint64_t> hits;
  for (const auto& block : blocks)
  {
    hits.insert(hits.end(), block.begin(), block.end());
  }
  std::sort(hits.begin(), hits.end());
  return hits;
}

void markEnclosed(const Octree& octree, const Grid& grid, const Mesh& mesh, Execution& execution,
  std::vector<Coverage>& coverage)
{
  std::vector<std::size_t> open;
  for (std::size_t o = 0; o < coverage.size(); ++o)
  {
    if (coverage[o] == Coverage::Lost && octree.last().state[o] != OctantState::Background)
    {
      open.push_back(o);
    }
  }
  if (open.empty())
  {
    return;
  }
  const std::vector<std::uint64_t> hits = rowHits(grid, mesh, execution);
  execution.forRanges(open.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t o = first; o < last; ++o)
      {
        const LatticePoint cell = fromMorton(octree.last().code[open[o]]);
        // Hits of this row that lie behind the centre: those of i + 1 to the row's end.
        const auto behind = std::upper_bound(hits.begin(), hits.end(), rowKey(cell.i, cell.j, cell.k));
        const auto end = std::upper_bound(behind, hits.end(), rowKey(grid.cells, cell.j, cell.k));
        if ((end - behind) % 2 != 0)
        {
          coverage[open[o]] = Coverage::Enclosed;
        }
      }
    });
}

} // namespace

bool triangleMeetsOpenCells(const Lattice& lattice, const LatticePoint& low, const LatticePoint& high,
  const Point& a, const Point& b, const Point& c)
{
  return meetsOpenBox({ a, b, c }, lattice.position(low), lattice.position(high));
}

std::vector<Coverage> survivorCoverage(const Octree& octree, const Mesh& mesh, Execution& execution)
{
  checkMesh(mesh);
  const Grid grid(lastLattice(octree));
  std::vector<Coverage> coverage(octree.last().size(), Coverage::Lost);
  Phase crossing(execution, 0.0, 0.5);
  markCrossed(octree, grid, mesh, crossing, coverage);
  Phase enclosing(execution, 0.5, 1.0);
  markEnclosed(octree, grid, mesh, enclosing, coverage);
  execution.progress(1.0);
  return coverage;
}

std::uint64_t lostSurvivors(const Octree& octree, const Mesh& mesh, Execution& execution)
{
  const std::vector<Coverage> coverage = survivorCoverage(octree, mesh, execution);
  std::uint64_t lost = 0;
  for (std::size_t o = 0; o < coverage.size(); ++o)
  {
    lost += coverage[o] == Coverage::Lost && octree.last().state[o] != OctantState::Background;
  }
  return lost;
}

} // namespace silhouette
