// SPDX-License-Identifier: BSD-3-Clause
#include "CornerShell.h"

#include "Bits.h"
#include "BlockBits.h"
#include "BlockWords.h"
#include "CodeCursor.h"
#include "FirstTouch.h"
#include "IndicesWhere.h"
#include "LargePages.h"
#include "NumberedCount.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace silhouette
{
namespace
{

/**
 * The corners of a block's cells, in the block itself and, bit d of the index for a step on axis d, in the blocks
 * beyond.
 */
std::array<std::uint64_t, 8> cornersOf(std::uint64_t cells)
{
  std::array<std::uint64_t, 8> corners{ cells };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int unit = 1 << axis;
    for (int n = 0; n < unit; ++n)
    {
      const std::uint64_t bits = corners[n];
      corners[n] = bits | fromBehind(bits, 0, axis);
      corners[n | unit] = fromBehind(0, bits, axis);
    }
  }
  return corners;
}

/** Morton code of the block one step further on each axis whose bit is set in `steps`. */
std::uint64_t blockBeyond(std::uint64_t block, int steps)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (steps >> axis & 1)
    {
      besideBlock(block, axis, true, block);
    }
  }
  return block;
}

/** Where corner c of the n-th cell of a block is: 64 times the block it is in (as cornersOf) and its bit there. */
struct CornerPlaces
{
  std::uint16_t at[64][8];
  CornerPlaces()
  {
    for (int n = 0; n < 64; ++n)
    {
      for (int c = 0; c < 8; ++c)
      {
        const LatticePoint p = fromMorton(std::uint64_t(n)) + cornerOffset(c);
        const int beyond = (p.i >> 2) | (p.j >> 2) << 1 | (p.k >> 2) << 2;
        at[n][c] = std::uint16_t(64 * beyond + int(mortonCode({ p.i & 3, p.j & 3, p.k & 3 })));
      }
    }
  }
};

/** A cell block's share in a block of corners. */
struct Share
{
  BlockWord word;
  std::uint32_t source; ///< eight times the number of the cell block, and the index of cornersOf
};

/** Makes a shell block by block: whole words of cells become words of corners. */
class ShellMaker
{
public:
  ShellMaker(CornerShell& shell, Execution& execution)
    : Shell(shell)
    , Exec(execution)
  {
  }

