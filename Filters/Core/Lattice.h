// SPDX-License-Identifier: BSD-3-Clause
/**
 * The integer lattice that everything is named by. A root cube of a given depth N has 2^N leaf octants a side
 * and 2^N + 1 lattice points a side. Corners, edges and octants are named by integer coordinates, and every
 * position is computed from these alone, so that any two parts of the work agree to the last bit.
 */
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

namespace silhouette
{

constexpr int MaximumDepth = 16;

/** Integer coordinates of a lattice point, or of an octant within its generation. */
struct LatticePoint
{
  std::int32_t i = 0;
  std::int32_t j = 0;
  std::int32_t k = 0;

  bool operator==(const LatticePoint& o) const { return i == o.i && j == o.j && k == o.k; }
  LatticePoint operator+(const LatticePoint& o) const { return { i + o.i, j + o.j, k + o.k }; }
};

/** Lattice coordinates of a point, as a vector. */
inline Eigen::Vector3d toVector(const LatticePoint& p)
{
  return { double(p.i), double(p.j), double(p.k) };
}

/** Corner or child number c in 0..7: bit 0 is x, bit 1 is y, bit 2 is z. */
inline LatticePoint cornerOffset(int c)
{
  return { c & 1, (c >> 1) & 1, (c >> 2) & 1 };
}

/** The n-th of the 27 lattice points around p, itself the 13th, in the order of k, j, i. */
inline LatticePoint neighbourOf(const LatticePoint& p, int n)
{
  return { p.i + n % 3 - 1, p.j + n / 3 % 3 - 1, p.k + n / 9 - 1 };
}

/** Morton codes of the 27 points around one whose coordinates are 1 and more, by their numbers for neighbourOf(). */
class CodesAround
{
public:
  explicit CodesAround(const LatticePoint& p);
  std::uint64_t operator[](int n) const { return this->Along[0][n % 3] | this->Along[1][n / 3 % 3] | this->Along[2][n / 9]; }

private:
  std::uint64_t Along[3][3];
};

/** The numbers, for neighbourOf(), of the six points at the other ends of a lattice point's edges. */
inline constexpr int EdgeNeighbours[6] = { 4, 10, 12, 14, 16, 22 };

/** Spread the lower 21 bits of x so that two zero bits follow each. */
inline std::uint64_t spreadBits(std::uint64_t x)
{
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  x = (x | x << 2) & 0x1249249249249249ULL;
  return x;
}

inline std::int32_t gatherBits(std::uint64_t x)
{
  x &= 0x1249249249249249ULL;
  x = (x | x >> 2) & 0x10c30c30c30c30c3ULL;
  x = (x | x >> 4) & 0x100f00f00f00f00fULL;
  x = (x | x >> 8) & 0x1f0000ff0000ffULL;
  x = (x | x >> 16) & 0x1f00000000ffffULL;
  x = (x | x >> 32) & 0x1fffffULL;
  return std::int32_t(x);
}

/** Morton code of non-negative coordinates below 2^21: x in bits 0, 3, ..., y in 1, 4, ..., z in 2, 5, ... */
inline std::uint64_t mortonCode(const LatticePoint& p)
{
  return spreadBits(std::uint64_t(p.i)) | spreadBits(std::uint64_t(p.j)) << 1 | spreadBits(std::uint64_t(p.k)) << 2;
}

inline CodesAround::CodesAround(const LatticePoint& p)
{
  for (int step = 0; step < 3; ++step)
  {
    this->Along[0][step] = mortonCode({ p.i + step - 1, 0, 0 });
    this->Along[1][step] = mortonCode({ 0, p.j + step - 1, 0 });
    this->Along[2][step] = mortonCode({ 0, 0, p.k + step - 1 });
  }
}

inline LatticePoint fromMorton(std::uint64_t code)
{
  return { gatherBits(code), gatherBits(code >> 1), gatherBits(code >> 2) };
}

/** An axis-parallel cube of the world, the octree's root. */
struct RootCube
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< the corner of least coordinates
  double edge = 0.0;                                ///< edge length, > 0
};

/** A root cube subdivided `depth` times. */
struct Lattice
{
  RootCube root;
  int depth = 0; ///< number of subdivisions, 1 to MaximumDepth

  std::int32_t cells() const { return std::int32_t(1) << this->depth; } ///< leaf octants a side
  double leafEdge() const { return this->root.edge / double(this->cells()); } // exact: by a power of two
  /** The one formula for a coordinate: lattice coordinate `t` (not necessarily whole) along `axis`. */
  double coordinate(int axis, double t) const { return this->root.origin[axis] + this->leafEdge() * t; }
  Eigen::Vector3d position(const LatticePoint& p) const
  {
    return { this->coordinate(0, p.i), this->coordinate(1, p.j), this->coordinate(2, p.k) };
  }
  bool onBorder(const LatticePoint& p) const
  {
    const std::int32_t n = this->cells();
    return p.i <= 0 || p.j <= 0 || p.k <= 0 || p.i >= n || p.j >= n || p.k >= n;
  }
  bool hasCell(const LatticePoint& p) const
  {
    const std::int32_t n = this->cells();
    return p.i >= 0 && p.j >= 0 && p.k >= 0 && p.i < n && p.j < n && p.k < n;
  }
};

/** Is a point one of a lattice of so many cells a side, its border included? */
inline bool isOfLattice(const LatticePoint& p, std::int32_t cells)
{
  return std::min({ p.i, p.j, p.k }) >= 0 && std::max({ p.i, p.j, p.k }) <= cells;
}

/** Sort codes or numbers, and leave each of them once. */
template <typename Code> void sortUnique(std::vector<Code>& codes)
{
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
}

/** The codes of both of two sets, each ascending and no code twice. */
inline std::vector<std::uint64_t> united(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b)
{
  std::vector<std::uint64_t> both;
  both.reserve(a.size() + b.size());
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

} // namespace silhouette
