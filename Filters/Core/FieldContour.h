// SPDX-License-Identifier: BSD-3-Clause
/**
 * The surface of a solid that is given by a distance field, by marching cubes done near the surface alone.
 */
#pragma once

#include "Mesh.h"

namespace silhouette
{

/** A solid in the cube [-1, 1]^3: negative inside, positive outside. */
class DistanceField
{
public:
  virtual ~DistanceField() = default;
  virtual double operator()(const Eigen::Vector3d& p) const = 0;
  /** |field(p)| is at most this times p's distance from the surface; larger costs more cells. */
  virtual double steepness() const = 0;
};

/**
 * The surface field = 0 on a lattice of cells of `cellEdge`, from (-1, -1, -1); smaller is finer. Vertices
 * lie at the field's roots on the lattice edges, at least 0.01 of an edge from its ends; the mesh is closed
 * where the solid stays within the cube, oriented outwards, and of the solid's topology where no part or gap
 * is thinner than a cell or two. Throws InvalidInput for a cell edge outside 0.0001 to 0.25. Cost: field
 * values in proportion to the surface's area in cells.
 */
Mesh contourField(const DistanceField& field, double cellEdge);

} // namespace silhouette