  void make()
  {
    this->FirstCell = blockStarts(this->Shell.cells, this->Exec);
    this->Cells = blockWords(this->Shell.cells, this->FirstCell, this->Exec);
    this->shareCorners();
    this->nameCorners();
    this->nameCellCorners();
  }

private:
  template <typename Work>
  void forBlocks(std::size_t count, const Work& work)
  {
    this->Exec.forRanges(count, 1024,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t b = first; b < last; ++b)
        {
          work(b);
        }
      });
  }

  /** What each block of cells has in blocks of corners, joined. */
  void shareCorners()
  {
    const auto forShares = [&](std::size_t b, const auto& add)
    {
      const auto corners = cornersOf(this->Cells[b].bits);
      for (int n = 0; n < 8; ++n)
      {
        if (corners[n] != 0)
        {
          add(Share{ { blockBeyond(this->Cells[b].block, n), corners[n] }, std::uint32_t(8 * b + n) });
        }
      }
    };
    std::vector<Share> shares = collectParts<Share>(this->Cells.size(), forShares, this->Exec);
    // A step on any axis may carry into that axis's next bit, three above, in blocks before the last one too.
    const int cellBits = shares.empty() ? 0 : highestBit(this->Cells.back().block | 1) + 1;
    resizeLarge(this->Target, 8 * this->Cells.size());
    this->Corners = joinParts(
      shares, cellBits + 3, [&](const Share& share, std::size_t b) { this->Target[share.source] = std::uint32_t(b); }, this->Exec);
    resizeLarge(this->FirstCorner, this->Corners.size() + 1);
    std::transform(this->Corners.begin(), this->Corners.end(), this->FirstCorner.begin() + 1, [](const BlockWord& word) { return std::uint32_t(countBits(word.bits)); });
    numberedCount(std::accumulate(this->FirstCorner.begin(), this->FirstCorner.end(), std::size_t(0)), "corners of cells");
    std::partial_sum(this->FirstCorner.begin(), this->FirstCorner.end(), this->FirstCorner.begin());
  }

  void nameCorners()
  {
    resizeSideBySide(this->Shell.corners, this->FirstCorner.back(), this->Exec);
    this->forBlocks(this->Corners.size(),
      [&](std::size_t b)
      {
        std::size_t at = this->FirstCorner[b];
        for (std::uint64_t bits = this->Corners[b].bits; bits != 0; bits &= bits - 1)
        {
          this->Shell.corners[at++] = this->Corners[b].block << 6 | std::uint64_t(lowestBit(bits));
        }
      });
  }

  void nameCellCorners()
  {
    static const CornerPlaces places;
    resizeLarge(this->Shell.cellCorners, this->Shell.cells.size());
    this->forBlocks(this->Cells.size(),
      [&](std::size_t b)
      {
        std::array<std::uint32_t, 512> index; // of the corners that this block's cells have, by place
        const auto corners = cornersOf(this->Cells[b].bits);
        for (std::size_t n = 0; n < 8; ++n)
        {
          const std::uint32_t target = corners[n] != 0 ? this->Target[8 * b + n] : 0;
          for (std::uint64_t bits = corners[n]; bits != 0; bits &= bits - 1)
          {
            const int bit = lowestBit(bits);
            const std::uint64_t before = this->Corners[target].bits & ((std::uint64_t(1) << bit) - 1);
            index[64 * n + bit] = this->FirstCorner[target] + std::uint32_t(countBits(before));
          }
        }
        for (std::size_t cell = this->FirstCell[b]; cell < this->FirstCell[b + 1]; ++cell)
        {
          const auto& at = places.at[this->Shell.cells[cell] & 63];
          for (int c = 0; c < 8; ++c)
          {
            this->Shell.cellCorners[cell][c] = index[at[c]];
          }
        }
      });
  }

  CornerShell& Shell;
  Execution& Exec;
  std::vector<BlockWord> Cells;           ///< blocks of cells, ascending
  std::vector<std::size_t> FirstCell;     ///< of each block, and the end
  std::vector<BlockWord> Corners;         ///< blocks of corners, ascending
  std::vector<std::uint32_t> FirstCorner; ///< of each block, and the end
  std::vector<std::uint32_t> Target;      ///< for each share of a cell block the block of corners
};

/** Two lists of codes without a code in common, each ascending, and where their codes come to in one. */
struct Merged
{
  std::vector<std::uint64_t> codes;
  std::vector<std::uint32_t> placesOfMany, placesOfFew;

  Merged(const std::vector<std::uint64_t>& many, const std::vector<std::uint64_t>& few, Execution& execution)
  {
    resizeSideBySide(this->codes, numberedCount(many.size() + few.size(), "corners of cells"), execution);
    this->place(many, few, this->placesOfMany, execution);
    this->place(few, many, this->placesOfFew, execution);
  }

private:
  void place(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& others, std::vector<std::uint32_t>& places, Execution& execution)
  {
    resizeSideBySide(places, own.size(), execution);
    execution.forRanges(own.size(), 4096,
      [&](std::size_t first, std::size_t last)
      {
        auto other = std::lower_bound(others.begin(), others.end(), own[first]);
        for (std::size_t n = first; n < last; ++n)
        {
          while (other != others.end() && *other < own[n])
          {
            ++other;
          }
          places[n] = std::uint32_t(n + std::size_t(other - others.begin()));
          this->codes[places[n]] = own[n];
        }
      });
  }
};

} // namespace

