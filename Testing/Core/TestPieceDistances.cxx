// SPDX-License-Identifier: BSD-3-Clause
#include "PieceDistances.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

constexpr int Width = 300;

/** A row of pixels, and distances within the columns that any image may have. */
struct Row
{
  std::vector<std::uint8_t> pixels;
  std::vector<std::int16_t> inColumn;

  Row(Random& random, int run, int most)
  {
    std::uint8_t kind = 0;
    while (int(this->pixels.size()) < Width)
    {
      kind ^= 1;
      this->pixels.insert(this->pixels.end(), std::size_t(1 + random.below(run)), kind);
    }
    this->pixels.resize(Width);
    for (int c = 0; c < Width; ++c)
    {
      this->inColumn.push_back(std::int16_t(1 + random.below(most)));
    }
  }
};

/** For each sample of each piece: the least over all columns within `most`. */
template <typename Square>
void check(const Row& row, int spacing, int most, Square limit)
{
  const PieceColumns columns(spacing, most, Width / (TileSize * spacing) + 1);
  EXPECT_EQ(columns.isDense(), spacing == 1);
  for (const std::uint8_t kind : { 0, 1 })
  {
    RowSquares<Square> squares;
    squares.columns.resize(std::size_t(Width + 2 * most + TileSize * spacing));
    squares.groups.resize(squares.columns.size());
    squareColumns({ row.pixels.data(), row.inColumn.data(), Width }, kind, most, limit, columns, squares);
    for (int first = 0; first + columns.length() <= int(squares.columns.size()); first += TileSize * spacing)
    {
      float distances[TileSize];
      measurePiece(first, columns, squares, distances);
      for (int n = 0; n < TileSize; ++n)
      {
        const int column = first + n * spacing;
        long least = 1L << 40;
        for (int c = column - most; c <= column + most; ++c)
        {
          const int own = std::min(c, Width - 1); // beyond the last it goes on
          const long square = c < 0 ? long(limit) : row.pixels[std::size_t(own)] != kind ? 0 : long(row.inColumn[std::size_t(own)]) * row.inColumn[std::size_t(own)];
          least = std::min(least, square + long(c - column) * (c - column));
        }
        ASSERT_EQ(distances[n], std::sqrt(float(least)) - 0.5f) << spacing << " " << most << " " << column;
      }
    }
  }
}

} // namespace

TEST(PieceDistances, AreTheLeastOfAllColumns)
{
  Random random(5);
  for (const int most : { 1, 3, 8, 9, 16, 17, 40, 126 })
  {
    for (const int run : { 3, 30, 200 })
    {
      const Row row(random, run, most + 1);
      for (const int spacing : { 1, 2, 5 })
      {
        check<std::int16_t>(row, spacing, most, std::int16_t((most + 1) * (most + 1)));
        check<std::int32_t>(row, spacing, most, (most + 1) * (most + 1));
      }
    }
  }
}

TEST(PieceDistances, LongerOnesThanSixteenBitsHold)
{
  Random random(6);
  const Row row(random, 250, 400);
  check<std::int32_t>(row, 1, 280, 400 * 400);
}
