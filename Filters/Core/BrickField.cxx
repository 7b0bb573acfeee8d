// SPDX-License-Identifier: BSD-3-Clause
#include "BrickField.h"

#include "Bits.h"
#include "BlockBits.h"
#include "FirstTouch.h"
#include "LargePages.h"
#include "LatticeSurface.h"

#include <algorithm>
#include <array>

namespace silhouette
{
namespace
{

/** Where a field is positive and not on the root cube's border, by blocks of 4 x 4 x 4 points: eight of each brick, a bit a point. */
class BlockSigns
{
public:
  BlockSigns(const BrickField& field, Execution& execution)
    : Field(field)
    , Positive(field.size() / 64)
  {
    execution.forRanges(this->Positive.size(), 256,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t block = first; block < last; ++block)
        {
          this->Positive[block] = positiveBits(&field.values()[64 * block]) & withinBorder(field.lattice(), field.code(64 * block) / 64);
        }
      });
  }

  /** Cells of the n-th block that have values at all corners, of both signs; a bit each, by their lowest corners. `bricks`: of the field. */
  std::uint64_t mixedCells(std::size_t n, BrickCursor& bricks) const
  {
    const LatticePoint block = fromMorton(this->Field.code(64 * n) / 64);
    std::array<std::uint64_t, 8> signs, known; // of the block and those ahead of it, then of the points one step ahead on the axes of their numbers
    bool anyPositive = false, anyOther = false;
    for (int ahead = 0; ahead < 8; ++ahead)
    {
      const std::ptrdiff_t other = ahead == 0 ? std::ptrdiff_t(64 * n) : bricks.find(64 * mortonCode(block + cornerOffset(ahead)));
      known[std::size_t(ahead)] = other >= 0 ? ~std::uint64_t(0) : 0;
      signs[std::size_t(ahead)] = other >= 0 ? this->Positive[std::size_t(other) / 64] : 0;
      anyPositive = anyPositive || signs[std::size_t(ahead)] != 0;
      anyOther = anyOther || (~signs[std::size_t(ahead)] & known[std::size_t(ahead)]) != 0;
    }
    if (!(anyPositive && anyOther))
    {
      return 0;
    }
    std::uint64_t all = ~std::uint64_t(0), any = 0, allKnown = ~std::uint64_t(0);
    bringCorners(signs);
    bringCorners(known);
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      all &= signs[corner];
      any |= signs[corner];
      allKnown &= known[corner];
    }
    return any & ~all & allKnown;
  }

private:
  const BrickField& Field;
  std::vector<std::uint64_t> Positive;
};

/**
 * The bricks that cells of one brick ask for. Along each axis a cell asks for those from one of two on, to one of two: there are no more than 64 kinds
 * of cells in a brick, and each kind is asked once.
 */
class BricksAsked
{
public:
  BricksAsked(const Lattice& lattice, int margin)
    : Margin(margin)
    , Greatest(lattice.cells() / BrickField::BrickSize)
    , First(-((margin + BrickField::BrickSize - 1) / BrickField::BrickSize))
    , Last((1 + margin) / BrickField::BrickSize)
    , Side(this->Last + 1 - this->First + 1)
    , Asked(std::size_t(this->Side) * this->Side * this->Side, 0)
  {
  }

  /** The most bricks that one brick's cells ask for. */
  std::size_t most() const { return this->Asked.size(); }

  /** A cell of the same brick as all since appendTo(). */
  void add(std::uint64_t cell)
  {
    this->Brick = fromMorton(cell / BrickField::BrickPoints);
    const LatticePoint p = fromMorton(cell % BrickField::BrickPoints);
    this->Kinds |= std::uint64_t(1) << (this->kindOf(p.i) + 4 * this->kindOf(p.j) + 16 * this->kindOf(p.k));
  }

  void appendTo(std::vector<std::uint64_t>& bricks)
  {
    for (; this->Kinds != 0; this->Kinds &= this->Kinds - 1)
    {
      this->ask(lowestBit(this->Kinds));
    }
    for (std::size_t n = 0; n < this->Asked.size(); ++n)
    {
      const int x = int(n) % this->Side, y = int(n) / this->Side % this->Side, z = int(n) / this->Side / this->Side;
      const LatticePoint q = this->Brick + LatticePoint{ this->First + x, this->First + y, this->First + z };
      if (this->Asked[n] && std::min({ q.i, q.j, q.k }) >= 0 && std::max({ q.i, q.j, q.k }) <= this->Greatest)
      {
        bricks.push_back(mortonCode(q));
      }
    }
    std::fill(this->Asked.begin(), this->Asked.end(), std::uint8_t(0));
  }

private:
  /** By a coordinate within the brick: bit 0 where the first brick is one later, bit 1 where the last is. */
  int kindOf(int x) const
  {
    const int size = BrickField::BrickSize;
    return int(x - this->Margin >= size * (this->First + 1)) | int(x + 1 + this->Margin >= size * (this->Last + 1)) << 1;
  }

  void ask(int kind)
  {
    const auto first = [&](int axis) { return kind >> 2 * axis & 1; };
    const auto last = [&](int axis) { return this->Last - this->First + (kind >> (2 * axis + 1) & 1); };
    for (int z = first(2); z <= last(2); ++z)
    {
      for (int y = first(1); y <= last(1); ++y)
      {
        const auto row = this->Asked.begin() + this->Side * (y + this->Side * z);
        std::fill(row + first(0), row + last(0) + 1, std::uint8_t(1));
      }
    }
  }