std::ptrdiff_t CornerShell::find(std::uint64_t corner) const
{
  const auto at = std::lower_bound(this->corners.begin(), this->corners.end(), corner);
  return at != this->corners.end() && *at == corner ? at - this->corners.begin() : -1;
}

std::ptrdiff_t CornerShell::findCell(const LatticePoint& cell) const
{
  if (cell.i < 0 || cell.j < 0 || cell.k < 0)
  {
    return -1;
  }
  const std::uint64_t code = mortonCode(cell);
  const auto at = std::lower_bound(this->cells.begin(), this->cells.end(), code);
  return at != this->cells.end() && *at == code ? at - this->cells.begin() : -1;
}

CornerShell makeCornerShell(std::vector<std::uint64_t> cells, Execution& execution)
{
  CornerShell shell;
  shell.cells = std::move(cells);
  ShellMaker(shell, execution).make();
  return shell;
}

CornerShell withCells(const CornerShell& shell, const std::vector<std::uint64_t>& others, Execution& execution)
{
  std::vector<std::uint64_t> cells;
  std::set_difference(others.begin(), others.end(), shell.cells.begin(), shell.cells.end(), std::back_inserter(cells));
  if (cells.size() > shell.cells.size() / 8)
  {
    return makeCornerShell(united(shell.cells, cells), execution);
  }
  const CornerShell added = makeCornerShell(std::move(cells), execution);
  auto known = largeVector<std::ptrdiff_t>(added.corners.size()); // among the shell's
  execution.forRanges(known.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      CodeCursor own(shell.corners);
      std::transform(added.corners.begin() + std::ptrdiff_t(first), added.corners.begin() + std::ptrdiff_t(last), known.begin() + std::ptrdiff_t(first),
        [&](std::uint64_t corner) { return own.find(corner); });
    });
  const auto corners = selected(known.size(), [&](std::size_t n) { return known[n] < 0; }, [&](std::size_t n) { return added.corners[n]; }, execution);
  Merged mergedCorners(shell.corners, corners, execution), mergedCells(shell.cells, added.cells, execution);
  auto places = largeVector<std::uint32_t>(known.size()); // of the added cells' corners
  auto next = mergedCorners.placesOfFew.begin();
  std::transform(known.begin(), known.end(), places.begin(),
    [&](std::ptrdiff_t own) { return own < 0 ? *next++ : mergedCorners.placesOfMany[std::size_t(own)]; });

  CornerShell wider;
  wider.corners = std::move(mergedCorners.codes);
  wider.cells = std::move(mergedCells.codes);
  resizeLarge(wider.cellCorners, wider.cells.size());
  const auto rename = [&](const std::vector<CellCorners>& from, const std::vector<std::uint32_t>& cellPlaces, const std::vector<std::uint32_t>& cornerPlaces)
  {
    execution.forRanges(from.size(), 4096,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t cell = first; cell < last; ++cell)
        {
          std::transform(from[cell].begin(), from[cell].end(), wider.cellCorners[cellPlaces[cell]].begin(),
            [&](std::uint32_t corner) { return cornerPlaces[corner]; });
        }
      });
  };
  rename(shell.cellCorners, mergedCells.placesOfMany, mergedCorners.placesOfMany);
  rename(added.cellCorners, mergedCells.placesOfFew, places);
  return wider;
}

std::vector<std::uint64_t> leafCells(const Octree& octree, OctantState state, Execution& execution)
{
  if (octree.generations.empty())
  {
    return {};
  }
  const auto& last = octree.last();
  return selected(
    last.size(), [&](std::size_t i) { return last.state[i] == state; }, [&](std::size_t i) { return last.code[i]; }, execution);
}

std::vector<std::uint64_t> leafCells(const Octree& octree, OctantState state)
{
  Execution alone;
  return leafCells(octree, state, alone);
}

} // namespace silhouette
