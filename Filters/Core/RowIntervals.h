// SPDX-License-Identifier: BSD-3-Clause
/**
 * Solids as what they hold of the lattice rows, the lines of lattice points along one axis. On a row a convex solid
 * is one interval and a closed surface a list of them, so that the union of any number of solids is a
 * sort, and the place where a lattice edge leaves the union is found exactly.
 */
#pragma once

#include "LatticeLabels.h"
#include "Mesh.h"

#include <vector>

namespace silhouette
{

/** What a solid holds of one row, both ends included, in lattice coordinates. */
struct RowInterval
{
  std::uint64_t row = 0; ///< rowKey
  double from = 0.0;
  double to = 0.0;
};

/** A solid by its rows along each axis, united. */
using SolidRows = std::array<std::vector<RowInterval>, 3>;

/** Two coordinates nearer than this, in octants, count as one. */
constexpr double RowTolerance = 1e-9;

inline std::int32_t coordinateOf(const LatticePoint& p, int axis)
{
  return axis == 0 ? p.i : axis == 1 ? p.j : p.k;
}

/** Name of the row along `axis` through a lattice point of non-negative coordinates. */
inline std::uint64_t rowKey(const LatticePoint& p, int axis)
{
  return std::uint64_t(coordinateOf(p, (axis + 2) % 3)) << 32 | std::uint64_t(coordinateOf(p, (axis + 1) % 3));
}

/** The lattice point of coordinate `along` on a row. */
LatticePoint pointOnRow(std::uint64_t row, int axis, std::int32_t along);

/** A world point in lattice coordinates, put on the lattice planes that are within `snap` octants of it. */
Eigen::Vector3d latticeCoordinates(const Eigen::Vector3d& p, const Lattice& lattice, double snap);

/**
 * The rows of a convex mesh, whose points are lattice coordinates, within the lattice's border; ascending, each row
 * once. The solid is closed: rows that it only touches are held too, so that two hulls with a common
 * facet in a lattice plane leave no slit. Cost: the rows, and for each triangle those that it meets.
 */
std::vector<RowInterval> convexRows(const Mesh& hull, int axis, const Lattice& lattice);

/** The rows of a closed surface whose points lie on lattice edges; ascending. */
std::vector<RowInterval> surfaceRows(const SurfaceCrossings& crossings, int axis);

/** The rows of a closed surface along each axis. */
inline SolidRows surfaceRows(const SurfaceCrossings& crossings)
{
  return { surfaceRows(crossings, 0), surfaceRows(crossings, 1), surfaceRows(crossings, 2) };
}

/** Sort, and make one of intervals that meet. */
void uniteRows(std::vector<RowInterval>& rows);

/** The interval of united rows that holds a place on a row, or null. Cost: a binary search. */
const RowInterval* findInterval(const std::vector<RowInterval>& rows, std::uint64_t row, double place);

} // namespace silhouette
