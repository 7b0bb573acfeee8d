// SPDX-License-Identifier: BSD-3-Clause
#include "CornerShell.h"

#include <algorithm>

namespace silhouette
{
namespace
{

constexpr std::size_t BlockSize = 4096;

/** Corners of one block of cells: neighbours in Morton order share most of theirs. */
std::vector<std::uint64_t> cornersOfBlock(const CornerShell& shell, std::size_t first, std::size_t last)
{
  std::vector<std::uint64_t> corners;
  corners.reserve(8 * (last - first));
  for (std::size_t cell = first; cell < last; ++cell)
  {
    const LatticePoint p = fromMorton(shell.cells[cell]);
    for (int c = 0; c < 8; ++c)
    {
      corners.push_back(mortonCode(p + cornerOffset(c)));
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

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
  const std::size_t count = shell.cells.size();
  std::vector<std::vector<std::uint64_t>> blocks((count + BlockSize - 1) / BlockSize);
  const auto forBlocks = [&](const auto& work)
  {
    execution.forRanges(blocks.size(), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t b = first; b < last; ++b)
        {
          work(b, b * BlockSize, std::min(count, (b + 1) * BlockSize));
        }
      });
  };
  forBlocks([&](std::size_t b, std::size_t first, std::size_t last) { blocks[b] = cornersOfBlock(shell, first, last); });
  for (const auto& block : blocks)
  {
    shell.corners.insert(shell.corners.end(), block.begin(), block.end());
  }
  std::sort(shell.corners.begin(), shell.corners.end());
  shell.corners.erase(std::unique(shell.corners.begin(), shell.corners.end()), shell.corners.end());

  shell.cellCorners.resize(count);
  forBlocks(
    [&](std::size_t b, std::size_t first, std::size_t last)
    {
      const auto& local = blocks[b];
      std::vector<std::uint32_t> global(local.size());
      auto from = shell.corners.begin();
      for (std::size_t i = 0; i < local.size(); ++i)
      {
        from = std::lower_bound(from, shell.corners.end(), local[i]);
        global[i] = std::uint32_t(from - shell.corners.begin());
      }
      for (std::size_t cell = first; cell < last; ++cell)
      {
        const LatticePoint p = fromMorton(shell.cells[cell]);
        for (int c = 0; c < 8; ++c)
        {
          const auto at = std::lower_bound(local.begin(), local.end(), mortonCode(p + cornerOffset(c)));
          shell.cellCorners[cell][c] = global[at - local.begin()];
        }
      }
    });
  return shell;
}

std::vector<std::uint64_t> leafCells(const Octree& octree, OctantState state)
{
  std::vector<std::uint64_t> cells;
  if (octree.generations.empty())
  {
    return cells;
  }
  const auto& last = octree.last();
  for (std::size_t i = 0; i < last.size(); ++i)
  {
    if (last.state[i] == state)
    {
      cells.push_back(last.code[i]);
    }
  }
  return cells;
}

} // namespace silhouette
