// SPDX-License-Identifier: BSD-3-Clause
#include "BlobFilling.h"

#include "BlockBits.h"
#include "OctantTest.h"
#include "PointBlocks.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace silhouette
{
namespace
{

constexpr int TileSize = 64;            ///< pixels: of a piece of work, a row being a word
constexpr int LeastTestedLevel = 2;     ///< boxes of 2^level points a side are tested in the other views,
constexpr int GreatestTestedLevel = 6;  ///< from those that are about a tile on
constexpr std::size_t TilesAtATime = 32; ///< for each thread, between two looks at cancellation

/** Where points are looked for: corners within reach of a view's blobs, a word for a block, and cubes of them. */
struct Region
{
  std::vector<BlockWord> words; ///< ascending
  std::vector<PointCube> cubes; ///< ascending
};

/** The blocks of cubes from which a step along an axis leads out of all cubes: what is near cubes but in none is near one of these. */
std::vector<BlockWord> outermost(const std::vector<PointCube>& cubes)
{
  const auto isInCube = [&](const PointCube& box)
  {
    const PointCube* cube = cubeOf(cubes, box.corner);
    return cube != nullptr && cube->side >= box.side;
  };
  std::vector<std::uint64_t> blocks;
  const auto addBlock = [&](const LatticePoint& beside, const CubeFace& face)
  {
    std::uint64_t block = 0;
    besideBlock(mortonCode(beside) >> 6, face.axis, !face.ahead, block);
    blocks.push_back(block);
  };
  for (const PointCube& cube : cubes)
  {
    forBlocksBeside(cube, isInCube, addBlock);
  }
  sortUnique(blocks);
  std::vector<BlockWord> words;
  for (const std::uint64_t block : blocks)
  {
    words.push_back({ block, ~std::uint64_t(0) });
  }
  return words;
}

Region regionOf(const Blobs& blobs, int steps, Execution& execution)
{
  PointBlocks near(unitedWords(blobs.words, outermost(blobs.cubes)));
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int step = 0; step < steps; ++step)
    {
      execution.checkpoint(0.0);
      near = near.spread(axis, execution);
    }
  }
  return { near.words(), blobs.cubes };
}

/** What of a region is in a box: words and cubes by their places, or all of it. */
struct Part
{
  std::size_t firstWord = 0, lastWord = 0;
  std::size_t firstCube = 0, lastCube = 0;
  bool isAll = false;

  bool isEmpty() const { return !this->isAll && this->firstWord == this->lastWord && this->firstCube == this->lastCube; }
};

/** Of `part` what is of the corners whose codes are [from, from + count), an octant's, `count` being a power of eight. */
Part partOf(const Region& region, Part part, std::uint64_t from, std::uint64_t count)
{
  const auto cubes = region.cubes.begin();
  part.firstCube = std::size_t(std::partition_point(cubes + std::ptrdiff_t(part.firstCube), cubes + std::ptrdiff_t(part.lastCube),
                                 [&](const PointCube& cube) { return cube.end() <= from; }) - cubes);
  part.lastCube = std::size_t(std::partition_point(cubes + std::ptrdiff_t(part.firstCube), cubes + std::ptrdiff_t(part.lastCube),
                                [&](const PointCube& cube) { return cube.corner < from + count; }) - cubes);
  part.isAll = part.firstCube < part.lastCube && region.cubes[part.firstCube].corner <= from && region.cubes[part.firstCube].end() >= from + count;
  const auto words = region.words.begin();
  const auto firstFrom = [&](std::uint64_t block)
  {
    return std::size_t(std::partition_point(words + std::ptrdiff_t(part.firstWord), words + std::ptrdiff_t(part.lastWord),
                         [&](const BlockWord& word) { return word.block < block; }) - words);
  };
  if (count >= 64)
  {
    part.firstWord = firstFrom(from >> 6);
    part.lastWord = firstFrom((from + count) >> 6);
  }
  else if (part.firstWord < part.lastWord) // the one word of the block that this is a part of
  {
    const std::uint64_t bits = (std::uint64_t(1) << count) - 1, own = region.words[part.firstWord].bits >> (from & 63) & bits;
    part.isAll = part.isAll || own == bits;
    part.lastWord = part.firstWord + (own != 0 ? 1 : 0);
  }
  return part;
}

/** Pixels of a tile, in columns and rows of the tile. */
struct PixelBox
{
  int firstColumn = 0, lastColumn = TileSize - 1;
  int firstRow = 0, lastRow = TileSize - 1;
};

/** One tile of a view's image: the search of all boxes that fall into it. */
class Tile
{
public:
  Tile(const LatticeViews& fine, const Region& region, int halvings, int view)
    : Fine(fine)
    , TheRegion(region)
    , Halvings(halvings)
    , View(view)
    , Root(fine.lattice().depth + 1) // one more than the lattice's, since there is a point more than there are octants
    , Undecided(std::size_t(this->Root) + 2)
  {
  }

