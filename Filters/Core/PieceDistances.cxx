// SPDX-License-Identifier: BSD-3-Clause
#include "PieceDistances.h"

#include "Vectorised.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace silhouette
{
namespace
{

constexpr int GroupSize = 8; ///< columns on either side that are looked at together

/** Squares of a piece's samples, worked on together; by reference alone, since how they are passed depends on the machine. */
template <typename Square>
struct Lanes
{
  typedef Square Type __attribute__((vector_size(TileSize * sizeof(Square))));

  [[gnu::always_inline]] static void load(const Square* from, Type& lanes) { std::memcpy(&lanes, from, sizeof(lanes)); }
  [[gnu::always_inline]] static void takeLess(Type& lanes, const Type& others) { lanes = others < lanes ? others : lanes; }
  /** Is any of these lanes less than the other's? */
  [[gnu::always_inline]] static bool anyLess(const Type& lanes, const Type& others)
  {
    const auto less = lanes < others;
    std::uint64_t words[sizeof(less) / sizeof(std::uint64_t)], any = 0;
    std::memcpy(words, &less, sizeof(less));
    for (const std::uint64_t word : words)
    {
      any |= word;
    }
    return any != 0;
  }
};

/** Of each column and the seven that follow it, the least; up to the last column that seven follow. */
template <typename Square>
[[gnu::always_inline]] inline void leastOfGroups(const Square* squares, int count, Square* least)
{
  using Piece = Lanes<Square>;
  for (int c = 0; c + TileSize + GroupSize - 1 <= count; c += TileSize)
  {
    typename Piece::Type piece, next;
    Piece::load(squares + c, piece);
    for (int d = 1; d < GroupSize; ++d)
    {
      Piece::load(squares + c + d, next);
      Piece::takeLess(piece, next);
    }
    std::memcpy(least + c, &piece, sizeof(piece));
  }
}

/**
 * For a piece's samples, from the squares of the distances within the columns (0 at pixels of the other kind): the least
 * d * d + column[d]^2 over |d| <= most. Stops where no larger d can matter, and passes over groups of d that cannot: `groups` has the least of each column and the seven that follow it.
 */
template <typename Square>
[[gnu::always_inline]] inline void leastSquares(const Square* squares, const PieceColumns& columns, const Square* groups, Square* best)
{
  using Piece = Lanes<Square>;
  typename Piece::Type least, nearer, other;
  Piece::load(squares + columns.offset(0), least);
  for (int first = 1; first <= columns.most(); first += GroupSize)
  {
    const typename Piece::Type square = typename Piece::Type{} + Square(first * first);
    if (!Piece::anyLess(square, least))
    {
      break;
    }
    const int last = std::min(first + GroupSize - 1, columns.most());
    if (columns.isDense() && first > 1 && last == first + GroupSize - 1)
    {
      Piece::load(groups + columns.offset(-last), nearer);
      Piece::load(groups + columns.offset(first), other);
      Piece::takeLess(nearer, other);
      if (!Piece::anyLess(nearer + square, least))
      {
        continue;
      }
    }
    for (int d = first; d <= last; ++d)
    {
      Piece::load(squares + columns.offset(-d), nearer);
      Piece::load(squares + columns.offset(d), other);
      Piece::takeLess(nearer, other);
      Piece::takeLess(least, nearer + Square(d * d));
    }
  }
  std::memcpy(best, &least, sizeof(least));
}

/** `before` columns of the limit's square come first; after the row's last column that one goes on. */
template <typename Square>
[[gnu::always_inline]] inline void squareKind(
  const RowPixels& row, std::uint8_t kind, int before, Square limit, const PieceColumns& columns, RowSquares<Square>& squares)
{
  const int length = int(squares.columns.size());
  std::fill_n(squares.columns.begin(), before, limit);
  Square* const own = squares.columns.data() + before;
  for (int c = 0; c < row.count; ++c)
  {
    const Square square = Square(row.inColumn[c] * row.inColumn[c]);
    own[c] = row.pixels[c] == kind ? square : Square(0);
  }
  // Beyond the image the last column goes on; that is no nearer to any pixel of it.
  std::fill(own + row.count, squares.columns.data() + length, own[row.count - 1]);
  columns.arrange(squares);
  if (columns.isDense())
  {
    leastOfGroups(squares.columns.data(), length, squares.groups.data());
  }
}

/** Distances of a piece's samples if they are of one kind; its columns begin `first` into the row's. */
template <typename Square>
[[gnu::always_inline]] inline void measureKind(int first, const PieceColumns& columns, const RowSquares<Square>& squares, float* distances)
{
  Square best[TileSize];
  leastSquares(columns.ofPiece(squares, first), columns, squares.groups.data() + first, best);
  for (int c = 0; c < TileSize; ++c)
  {
    distances[c] = std::sqrt(float(best[c])) - 0.5f;
  }
}

} // namespace

SILHOUETTE_VECTORISED void squareColumns(
  const RowPixels& row, std::uint8_t kind, int before, std::int16_t limit, const PieceColumns& columns, RowSquares<std::int16_t>& squares)
{
  squareKind(row, kind, before, limit, columns, squares);
}

SILHOUETTE_VECTORISED void squareColumns(
  const RowPixels& row, std::uint8_t kind, int before, std::int32_t limit, const PieceColumns& columns, RowSquares<std::int32_t>& squares)
{
  squareKind(row, kind, before, limit, columns, squares);
}

SILHOUETTE_VECTORISED void measurePiece(int first, const PieceColumns& columns, const RowSquares<std::int16_t>& squares, float* distances)
{
  measureKind(first, columns, squares, distances);
}

SILHOUETTE_VECTORISED void measurePiece(int first, const PieceColumns& columns, const RowSquares<std::int32_t>& squares, float* distances)
{
  measureKind(first, columns, squares, distances);
}

} // namespace silhouette
