// SPDX-License-Identifier: BSD-3-Clause
#include "IntersectionAround.h"

#include "BlockBits.h"
#include "BlockIndex.h"

#include <array>

namespace silhouette
{
namespace
{

/** Cells by blocks of 4 x 4 x 4. */
struct CellBlocks
{
  BlockIndex blocks;
  std::vector<std::uint64_t> cells; ///< of each, a bit each

  explicit CellBlocks(const Octree& octree)
  {
    const Generation& leaves = octree.last();
    std::vector<std::uint64_t> codes;
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
    {
      if (leaves.state[leaf] == OctantState::Intersection)
      {
        const std::uint64_t code = leaves.code[leaf];
        if (codes.empty() || codes.back() != code >> 6)
        {
          codes.push_back(code >> 6);
          this->cells.push_back(0);
        }
        this->cells.back() |= std::uint64_t(1) << (code & 63);
      }
    }
    this->blocks = BlockIndex(std::move(codes));
  }

  std::uint64_t of(std::uint64_t block) const
  {
    const std::ptrdiff_t at = this->blocks.find(block);
    return at < 0 ? 0 : this->cells[std::size_t(at)];
  }
};

/** Bit i of byte n to bit n of byte i: a square of bits transposed by halves. */
std::uint64_t transposed(std::uint64_t square)
{
  const auto swap = [&](int distance, std::uint64_t mask)
  {
    const std::uint64_t differing = (square ^ square >> distance) & mask;
    square ^= differing ^ differing << distance;
  };
  swap(7, 0x00aa00aa00aa00aaULL);
  swap(14, 0x0000cccc0000ccccULL);
  swap(28, 0x00000000f0f0f0f0ULL);
  return square;
}

/** For each point of a block the bits of the cells around it. */
using AroundPoints = std::array<std::uint8_t, 64>;

AroundPoints aroundPoints(const std::array<std::uint64_t, 8>& words)
{
  AroundPoints around;
  for (unsigned first = 0; first < 64; first += 8)
  {
    std::uint64_t square = 0;
    for (unsigned n = 0; n < 8; ++n)
    {
      square |= (words[n] >> first & 0xff) << 8 * n;
    }
    square = transposed(square);
    for (unsigned n = 0; n < 8; ++n)
    {
      around[first + n] = std::uint8_t(square >> 8 * n);
    }
  }
  return around;
}

} // namespace

std::vector<std::uint8_t> intersectionAround(const Octree& octree, const CornerShell& shell, Execution& execution)
{
  const CellBlocks blocks(octree);
  std::vector<std::uint8_t> around(shell.corners.size());
  execution.forRanges(around.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      std::uint64_t block = ~std::uint64_t(0);
      AroundPoints ofBlock{};
      for (std::size_t c = first; c < last; ++c)
      {
        const std::uint64_t code = shell.corners[c];
        if (code >> 6 != block)
        {
          block = code >> 6;
          ofBlock = aroundPoints(cellsBehind(block, [&](std::uint64_t other) { return blocks.of(other); }));
        }
        around[c] = ofBlock[code & 63];
      }
    });
  return around;
}

} // namespace silhouette
