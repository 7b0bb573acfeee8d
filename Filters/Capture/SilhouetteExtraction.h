// SPDX-License-Identifier: BSD-3-Clause
/**
 * From an image's bytes to a silhouette.
 *
 * With criteria (ExtractionOptions::hasCriteria) a pixel is background if any of them says so. Without, the
 * image must be a silhouette already, by the first of these that fits:
 * 1. an alpha channel that is not opaque (above 127) everywhere: object where it is above 127;
 * 2. a file that is known to be a mask, with any grey levels, or an image of at most two colours that the
 * rule tells apart: object where the largest channel is above 127, or not 0 where the largest value of the
 * image is 1. Then polarity, morphology (Morphology.h), the largest region and holes (Regions.h), each where
 * asked for.
 *
 * Memory: a few bytes a pixel. May be called for several images at the same time.
 */
#pragma once

#include "ExtractionOptions.h"
#include "ImageBytes.h"
#include "View.h"

#include <string>

namespace silhouette
{

/**
 * The silhouette of `image`. `isMask`: the file was found as a mask; it only matters without criteria. `name`
 * is the view's, for messages. Throws InvalidInput, naming the view: options out of range; an image without
 * pixels, with other than 1 to 4 channels, or an array of the wrong length; a key on a grey image; `alpha` on
 * an image without alpha; neither criteria nor a silhouette (the message names the options that would help).
 */
BinaryImage extractSilhouette(const ColourImage& image, const ExtractionOptions& options, bool isMask,
                              const std::string& name = {});

} // namespace silhouette
