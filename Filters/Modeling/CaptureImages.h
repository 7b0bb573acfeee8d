// SPDX-License-Identifier: BSD-3-Clause
/**
 * A described capture's images opened, and its matrices made ready: what vtkSilhouetteCaptureReader delivers.
 * Private to the module.
 */
#pragma once

#include "CaptureFolder.h"
#include "Execution.h"
#include "SilhouetteExtraction.h"
#include "ViewConversion.h"

class vtkPolyData;

namespace silhouette::modeling
{

/** Which of a view's files is opened. */
enum class CaptureImageChoice : int
{
  MasksWherePresent = 0,
  Photographs = 1,
  Masks = 2
};

/**
 * The views of a capture, their images without their lenses' distortion. Matrices whose sign is free are made positive at the object: at the point nearest
 * the rays through the silhouettes' centroids, or through the images' centres where an image is no
 * silhouette. Throws InvalidInput, naming the files: what readImage throws; a mask of another size than its
 * photograph, an image of another size than the camera file says; what undistorted() throws; no file of the wanted kind. What the images' readers warn of is added to `warnings`, in the
 * views' order; of several that cannot be read the first is thrown. Images are read side by side.
 */
std::vector<ImageView> readCapture(const CaptureDescription& capture, CaptureImageChoice choice,
                                   std::vector<std::string>& warnings, Execution& execution);

/**
 * Matrices whose sign is free were made positive where photographs alone could tell; their silhouettes, one a view, tell better: at the point
 * nearest the rays through these. Nothing is done where the sign of some view's matrix is not free.
 */
void orientBySilhouettes(const std::vector<ImageView>& views, std::vector<View>& silhouettes);

/** Whether a view's image was found as a mask: an integer in its field data, kept by every filter. */
bool isMask(const ImageView& view);

/** A view's pixels as the extraction takes them. Throws as pixelRows. */
ColourImage colourImage(const ImageView& view, std::size_t index);

/**
 * The cameras as lines: from the centre to the image's corners and around these, a fifth of the way to the
 * point nearest all optical rays; cell array `View`. A camera at infinity has none.
 */
void storeFrustums(const std::vector<ImageView>& views, vtkPolyData* lines);

} // namespace silhouette::modeling
