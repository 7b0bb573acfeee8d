// SPDX-License-Identifier: BSD-3-Clause
/**
 * How far is one surface from another? Distances from area samples of the one to the nearest point of the
 * other's triangles.
 */
#pragma once

#include "BoxTree.h"
#include "Execution.h"
#include "Mesh.h"

namespace silhouette
{

/** Unsigned distances, in the meshes' unit. */
struct MeshDistance
{
  double mean = 0.0;    ///< weighted by area
  double rms = 0.0;     ///< root of the mean square, weighted by area
  double maximum = 0.0; ///< over the samples and the triangles' corners
};

/**
 * The distance from surface `from` to surface `to`. Each triangle is cut into n x n equal ones, n the least
 * whole number of at least its longest edge / `spacing`; each of these is sampled at its centroid with its
 * area as weight. Corners are samples for the maximum alone. A mesh without area counts each sample alike.
 *
 * `spacing` > 0, in the meshes' unit; larger is faster and coarser. The result does not depend on the number
 * of threads. Throws InvalidInput for an invalid mesh, a mesh without triangles, a spacing that is not
 * positive or so small that a triangle would have more than 10^8 samples; Cancelled. Cost: about 2 us a
 * sample.
 */
MeshDistance meshDistance(const Mesh& from, const Mesh& to, double spacing, Execution& execution);

/** A surface made ready to be measured to, for those that several meshes are compared with. */
class DistanceTarget
{
public:
  /** `surface` is not copied and has to outlive this. Throws InvalidInput for an invalid or empty mesh. */
  DistanceTarget(const Mesh& surface, Execution& execution);

  double squaredDistance(const Eigen::Vector3d& point) const;

private:
  const Mesh& Surface;
  BoxTree Tree;
};

/** The same distance to a surface made ready. */
MeshDistance meshDistance(const Mesh& from, const DistanceTarget& to, double spacing, Execution& execution);

/** Both directions. */
struct MeshComparison
{
  MeshDistance meshToTruth;
  MeshDistance truthToMesh;
  double mean = 0.0;      ///< mean of both directions' means
  double rms = 0.0;       ///< root of the mean of both directions' mean squares
  double hausdorff = 0.0; ///< the greater of both maxima
};

/** meshDistance in both directions; the same conditions. */
MeshComparison compareMeshes(const Mesh& mesh, const Mesh& truth, double spacing, Execution& execution);

} // namespace silhouette
