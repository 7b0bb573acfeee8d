// SPDX-License-Identifier: BSD-3-Clause
#include "RaisingWeights.h"

#include "Bits.h"
#include "FieldSmoothing.h"
#include "RadixSort.h"
#include "Vectorised.h"

#include <algorithm>

namespace silhouette
{
namespace
{

constexpr float LeastWeight = 0.01f; ///< of the Gaussian's: below it nothing is raised
constexpr int BrickSide = BrickField::BrickSize;

/** A window of bits around a brick: rows along the first axis, `side` a plane; the brick begins `radius` further on along each axis. */
struct Window
{
  const std::uint64_t* rows;
  int side;
  int radius;
};

/** Sums along the first axis: of each row of the window eight values, those in the brick's columns. */
SILHOUETTE_VECTORISED void sumAlong(const Window& window, const float* steps, float* along)
{
  for (int row = 0; row < window.side * window.side; ++row, along += BrickSide)
  {
    float sums[BrickSide] = {};
    for (std::uint64_t bits = window.rows[row]; bits != 0; bits &= bits - 1)
    {
      const float* const step = steps + BrickSide * lowestBit(bits);
      for (int i = 0; i < BrickSide; ++i)
      {
        sums[i] += step[i];
      }
    }
    std::copy(sums, sums + BrickSide, along);
  }
}

/** Sums over `2 radius + 1` rows, each `step` values after the last, of which the first begins at `rows`. */
inline void sumRow(const float* rows, std::size_t step, const float* kernel, int radius, float* out)
{
  float sums[BrickSide] = {};
  for (int d = -radius; d <= radius; ++d, rows += step)
  {
    const float weight = kernel[d < 0 ? -d : d];
    for (int i = 0; i < BrickSide; ++i)
    {
      sums[i] += weight * rows[i];
    }
  }
  std::copy(sums, sums + BrickSide, out);
}

/** Sums along the second axis, in the brick's rows of each plane, and then along the third, in its planes. */
SILHOUETTE_VECTORISED void sumAcross(const Window& window, const float* kernel, const float* along, float* across, float* sums)
{
  for (int k = 0; k < window.side; ++k)
  {
    for (int j = 0; j < BrickSide; ++j)
    {
      sumRow(along + (k * window.side + j) * BrickSide, BrickSide, kernel, window.radius, across + (k * BrickSide + j) * BrickSide);
    }
  }
  for (int row = 0; row < BrickSide * BrickSide; ++row)
  {
    sumRow(across + row * BrickSide, std::size_t(BrickSide * BrickSide), kernel, window.radius, sums + row * BrickSide);
  }
}

/** Corners of some cells, ascending, none twice. */
std::vector<std::uint64_t> cornersOf(const std::vector<std::uint64_t>& cells, Execution& execution)
{
  std::vector<std::uint64_t> corners(8 * cells.size());
  execution.forRanges(cells.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t c = 8 * first; c < 8 * last; ++c)
      {
        corners[c] = mortonCode(fromMorton(cells[c / 8]) + cornerOffset(int(c % 8)));
      }
    });
  radixSort(corners, 3 * (MaximumDepth + 1), [](std::uint64_t code) { return code; }, execution);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::size_t rowOf(const LatticePoint& inBrick)
{
  return std::size_t(inBrick.j + BrickSide * inBrick.k);
}

/** Where a brick's points, in Morton order, are among its rows. */
std::array<std::uint16_t, BrickField::BrickPoints> placesInRows()
{
  std::array<std::uint16_t, BrickField::BrickPoints> places{};
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    const LatticePoint p = fromMorton(n);
    places[n] = std::uint16_t(rowOf(p) * std::size_t(BrickSide) + std::size_t(p.i));
  }
  return places;
}

} // namespace

RaisingWeights::RaisingWeights(const std::vector<std::uint64_t>& cells, double width, Execution& execution)
  : Kernel(gaussianKernel(width))
  , Radius(int(this->Kernel.size()) - 1)
{
  // What is left at the corners of a cell that is alone: nowhere less is left at one's, but for rounding.
  const double alone = double(this->Kernel[0]) + double(this->Kernel[1]);
  this->Gain = float(1.001 / (alone * alone * alone));
  for (int place = 0; place < Side + 2 * this->Radius; ++place)
  {
    for (int i = 0; i < Side; ++i)
    {
      const int away = std::abs(place - this->Radius - i);
      this->Steps.push_back(away <= this->Radius ? this->Kernel[std::size_t(away)] : 0.0f);
    }
  }
  for (const std::uint64_t corner : cornersOf(cells, execution))
  {
    const std::uint64_t brick = corner / BrickField::BrickPoints;
    if (this->Bricks.empty() || this->Bricks.back() != brick)
    {
      this->Bricks.push_back(brick);
      this->Corners.emplace_back(Bits{});
    }
    const LatticePoint p = fromMorton(corner % BrickField::BrickPoints);
    std::uint8_t& row = this->Corners.back()[rowOf(p)];
    row = std::uint8_t(row | 1 << p.i);
  }
}