  int Margin;
  int Greatest; ///< coordinate of a brick
  int First;    ///< that any cell asks for, from its own on
  int Last;     ///< that all cells ask for
  int Side;
  std::vector<std::uint8_t> Asked;
  LatticePoint Brick;
  std::uint64_t Kinds = 0;
};

} // namespace

std::vector<std::uint64_t> bricksAround(
  const Lattice& lattice, const std::vector<std::uint64_t>& cells, int margin, Execution& execution)
{
  constexpr std::size_t RangeSize = 1 << 15; // cells
  std::vector<std::vector<std::uint64_t>> ofRanges((cells.size() + RangeSize - 1) / RangeSize);
  execution.forRanges(ofRanges.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      BricksAsked asked(lattice, margin);
      for (std::size_t range = first; range < last; ++range)
      {
        std::vector<std::uint64_t>& bricks = ofRanges[range];
        const std::size_t end = std::min((range + 1) * RangeSize, cells.size());
        for (std::size_t n = range * RangeSize; n < end; ++n)
        {
          asked.add(cells[n]);
          if (n + 1 == end || cells[n + 1] / BrickField::BrickPoints != cells[n] / BrickField::BrickPoints)
          {
            asked.appendTo(bricks);
            if (bricks.size() > (std::size_t(1) << 16) && bricks.capacity() - bricks.size() < asked.most())
            {
              sortUnique(bricks);
            }
          }
        }
        sortUnique(bricks);
      }
    });
  std::vector<std::uint64_t> bricks;
  for (const auto& some : ofRanges)
  {
    bricks.insert(bricks.end(), some.begin(), some.end());
  }
  sortUnique(bricks);
  return bricks;
}

BrickField::BrickField(const Lattice& lattice, const std::vector<std::uint64_t>& cells, int margin, Execution& execution)
  : TheLattice(lattice)
  , Bricks(bricksAround(lattice, cells, margin, execution))
{
  resizeSideBySide(this->Values, this->Bricks.size() * BrickPoints, execution);
}

void BrickField::keepBricks(const std::vector<std::uint8_t>& keep)
{
  std::size_t kept = 0;
  for (std::size_t brick = 0; brick < this->Bricks.size(); ++brick)
  {
    if (keep[brick] != 0)
    {
      if (kept != brick)
      {
        this->Bricks[kept] = this->Bricks[brick];
        std::copy_n(&this->Values[brick * BrickPoints], BrickPoints, &this->Values[kept * BrickPoints]);
      }
      ++kept;
    }
  }
  this->Bricks.resize(kept);
  this->Values.resize(kept * BrickPoints);
}

std::ptrdiff_t BrickField::findBrick(std::uint64_t brick) const
{
  const auto at = std::lower_bound(this->Bricks.begin(), this->Bricks.end(), brick);
  return at != this->Bricks.end() && *at == brick ? at - this->Bricks.begin() : -1;
}

std::ptrdiff_t BrickField::find(std::uint64_t point) const
{
  const std::ptrdiff_t brick = this->findBrick(point / BrickPoints);
  return brick < 0 ? -1 : brick * std::ptrdiff_t(BrickPoints) + std::ptrdiff_t(point % BrickPoints);
}

std::vector<std::uint64_t> BrickField::mixedCells(Execution& execution) const
{
  const BlockSigns signs(*this, execution);
  std::vector<std::uint64_t> mixed(this->size() / 64), cells;
  execution.forRanges(mixed.size(), 128,
    [&](std::size_t first, std::size_t last)
    {
      BrickCursor bricks(*this);
      for (std::size_t block = first; block < last; ++block)
      {
        mixed[block] = signs.mixedCells(block, bricks);
      }
    });
  for (std::size_t block = 0; block < mixed.size(); ++block)
  {
    for (std::uint64_t left = mixed[block]; left != 0; left &= left - 1)
    {
      const std::uint64_t cell = this->code(64 * block) + std::uint64_t(lowestBit(left));
      if (this->TheLattice.hasCell(fromMorton(cell)))
      {
        cells.push_back(cell);
      }
    }
  }
  return cells;
}

Mesh BrickField::contourMesh(Execution& execution) const
{
  const CornerShell shell = makeCornerShell(this->mixedCells(execution), execution);
  auto value = largeVector<float>(shell.corners.size());
  auto inside = largeVector<std::uint8_t>(shell.corners.size());
  execution.forRanges(value.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        value[c] = this->Values[this->find(shell.corners[c])];
        inside[c] = value[c] > 0.0f && !this->TheLattice.onBorder(fromMorton(shell.corners[c]));
      }
    });
  const LatticeSurface surface = contour(shell, inside, execution);
  Mesh mesh;
  mesh.triangles = surface.triangles;
  resizeLarge(mesh.points, surface.edges.size());
  execution.forRanges(mesh.points.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t e = first; e < last; ++e)
      {
        const CrossedEdge& edge = surface.edges[e];
        const double a = value[edge.inside], b = value[edge.outside];
        const double t = std::clamp(a / (a - b), CrossingMargin, 1.0 - CrossingMargin);
        mesh.points[e] = crossingPosition(this->TheLattice, shell, edge, t);
      }
    });
  return mesh;
}

} // namespace silhouette