  /** Fill the tile from a pixel of the image on. Returns how many pixels were filled. */
  std::uint64_t fill(BinaryImage& mask, int column, int row)
  {
    this->Column = column;
    this->Row = row;
    this->Mask = &mask;
    this->Filled = 0;
    std::uint64_t any = 0;
    for (int r = 0; r < TileSize; ++r)
    {
      std::uint64_t bits = 0;
      for (int c = 0; c < TileSize && row + r < mask.height && column + c < mask.width; ++c)
      {
        bits |= std::uint64_t(mask.at(column + c, row + r) == 0) << c;
      }
      this->Left[r] = bits;
      any |= bits;
    }
    if (any != 0)
    {
      auto& all = this->Undecided.back();
      all.clear();
      for (int i = 0; i < this->Fine.size(); ++i)
      {
        if (i != this->View)
        {
          all.push_back(std::uint16_t(i));
        }
      }
      this->search({ 0, 0, 0 }, this->Root, { 0, this->TheRegion.words.size(), 0, this->TheRegion.cubes.size(), false }, all, 0);
    }
    return this->Filled;
  }

  std::uint64_t looks() const { return this->Looks; }

private:
  using Views = std::vector<std::uint16_t>;

  /**
   * A box of 2^level points a side. Its coordinates count from half an octant before the lattice's, so that an octant of them is around a corner. `undecided`:
   * the views of which it is not known that they see nothing but object or nothing at all, the last that called a box background being the first; `object`: of
   * the others those that see object.
   */
  void search(const LatticePoint& low, int level, Part part, Views& undecided, int object)
  {
    ++this->Looks;
    if (level >= this->Halvings && !part.isAll)
    {
      const std::uint64_t corner = mortonCode({ low.i >> this->Halvings, low.j >> this->Halvings, low.k >> this->Halvings });
      part = partOf(this->TheRegion, part, corner, std::uint64_t(1) << 3 * (level - this->Halvings));
    }
    if (part.isEmpty() || !this->isAnyLeft(low, level))
    {
      return;
    }
    Views* still = &undecided;
    if (level >= LeastTestedLevel && level <= GreatestTestedLevel && !undecided.empty())
    {
      still = &this->Undecided[std::size_t(level)];
      if (!this->decide(low, level, undecided, *still, object))
      {
        return;
      }
    }
    if (level == 0)
    {
      this->ask(this->pointOf(low), *still, object);
      return;
    }
    const std::int32_t half = std::int32_t(1) << (level - 1);
    for (int c = 0; c < 8; ++c)
    {
      const LatticePoint o = cornerOffset(c);
      this->search({ low.i + half * o.i, low.j + half * o.j, low.k + half * o.k }, level - 1, part, *still, object);
    }
  }

  LatticePoint pointOf(const LatticePoint& low) const
  {
    const std::int32_t half = (std::int32_t(1) << this->Halvings) / 2;
    return { low.i - half, low.j - half, low.k - half };
  }

  /** May a point of the box fall into a pixel that is not filled? */
  bool isAnyLeft(const LatticePoint& low, int level) const
  {
    PixelBox box;
    if (!this->boxOf(low, level, box))
    {
      return false;
    }
    const std::uint64_t columns = ~std::uint64_t(0) >> (TileSize - 1 - (box.lastColumn - box.firstColumn)) << box.firstColumn;
    return std::any_of(this->Left + box.firstRow, this->Left + box.lastRow + 1, [columns](std::uint64_t bits) { return (bits & columns) != 0; });
  }

  /** The tile's pixels that points of a box may fall into; false if there are none. */
  bool boxOf(const LatticePoint& low, int level, PixelBox& box) const
  {
    const LatticeProjection& projection = this->Fine.projection(this->View);
    const LatticePoint first = this->pointOf(low);
    const std::int32_t reach = (std::int32_t(1) << level) - 1;
    double least[2], most[2];
    int behind = 0;
    for (int c = 0; c < (level == 0 ? 1 : 8); ++c)
    {
      const LatticePoint o = cornerOffset(c);
      const auto h = projection({ first.i + reach * o.i, first.j + reach * o.j, first.k + reach * o.k });
      behind += !(h.W > projection.minimumDepth);
      const double image[2] = { h.U / h.W - this->Column, h.V / h.W - this->Row };
      for (int axis = 0; axis < 2; ++axis)
      {
        least[axis] = c == 0 ? image[axis] : std::min(least[axis], image[axis]);
        most[axis] = c == 0 ? image[axis] : std::max(most[axis], image[axis]);
      }
    }
    if (behind > 0)
    {
      return level > 0 && behind < 8; // any pixel
    }
    const double guard = 0.5 + OctantGuard;
    if (most[0] < -guard || most[1] < -guard || least[0] >= TileSize - 1 + guard || least[1] >= TileSize - 1 + guard)
    {
      return false;
    }
    box.firstColumn = int(std::clamp(least[0] + 0.5 - OctantGuard, 0.0, TileSize - 1.0));
    box.lastColumn = int(std::clamp(most[0] + 0.5 + OctantGuard, 0.0, TileSize - 1.0));
    box.firstRow = int(std::clamp(least[1] + 0.5 - OctantGuard, 0.0, TileSize - 1.0));
    box.lastRow = int(std::clamp(most[1] + 0.5 + OctantGuard, 0.0, TileSize - 1.0));
    return true;
  }

