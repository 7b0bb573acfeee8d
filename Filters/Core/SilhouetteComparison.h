// SPDX-License-Identifier: BSD-3-Clause
/**
 * How well does a mesh explain the silhouettes? It is rendered in each view (SilhouetteRendering.h) and
 * compared with that view's silhouette, pixel by pixel.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"
#include "View.h"

#include <cstdint>
#include <string>
#include <vector>

namespace silhouette
{

/** One view's agreement. */
struct ViewAgreement
{
  std::string name;                   ///< the view's
  std::uint64_t silhouettePixels = 0; ///< object pixels of the silhouette
  std::uint64_t meshPixels = 0;       ///< object pixels of the mesh's silhouette
  std::uint64_t falseObject = 0;      ///< object in the mesh's silhouette alone
  std::uint64_t falseBackground = 0;  ///< object in the view's silhouette alone
  /** Intersection over union, 0 to 1; 1 where both are empty. */
  double iou = 1.0;
  /** (falseObject + falseBackground) / silhouettePixels, which may exceed 1. Where the silhouette is empty: 0
   * if the mesh's is empty too, else 1. */
  double xorShare = 0.0;
};

/**
 * The agreement in each view, in the views' order. Throws InvalidInput for an invalid mesh, a view without
 * pixels or with a pixel array of the wrong length (the message names the view) or a projection that is not
 * finite; Cancelled. Views are worked on side by side. Cost: a rendering and a pass over the pixels for each
 * view.
 */
std::vector<ViewAgreement> compareSilhouettes(
  const Mesh& mesh, const std::vector<View>& views, Execution& execution);

/** The same numbers over all views together: their pixels added up. The name is empty. */
ViewAgreement totalAgreement(const std::vector<ViewAgreement>& views);

} // namespace silhouette
