// SPDX-License-Identifier: BSD-3-Clause
/**
 * Dilation and erosion by discs, on a plane.
 *
 * The structuring element of radius R is the pixels whose centres lie within R + 0.5 of the centre (1 is 3 x
 * 3). Outside the image the plane goes on as the image ends: each pixel outside has the value of the border
 * pixel nearest it. The whole list runs on that plane and the image is cut out afterwards, so that
 * - an object that the border cuts off is not eaten from there, and goes on touching it;
 * - an object that does not touch the border is not drawn to it: dilating by 10 and eroding by 7 grows it by
 * 3 wherever it lies;
 * - opening only takes away, closing only adds, and closing does not bridge object and border.
 *
 * Cost: a pass over the pixels for each tap of the element up to radius 8; beyond, a distance transform.
 */
#pragma once

#include "ExtractionOptions.h"
#include "View.h"

#include <vector>

namespace silhouette
{

/** Run `operations` in their order. They must be valid (validate). */
BinaryImage applyMorphology(const BinaryImage& image, const std::vector<MorphologyOperation>& operations);

} // namespace silhouette
