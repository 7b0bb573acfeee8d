// SPDX-License-Identifier: BSD-3-Clause
/**
 * Distances from the pixels of a row to the nearest pixel of the other kind, for a piece of sixteen samples at a time, from the distances within the
 * columns: the second half of a distance transform (A. Meijster, J. Roerdink, W. Hesselink, A general algorithm for computing distance transforms in linear
 * time, 2000), by brute force that stops early, in vectors.
 */
#pragma once

#include <cstdint>
#include <vector>

namespace silhouette
{

constexpr int TileSize = 16;      ///< samples of a piece, and pixels that are classified together
constexpr int LongestShort = 127; ///< px: two squares of distances up to here add up within sixteen bits

/** For pixels of one kind of a row: the squares of the distances within the columns, 0 at pixels of the other kind; and the least of groups of them. */
template <typename Square>
struct RowSquares
{
  std::vector<Square> columns;
  std::vector<Square> groups;
  std::vector<Square> arranged; ///< the columns as samples find them that lie apart
};

/** How the samples of the pieces of a row, each of TileSize, find the columns around them in a buffer of squares that begins `most` columns before the first piece. */
class PieceColumns
{
public:
  /** For up to `pieces` of a row. */
  PieceColumns(int spacing, int most, int pieces)
    : Spacing(spacing)
    , Most(most)
    , Before((most + spacing - 1) / spacing)
    , Lane(pieces * TileSize + 2 * this->Before + 1)
  {
    for (int d = -most; d <= most; ++d)
    {
      const int steps = (d + this->Before * spacing) / spacing - this->Before, rest = d - steps * spacing;
      this->Offsets.push_back(spacing == 1 ? d + most : rest * this->Lane + steps + this->Before);
    }
  }

  int most() const { return this->Most; }
  /** Are the columns of neighbouring samples neighbours? */
  bool isDense() const { return this->Spacing == 1; }
  /** Of columns in a piece and around it. */
  int length() const { return TileSize * this->Spacing + 2 * this->Most; }
  /** Where the columns begin that are `d` off each sample, in the order of the samples. */
  int offset(int d) const { return this->Offsets[std::size_t(d + this->Most)]; }

  /** The columns of a row in the samples' order: those that are equally far off a sample lie side by side. */
  template <typename Square>
  void arrange(RowSquares<Square>& squares) const
  {
    if (this->isDense())
    {
      return;
    }
    squares.arranged.resize(std::size_t(this->Spacing * this->Lane));
    for (int rest = 0; rest < this->Spacing; ++rest)
    {
      Square* const lane = &squares.arranged[std::size_t(rest * this->Lane)];
      const int first = this->Most + rest - this->Before * this->Spacing; // of the lane's first column; may be missing
      for (int n = first < 0 ? 1 : 0; n < this->Lane && first + n * this->Spacing < int(squares.columns.size()); ++n)
      {
        lane[n] = squares.columns[std::size_t(first + n * this->Spacing)];
      }
    }
  }

  /** Those of a piece, whose columns begin `first` into the row's, as offset() counts. */
  template <typename Square>
  const Square* ofPiece(const RowSquares<Square>& squares, int first) const
  {
    return this->isDense() ? squares.columns.data() + first : squares.arranged.data() + first / this->Spacing;
  }

private:
  int Spacing;
  int Most;
  int Before; ///< samples before the first and after the last that hold `most` columns
  int Lane;   ///< length of a lane: columns of one remainder by the spacing
  std::vector<int> Offsets;
};

/** Some pixels of a row, and their distances within the columns. */
struct RowPixels
{
  const std::uint8_t* pixels;
  const std::int16_t* inColumn;
  int count;
};

/**
 * Squares for one kind of pixels, 0 or 1; columns and groups have their lengths. `before` columns of the limit's square come first; after the row's last column that
 * one goes on.
 */
void squareColumns(const RowPixels& row, std::uint8_t kind, int before, std::int16_t limit, const PieceColumns& columns, RowSquares<std::int16_t>& squares);
void squareColumns(const RowPixels& row, std::uint8_t kind, int before, std::int32_t limit, const PieceColumns& columns, RowSquares<std::int32_t>& squares);

/**
 * Distances, px, of a piece's samples if they are of the squares' kind, to the contour half a pixel before the nearest of the other kind; its columns begin
 * `first` into the row's. Cost: up to the distance itself, in vectors.
 */
void measurePiece(int first, const PieceColumns& columns, const RowSquares<std::int16_t>& squares, float* distances);
void measurePiece(int first, const PieceColumns& columns, const RowSquares<std::int32_t>& squares, float* distances);

} // namespace silhouette
