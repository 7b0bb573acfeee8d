// SPDX-License-Identifier: BSD-3-Clause
#include "FieldRefinement.h"

#include "Error.h"

#include <algorithm>
#include <array>
#include <string>

namespace silhouette
{
namespace
{

constexpr int BrickSize = BrickField::BrickSize;
constexpr int MostHalvings = 3; ///< of a brick's side

/** Weights of the points at -1, 0, 1, 2 for a place between 0 and 1. */
std::array<float, 4> keysWeights(double t)
{
  return { float(t * (-0.5 + t * (1.0 - 0.5 * t))), float(1.0 + t * t * (-2.5 + 1.5 * t)),
    float(t * (0.5 + t * (2.0 - 1.5 * t))), float(t * t * (-0.5 + 0.5 * t)) };
}

/** From the points of a coarser field in and around a brick to the brick's. */
class Refinement
{
public:
  Refinement(const BrickField& coarse, int halvings)
    : Cells(BrickSize >> halvings)
    , Side(this->Cells + 3)
    , Scale(float(1 << halvings))
    , Coarse(coarse)
    , Cursor(coarse)
  {
    for (int t = 0; t < BrickSize; ++t)
    {
      const int size = 1 << halvings;
      this->First[t] = t / size;
      this->Weights[t] = keysWeights(double(t % size) / size);
    }
    for (std::size_t n = 0; n < BrickField::BrickPoints; ++n)
    {
      const LatticePoint p = fromMorton(n);
      this->Place[n] = std::uint16_t(p.i + BrickSize * (p.j + BrickSize * p.k));
    }
  }

  /** Read what a brick, in bricks of the finer lattice, lies in. False where the corners of its coarse cells are not all there. */
  bool read(const LatticePoint& brick)
  {
    this->Lowest = { brick.i * this->Cells, brick.j * this->Cells, brick.k * this->Cells };
    for (int n = 0; n < 8; ++n) // no more bricks than these meet there
    {
      const LatticePoint o = cornerOffset(n);
      if (this->find({ o.i * this->Cells, o.j * this->Cells, o.k * this->Cells }) < 0)
      {
        return false;
      }
    }
    this->Points.clear();
    for (int k = -1; k <= this->Cells + 1; ++k)
    {
      for (int j = -1; j <= this->Cells + 1; ++j)
      {
        for (int i = -1; i <= this->Cells + 1; ++i)
        {
          this->Points.push_back(this->Scale * this->valueAt({ i, j, k }));
        }
      }
    }
    return true;
  }

  /** The brick's values, in Morton order. */
  void write(float* values)
  {
    this->along(this->Points, this->AlongI, this->Side * this->Side, 1);
    this->along(this->AlongI, this->AlongJ, this->Side, BrickSize);
    this->along(this->AlongJ, this->AlongK, 1, BrickSize * BrickSize);
    for (std::size_t n = 0; n < BrickField::BrickPoints; ++n)
    {
      values[n] = this->AlongK[this->Place[n]];
    }
  }

private:
  std::ptrdiff_t find(const LatticePoint& offset)
  {
    const LatticePoint p = this->Lowest + offset;
    return std::min({ p.i, p.j, p.k }) < 0 ? -1 : this->Cursor.find(mortonCode(p));
  }

  /** Of a point in or beside the brick's cells; where there is none, of the nearest one in them. */
  float valueAt(const LatticePoint& offset)
  {
    std::ptrdiff_t found = this->find(offset);
    if (found < 0)
    {
      const auto within = [this](int x) { return std::clamp(x, 0, this->Cells); };
      found = this->find({ within(offset.i), within(offset.j), within(offset.k) });
    }
    return this->Coarse.values()[std::size_t(found)];
  }

  /** From `outer` times Side times `inner` values to `outer` times BrickSize times `inner`. */
  void along(const std::vector<float>& from, std::vector<float>& to, int outer, int inner) const
  {
    to.resize(std::size_t(outer) * BrickSize * inner);
    for (int o = 0; o < outer; ++o)
    {
      for (int t = 0; t < BrickSize; ++t)
      {
        const float* points = &from[std::size_t(o * this->Side + this->First[t]) * inner];
        float* out = &to[std::size_t(o * BrickSize + t) * inner];
        const auto& w = this->Weights[t];
        for (int n = 0; n < inner; ++n)
        {
          out[n] = (w[0] * points[n] + w[1] * points[n + inner]) + (w[2] * points[n + 2 * inner] + w[3] * points[n + 3 * inner]);
        }
      }
    }
  }

  int Cells; ///< coarse ones along a brick's side
  int Side;  ///< points that are read along it
  float Scale;
  const BrickField& Coarse;
  BrickCursor Cursor;
  LatticePoint Lowest;
  std::array<int, BrickSize> First; ///< of the four points that count for a place along the side
  std::array<std::array<float, 4>, BrickSize> Weights;
  std::array<std::uint16_t, BrickField::BrickPoints> Place;
  std::vector<float> Points, AlongI, AlongJ, AlongK;
};

/** The finer cells at both ends of each cell that the field's surface crosses, ascending. */
std::vector<std::uint64_t> crossedCells(const BrickField& field, int halvings, Execution& execution)
{
  std::vector<std::uint64_t> cells;
  for (const std::uint64_t cell : field.mixedCells(execution))
  {
    const std::uint64_t lowest = cell << (3 * halvings);
    cells.push_back(lowest);
    cells.push_back(lowest + (std::uint64_t(1) << (3 * halvings)) - 1);
  }
  sortUnique(cells); // both are one where there are no halvings
  return cells;
}

} // namespace

BrickField refinedField(const BrickField& field, int halvings, const std::vector<std::uint64_t>& cells, int margin, Execution& execution)
{
  if (halvings < 0 || halvings > MostHalvings)
  {
    throw InvalidInput(std::to_string(halvings) + " halvings: 0 to " + std::to_string(MostHalvings) + " are possible");
  }
  BrickField fine({ field.lattice().root, field.lattice().depth + halvings }, united(cells, crossedCells(field, halvings, execution)), margin, execution);
  std::vector<std::uint8_t> known(fine.bricks().size());
  execution.forRanges(known.size(), 8,
    [&](std::size_t first, std::size_t last)
    {
      Refinement refinement(field, halvings);
      for (std::size_t brick = first; brick < last; ++brick)
      {
        known[brick] = refinement.read(fromMorton(fine.bricks()[brick]));
        if (known[brick])
        {
          refinement.write(&fine.values()[brick * BrickField::BrickPoints]);
        }
      }
    });
  fine.keepBricks(known);
  return fine;
}

} // namespace silhouette
