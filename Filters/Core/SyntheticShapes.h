// SPDX-License-Identifier: BSD-3-Clause
/**
 * Solids whose shape is known, as truth for tests, benchmarks and demonstrations.
 *
 * Every mesh is closed, oriented outwards, edge- and vertex-manifold, free of self-intersections, one piece,
 * and lies in the cube [-1, 1]^3 with the z axis upwards. In leaves of depth 9 of that cube (2 / 512) the
 * facets stray from the shape that they stand for by a tenth at most nearly everywhere, by a third at most in
 * the jug's sharpest bends.
 */
#pragma once

#include "Mesh.h"

namespace silhouette
{

enum class SyntheticShape : int
{
  Jug = 0, ///< belly, neck, lip with a spout, open mouth (wall 0.072 thick) and a thin handle at -x: genus 1
  Sphere = 1, ///< radius sphereRadius about the origin: genus 0
  Torus = 2,  ///< radii torusRingRadius and torusTubeRadius about the origin, axis torusAxis(): genus 1
  Twig = 3,   ///< a bare twig of bent tubes 0.010 to 0.014 across, thinner than a depth-7 octant: genus 0
  Pebble = 4, ///< the points of pebbleLevel() at most 1: convex, rounded, all its axes tilted: genus 0
  Pumpkin = 5 ///< nine lobes with grooves between them, hollows above and below, a curved stalk: genus 0
};

constexpr double sphereRadius = 0.9;
constexpr double torusRingRadius = 0.6;
constexpr double torusTubeRadius = 0.25;

/** Unit axis of the torus: tilted, so that no ring of cameras around z sees it symmetrically. */
Eigen::Vector3d torusAxis();

/**
 * 0 at the origin, 1 on the pebble's surface, in proportion between them on every ray, and convex: the
 * 2.5-norm of the coordinates along three tilted axes, each over a length of its own on either side of the
 * origin.
 */
double pebbleLevel(const Eigen::Vector3d& p);

struct SyntheticShapeOptions
{
  /** Facets a unit length, relative to the default, 0.5 to 4; larger is finer, the faces grow with its
   * square. */
  double refinement = 1.0;
};

/**
 * The shape's mesh. Sphere: a subdivided icosahedron; pebble: the sphere's points moved along their rays.
 * Torus: a regular grid of its two angles. Jug, twig and pumpkin: a distance field contoured by
 * marchingCubesTable() in the cells near the surface alone, with the vertices at the field's roots on the
 * lattice edges. The default costs less than two seconds. Throws InvalidInput where the refinement is out of
 * range or the shape is unknown.
 */
Mesh syntheticShape(SyntheticShape shape, const SyntheticShapeOptions& options = SyntheticShapeOptions());

} // namespace silhouette