  /** Ask the views about a whole box; false if one calls it background, or too few call it object. */
  bool decide(const LatticePoint& low, int level, Views& undecided, Views& still, int& object) const
  {
    still.clear();
    const OctantBox box{ this->pointOf(low), (std::int32_t(1) << level) - 1 };
    for (std::size_t n = 0; n < undecided.size(); ++n)
    {
      const int i = undecided[n];
      switch (relate(this->Fine.view(i), this->Fine.projection(i), box))
      {
        case ViewRelation::Background:
          std::swap(undecided[0], undecided[n]);
          return false;
        case ViewRelation::Inside:
          ++object;
          break;
        case ViewRelation::Abstain:
          break;
        default:
          still.push_back(std::uint16_t(i));
      }
    }
    return 2 * (object + int(still.size())) >= this->Fine.size();
  }

  /** Fill a point's pixel if no other view calls the point background and half of all call it object. */
  void ask(const LatticePoint& p, Views& undecided, int object)
  {
    const LatticeProjection& projection = this->Fine.projection(this->View);
    const auto h = projection(p);
    if (!isOfLattice(p, this->Fine.lattice().cells()) || !(h.W > projection.minimumDepth))
    {
      return;
    }
    const int column = PreparedView::nearestPixel(h.U / h.W, this->Mask->width) - this->Column;
    const int row = PreparedView::nearestPixel(h.V / h.W, this->Mask->height) - this->Row;
    if (column < 0 || row < 0 || column >= TileSize || row >= TileSize || (this->Left[row] >> column & 1) == 0)
    {
      return;
    }
    for (std::size_t n = 0; n < undecided.size(); ++n)
    {
      const Vote vote = this->Fine.vote(undecided[n], p);
      object += vote == Vote::Object;
      if (vote == Vote::Background)
      {
        std::swap(undecided[0], undecided[n]);
        return;
      }
    }
    if (2 * object >= this->Fine.size())
    {
      this->Left[row] &= ~(std::uint64_t(1) << column);
      this->Mask->at(this->Column + column, this->Row + row) = 1;
      ++this->Filled;
    }
  }

  const LatticeViews& Fine;
  const Region& TheRegion;
  int Halvings;
  int View;
  int Root;
  std::vector<Views> Undecided; ///< by level, and all others
  int Column = 0;               ///< of the image, where the tile begins
  int Row = 0;
  BinaryImage* Mask = nullptr;
  std::uint64_t Left[TileSize] = {}; ///< of each row the pixels that are background
  std::uint64_t Filled = 0;
  std::uint64_t Looks = 0;
};

/** Fill the tiles of one view, side by side: no two of them have a pixel in common. */
void fillView(const LatticeViews& fine, const Region& region, int halvings, int view, BinaryImage& mask, BlobFilling& filling, Execution& execution)
{
  const std::size_t columns = std::size_t((mask.width + TileSize - 1) / TileSize), rows = std::size_t((mask.height + TileSize - 1) / TileSize);
  const std::size_t atATime = TilesAtATime * std::size_t(std::max(execution.threads(), 1));
  for (std::size_t from = 0; from < columns * rows; from += atATime)
  {
    execution.checkpoint(0.0);
    const std::size_t count = std::min(atATime, columns * rows - from);
    std::vector<std::uint64_t> pixels(count), looks(count);
    execution.forRanges(count, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          Tile tile(fine, region, halvings, view);
          pixels[n] = tile.fill(mask, TileSize * int((from + n) % columns), TileSize * int((from + n) / columns));
          looks[n] = tile.looks();
        }
      });
    filling.pixels[std::size_t(view)] = std::accumulate(pixels.begin(), pixels.end(), filling.pixels[std::size_t(view)]);
    filling.looks = std::accumulate(looks.begin(), looks.end(), filling.looks);
  }
}

} // namespace

BlobFilling fillBlobs(const LatticeViews& fine, const std::vector<Blobs>& blobs, const BlobReach& reach, std::vector<View>& repaired, Execution& execution)
{
  BlobFilling filling;
  filling.pixels.assign(blobs.size(), 0);
  for (std::size_t view = 0; view < blobs.size(); ++view)
  {
    if (!blobs[view].empty())
    {
      const Region region = regionOf(blobs[view], reach.steps, execution);
      fillView(fine, region, reach.halvings, int(view), repaired[view].silhouette, filling, execution);
    }
  }
  return filling;
}

} // namespace silhouette
