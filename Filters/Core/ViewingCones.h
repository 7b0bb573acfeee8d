// SPDX-License-Identifier: BSD-3-Clause
/**
 * The viewing cones of the silhouettes' bounding rectangles: what bounds the object before any pixel is asked.
 */
#pragma once

#include "PreparedViews.h"

#include <Eigen/Geometry>

namespace silhouette
{

using Box = Eigen::AlignedBox3d;

/**
 * The box of the points that at most `backgroundVotes` cones leave out, to within a 16th of it. With a point common to
 * all cones, that set is star-shaped, so that a search box whose border it does not touch holds all of it.
 * A side of an image beyond which its view abstains bounds nothing; where the cones do not close for that
 * reason, the object is taken to lie within the images, whose sides then bound all.
 * Throws NothingSurvives where no point is left (the message names the views without any one of which there
 * would be one), UnboundedObject where the cones do not close within 4096 times the object's apparent size.
 */
Box intersectViewingCones(const PreparedViews& views, int backgroundVotes);

/** The point nearest, by least squares, to the rays through the given pixels; free of the matrices' scale and sign. */
Vector3 nearestPointToRays(const std::vector<Projection>& projections, const std::vector<Vector2>& pixels);

/** Mean of the object's pixel centres; the image's centre where there is no object. */
Vector2 silhouetteCentroid(const BinaryImage& silhouette);

} // namespace silhouette
