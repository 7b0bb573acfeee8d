// SPDX-License-Identifier: BSD-3-Clause
#include "FieldContour.h"

#include "Error.h"
#include "Lattice.h"
#include "MarchingCubesTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

namespace silhouette
{
namespace
{

/** Marching cubes on a lattice from (-1, -1, -1), done only in the blocks of cells that the surface may meet.
 */
class Contour
{
public:
  Contour(const DistanceField& field, double cellEdge) : TheField(field), CellEdge(cellEdge) {}

  Mesh operator()()
  {
    int size = BlockCells;
    while (size * this->CellEdge < 2.0)
    {
      size *= 2;
    }
    this->descend({0, 0, 0}, size);
    return std::move(this->Result);
  }

private:
  static constexpr int BlockCells = 16;
  static constexpr int BlockPoints = BlockCells + 1;

  Eigen::Vector3d position(const LatticePoint& p) const
  {
    return {this->CellEdge * p.i - 1.0, this->CellEdge * p.j - 1.0, this->CellEdge * p.k - 1.0};
  }

  /** The field at a lattice point of the block under work, asked for once. */
  double value(const LatticePoint& p)
  {
    const LatticePoint& o = this->BlockOrigin;
    double& v = this->Values[((p.k - o.k) * BlockPoints + p.j - o.j) * BlockPoints + p.i - o.i];
    v = std::isnan(v) ? this->TheField(this->position(p)) : v;
    return v;
  }

  void descend(const LatticePoint& origin, int size)
  {
    if (size == BlockCells)
    {
      this->BlockOrigin = origin;
      this->Values.fill(std::numeric_limits<double>::quiet_NaN());
    }
    const int half = size / 2;
    const LatticePoint middle = origin + LatticePoint{half, half, half};
    const double field = size <= BlockCells ? this->value(middle) : this->TheField(this->position(middle));
    if (std::abs(field) > this->TheField.steepness() * std::sqrt(3.0) * half * this->CellEdge)
    {
      return;
    }
    for (int c = 0; c < 8; ++c)
    {
      const LatticePoint o = cornerOffset(c);
      const LatticePoint child = origin + LatticePoint{o.i * half, o.j * half, o.k * half};
      if (half > 1)
      {
        this->descend(child, half);
      }
      else
      {
        this->contourCell(child);
      }
    }
  }

  void contourCell(const LatticePoint& cell)
  {
    std::size_t inside = 0;
    for (int c = 0; c < 8; ++c)
    {
      inside |= std::size_t(this->value(cell + cornerOffset(c)) < 0.0) << c;
    }
    for (const auto& edges : marchingCubesTable()[inside].triangles)
    {
      Triangle triangle;
      for (int i = 0; i < 3; ++i)
      {
        const LatticePoint start = cell + cornerOffset(edgeCorners[edges[i]][0]);
        triangle[i] = this->vertex(start, edgeAxis(edges[i]));
      }
      this->Result.triangles.push_back(triangle);
    }
  }

  /** The vertex on the lattice edge from `start` along `axis`. */
  std::int32_t vertex(const LatticePoint& start, int axis)
  {
    const std::uint64_t name = mortonCode(start) * 3 + std::uint64_t(axis);
    const auto [found, isNew] = this->Vertices.emplace(name, std::int32_t(this->Result.points.size()));
    if (isNew)
    {
      const LatticePoint step = cornerOffset(1 << axis);
      const Eigen::Vector3d a = this->position(start);
      const Eigen::Vector3d b = this->position(start + step);
      const double t = this->root(a, b, this->value(start), this->value(start + step));
      this->Result.points.push_back(a + t * (b - a));
    }
    return found->second;
  }

  /** Where the field changes sign between a and b: false position, the end that stays put given half weight.
   */
  double root(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double atA, double atB) const
  {
    double low = 0.0;
    double high = 1.0;
    double t = 0.5;
    int last = 0;
    for (int i = 0; i < 12 && high - low > 1e-9; ++i)
    {
      t = std::clamp((low * atB - high * atA) / (atB - atA), low, high);
      const double atT = this->TheField(a + t * (b - a));
      const bool sideOfA = (atT < 0.0) == (atA < 0.0);
      (sideOfA ? low : high) = t;
      (sideOfA ? atA : atB) = atT;
      if (last == (sideOfA ? 1 : 2))
      {
        (sideOfA ? atB : atA) *= 0.5;
      }
      last = sideOfA ? 1 : 2;
      if (std::abs(atT) < 1e-9)
      {
        break;
      }
    }
    // A vertex off the lattice points keeps every triangle from falling flat.
    return std::clamp(t, 0.01, 0.99);
  }

  const DistanceField& TheField;
  double CellEdge;
  LatticePoint BlockOrigin;
  std::array<double, BlockPoints * BlockPoints * BlockPoints> Values{};
  std::unordered_map<std::uint64_t, std::int32_t> Vertices;
  Mesh Result;
};

} // namespace

Mesh contourField(const DistanceField& field, double cellEdge)
{
  if (!(cellEdge >= 1e-4 && cellEdge <= 0.25))
  {
    throw InvalidInput("cell edge " + std::to_string(cellEdge) + " is outside 0.0001 to 0.25");
  }
  return Contour(field, cellEdge)();
}

} // namespace silhouette
