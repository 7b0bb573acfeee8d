// SPDX-License-Identifier: BSD-3-Clause
/**
 * 3D convex hulls by Qhull (Barber, Dobkin and Huhdanpaa 1996).
 */
#pragma once

#include "Mesh.h"

#include <optional>
#include <vector>

namespace silhouette
{

/**
 * The convex hull as a closed triangle mesh, oriented outwards; its points are those of the given ones that are hull
 * vertices, in the given order. Empty where the points have no volume (fewer than four, or all in a plane).
 */
std::optional<Mesh> convexHull(const std::vector<Eigen::Vector3d>& points);

/**
 * The volume that closed triangles enclose, in the points' unit cubed: negative where they are oriented inwards, 0 where there
 * are none.
 */
double signedVolume(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles);

} // namespace silhouette