const RaisingWeights::Bits* RaisingWeights::bitsOf(std::uint64_t brick) const
{
  const auto found = std::lower_bound(this->Bricks.begin(), this->Bricks.end(), brick);
  return found != this->Bricks.end() && *found == brick ? &this->Corners[std::size_t(found - this->Bricks.begin())] : nullptr;
}

std::vector<std::uint8_t> RaisingWeights::near(const BrickField& field) const
{
  const int reach = (this->Radius + Side - 1) / Side;
  std::vector<std::uint8_t> near(field.bricks().size(), 0);
  BrickCursor bricks(field); // neighbours have neighbours in common
  for (const std::uint64_t code : this->Bricks)
  {
    const LatticePoint brick = fromMorton(code);
    for (LatticePoint p{ 0, 0, brick.k - reach }; p.k <= brick.k + reach; ++p.k)
    {
      for (p.j = brick.j - reach; p.j <= brick.j + reach; ++p.j)
      {
        for (p.i = brick.i - reach; p.i <= brick.i + reach; ++p.i)
        {
          const std::ptrdiff_t point = std::min({ p.i, p.j, p.k }) < 0 ? -1 : bricks.find(mortonCode(p) * BrickField::BrickPoints);
          if (point >= 0)
          {
            near[std::size_t(point) / BrickField::BrickPoints] = 1;
          }
        }
      }
    }
  }
  return near;
}

RaisingWeights::Brick::Brick(const RaisingWeights& weights)
  : All(weights)
{
  const std::size_t side = std::size_t(Side + 2 * weights.Radius);
  this->Rows.resize(side * side);
  this->Along.resize(side * side * Side);
  this->Across.resize(side * Side * Side);
}

/** The bits of the corners in the window around the brick. */
void RaisingWeights::Brick::collect()
{
  const int radius = this->All.Radius, side = Side + 2 * radius, reach = (radius + Side - 1) / Side;
  const LatticePoint middle = fromMorton(this->Code);
  std::fill(this->Rows.begin(), this->Rows.end(), 0);
  for (int n = 0, across = 2 * reach + 1; n < across * across * across; ++n)
  {
    const LatticePoint step{ n % across - reach, n / across % across - reach, n / across / across - reach };
    const LatticePoint brick = middle + step;
    const Bits* const bits = std::min({ brick.i, brick.j, brick.k }) < 0 ? nullptr : this->All.bitsOf(mortonCode(brick));
    if (!bits)
    {
      continue;
    }
    const int i = Side * step.i + radius, j = Side * step.j + radius, k = Side * step.k + radius; // of its first point in the window
    for (int z = std::max(k, 0); z < std::min(k + Side, side); ++z)
    {
      for (int y = std::max(j, 0); y < std::min(j + Side, side); ++y)
      {
        const std::uint64_t row = (*bits)[std::size_t(y - j + Side * (z - k))];
        this->Rows[std::size_t(side * z + y)] |= i < 0 ? row >> -i : row << i;
      }
    }
  }
  const std::uint64_t within = ~std::uint64_t(0) >> (64 - side);
  std::transform(this->Rows.begin(), this->Rows.end(), this->Rows.begin(), [within](std::uint64_t row) { return row & within; });
}

void RaisingWeights::Brick::moveTo(std::uint64_t brick)
{
  if (this->Code == brick)
  {
    return;
  }
  this->Code = brick;
  this->collect();
  if (std::all_of(this->Rows.begin(), this->Rows.end(), [](std::uint64_t row) { return row == 0; }))
  {
    this->Weights.fill(0.0f);
    return;
  }
  const Window window{ this->Rows.data(), Side + 2 * this->All.Radius, this->All.Radius };
  float sums[BrickField::BrickPoints];
  sumAlong(window, this->All.Steps.data(), this->Along.data());
  sumAcross(window, this->All.Kernel.data(), this->Along.data(), this->Across.data(), sums);
  static const auto places = placesInRows();
  for (std::size_t n = 0; n < BrickField::BrickPoints; ++n)
  {
    const float w = std::min(1.0f, this->All.Gain * sums[places[n]]);
    this->Weights[n] = w < LeastWeight ? 0.0f : w * w * (3.0f - 2.0f * w);
  }
}

} // namespace silhouette
