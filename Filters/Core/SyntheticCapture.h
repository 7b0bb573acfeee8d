// SPDX-License-Identifier: BSD-3-Clause
/**
 * Synthetic captures: silhouettes, photographs and cameras of a known solid, with the kinds of noise that
 * real captures suffer from, each of a stated strength.
 *
 * Cameras. The mesh's bounding sphere is centred on its bounding box; every camera looks at that centre from
 * four radii away, z upwards, the principal point in the middle of the image, square pixels, and the sphere
 * fills 0.8 of the shorter side. Of n views, n / 4 (rounded down) stand on a ring 45 degrees high, 3 n / 20
 * on one 20 degrees below the horizon, the others on one 15 degrees high; the views of a ring are evenly
 * spaced. The low ring comes first, then the high one, then the one below.
 *
 * Noise. What is drawn depends on the seed, the kind of noise and the view's number alone, so that each kind
 * can be changed without changing another, and is the same on every machine (a camera's sines and cosines may
 * differ in their last bit). Contour noise comes first, then blobs, then pixels. The camera noise of a view
 * is a shift of its principal point and a turn about its own centre, both in the reported projection alone:
 * masks and photographs are rendered with the true one, and photographs show the clean object.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"
#include "View.h"

#include <array>
#include <string>
#include <vector>

namespace silhouette
{

struct SyntheticCaptureOptions
{
  int views = 36;           ///< number of views, 1 to 10000; more carve closer and cost in proportion
  int width = 1024;         ///< pixels, 1 to 16384; larger is finer
  int height = 1024;        ///< pixels, 1 to 16384; larger is finer
  std::uint64_t seed = 0;   ///< any; another seed draws other noise of the same strength
  double noiseContour = 0;  ///< px, standard deviation of the contour (addContourNoise), 0 to 1000
  int noiseBlobs = 0;       ///< number of masks, 0 to views, that are cut by cutBlobs; which ones is drawn
  double noisePixels = 0;   ///< share of each mask's pixels that flip, 0 to 1
  double noiseCamera = 0;   ///< px, standard deviation of the reported principal point, in u and v, 0 to 1e6
  double noiseRotation = 0; ///< degrees, standard deviation of the reported turn about each axis, 0 to 90
  bool photographs = true;  ///< without them the photographs stay empty, which saves most of the time
};

struct SyntheticView
{
  std::string name;                     ///< `view_000.png` and on
  Projection projection;                ///< as reported: with the camera noise
  Projection trueProjection;            ///< what masks and photograph are rendered with
  BinaryImage mask;                     ///< with the noise
  BinaryImage cleanMask;                ///< renderSilhouette of the mesh
  std::vector<std::uint8_t> photograph; ///< 3 * width * height bytes, red, green, blue, the top row first;
                                        ///< or none
};

struct SyntheticCapture
{
  int width = 0;
  int height = 0;
  std::vector<SyntheticView> views;
};

/** The true projections of a ring of cameras about the mesh, as said above; throws as synthesizeCapture. */
std::vector<Projection> syntheticCameras(const Mesh& truth, int views, int width, int height);

/**
 * The capture of `truth`, which may be of any size and at any place. The same bytes for any number of
 * threads. Cost, in orders of magnitude: 0.1 s a view for each Mpx, as much again with contour noise, and 0.01 s
 * for each 100,000 triangles; memory: 5 bytes a pixel and view. Throws InvalidInput, naming the option and its
 * value, where one is out of range or not a number, or where the mesh has no triangles, names points that it
 * does not have, or is not finite or a single point; Cancelled.
 */
SyntheticCapture synthesizeCapture(const Mesh& truth, const SyntheticCaptureOptions& options,
                                   Execution& execution);

/**
 * Draw the noise of `options` anew in a capture of `truth` that synthesizeCapture made for as many views and
 * pixels: clean masks and photographs stay, so that it costs the noise alone. The bytes are those of
 * synthesizeCapture. Throws InvalidInput as it does, and where the capture's views or pixels are not those of
 * the options; Cancelled.
 */
void redrawNoise(SyntheticCapture& capture, const Mesh& truth, const SyntheticCaptureOptions& options,
                 Execution& execution);

} // namespace silhouette
