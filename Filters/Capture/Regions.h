// SPDX-License-Identifier: BSD-3-Clause
/**
 * Connected regions of a silhouette. Object is 8-connected, background 4-connected, so that a closed contour
 * separates. Cost: one labelling of the image each.
 */
#pragma once

#include "View.h"

namespace silhouette
{

/**
 * The largest 8-connected region of object alone; of equals, the one whose first pixel comes first, rows from
 * the top, each from the left. An image without object comes back as it is.
 */
BinaryImage largestRegion(const BinaryImage& image);

/**
 * Fill the 4-connected regions of background that have fewer than `pixels` pixels and do not touch the
 * image's border.
 */
BinaryImage fillHoles(const BinaryImage& image, int pixels);

} // namespace silhouette
