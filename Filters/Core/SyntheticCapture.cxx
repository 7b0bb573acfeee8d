// SPDX-License-Identifier: BSD-3-Clause
#include "SyntheticCapture.h"

#include "CaptureNoise.h"
#include "MeshCheck.h"
#include "ParameterRange.h"
#include "ShadedRendering.h"
#include "SilhouetteRendering.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

struct BoundingSphere
{
  Vector3 centre;
  double radius;
};

BoundingSphere boundingSphere(const Mesh& mesh)
{
  if (mesh.triangles.empty())
  {
    throw InvalidInput("the mesh has no triangles");
  }
  checkMesh(mesh);
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : mesh.triangles)
  {
    for (const std::int32_t i : triangle)
    {
      box.extend(mesh.points[i]);
    }
  }
  BoundingSphere sphere{box.center(), 0.0};
  for (const Triangle& triangle : mesh.triangles)
  {
    for (const std::int32_t i : triangle)
    {
      sphere.radius = std::max(sphere.radius, (mesh.points[i] - sphere.centre).norm());
    }
  }
  if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius))
  {
    throw InvalidInput("the mesh's bounding sphere has the radius " + std::to_string(sphere.radius));
  }
  return sphere;
}

/** A camera taken apart: projection = intrinsics * rotation * [identity | -centre]. */
struct Camera
{
  Eigen::Matrix3d intrinsics;
  Eigen::Matrix3d rotation; ///< rows: right, down, forward
  Vector3 centre;

  Projection projection() const
  {
    Projection result;
    result.leftCols<3>() = this->intrinsics * this->rotation;
    result.col(3) = -(result.leftCols<3>() * this->centre);
    return result;
  }
};

Camera lookAt(const BoundingSphere& sphere, double azimuth, double elevation, int width, int height)
{
  constexpr double distance = 4.0; // radii
  constexpr double filled = 0.8;
  const Vector3 outward(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                        std::sin(elevation));
  const Vector3 right = Vector3::UnitZ().cross(outward).normalized();
  Camera camera;
  camera.rotation << right.transpose(), right.cross(outward).transpose(), -outward.transpose();
  camera.centre = sphere.centre + distance * sphere.radius * outward;
  // The sphere's outline is seen at an angle whose sine is 1 / distance.
  const double focal = 0.5 * filled * std::min(width, height) * std::sqrt(distance * distance - 1.0);
  camera.intrinsics << focal, 0.0, 0.5 * (width - 1), 0.0, focal, 0.5 * (height - 1), 0.0, 0.0, 1.0;
  return camera;
}

std::vector<Camera> ringCameras(const Mesh& truth, int views, int width, int height)
{
  struct Ring
  {
    double elevation; ///< degrees
    int count;
    double start; ///< degrees
  };
  const int high = views / 4;
  const int below = 3 * views / 20;
  // The first view sees a jug's handle a little from the front.
  const Ring rings[] = {{15.0, views - high - below, -70.0}, {45.0, high, -60.0}, {-20.0, below, -45.0}};
  const BoundingSphere sphere = boundingSphere(truth);
  std::vector<Camera> cameras;
  for (const Ring& ring : rings)
  {
    for (int i = 0; i < ring.count; ++i)
    {
      const double azimuth = (ring.start + 360.0 * i / ring.count) * Pi / 180.0;
      cameras.push_back(lookAt(sphere, azimuth, ring.elevation * Pi / 180.0, width, height));
    }
  }
  return cameras;
}

/** The camera as a calibration with errors would report it. */
Projection reportedProjection(Camera camera, const SyntheticCaptureOptions& options, std::size_t view)
{
  const std::uint64_t shift = noiseKey(options.seed, NoiseKind::Camera, view);
  camera.intrinsics(0, 2) += options.noiseCamera * gaussianAt(shift, 0);
  camera.intrinsics(1, 2) += options.noiseCamera * gaussianAt(shift, 1);
  if (options.noiseRotation > 0.0)
  {
    const std::uint64_t turn = noiseKey(options.seed, NoiseKind::Rotation, view);
    const Vector3 degrees =
        options.noiseRotation * Vector3(gaussianAt(turn, 0), gaussianAt(turn, 1), gaussianAt(turn, 2));
    const Vector3 axis = degrees.normalized();
    camera.rotation =
        Eigen::AngleAxisd(degrees.norm() * Pi / 180.0, axis).toRotationMatrix() * camera.rotation;
  }
  return camera.projection();
}

void validateImages(int views, int width, int height)
{
  requireRange("views", views, 1, 10000);
  requireRange("width", width, 1, 16384);
  requireRange("height", height, 1, 16384);
}

void validate(const SyntheticCaptureOptions& options)
{
  validateImages(options.views, options.width, options.height);
  requireRange("noise-contour", options.noiseContour, 0.0, GreatestContourNoise);
  requireRange("noise-blobs", options.noiseBlobs, 0, options.views);
  requireRange("noise-pixels", options.noisePixels, 0.0, 1.0);
  requireRange("noise-camera", options.noiseCamera, 0.0, 1e6);
  requireRange("noise-rotation", options.noiseRotation, 0.0, 90.0);
}

/** For each view whether its mask is cut by blobs: a draw without putting back. */
std::vector<bool> blobViews(const SyntheticCaptureOptions& options)
{
  const std::uint64_t key = noiseKey(options.seed, NoiseKind::BlobViews, 0);
  std::vector<std::size_t> order(options.views);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::vector<bool> result(options.views, false);
  for (std::size_t i = 0; i < std::size_t(options.noiseBlobs); ++i)
  {
    std::swap(order[i], order[i + indexAt(key, i, order.size() - i)]);
    result[order[i]] = true;
  }
  return result;
}

std::string viewName(std::size_t view)
{
  const std::string digits = std::to_string(view);
  return "view_" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits + ".png";
}

BinaryImage noisyMask(const BinaryImage& clean, const SyntheticCaptureOptions& options, std::size_t view,
                      bool cut)
{
  const auto key = [&](NoiseKind kind) { return noiseKey(options.seed, kind, view); };
  BinaryImage mask = addContourNoise(clean, options.noiseContour, key(NoiseKind::Contour));
  if (cut)
  {
    mask = cutBlobs(mask, key(NoiseKind::Blobs));
  }
  return flipPixels(mask, options.noisePixels, key(NoiseKind::Pixels));
}

void drawNoise(SyntheticView& view, const Camera& camera, const SyntheticCaptureOptions& options,
               std::size_t number, bool cut)
{
  view.projection = reportedProjection(camera, options, number);
  view.mask = noisyMask(view.cleanMask, options, number, cut);
}

/** Call makeView(v) for each view, as many at a time as there are threads. */
template <typename MakeView>
void forViews(std::size_t views, Execution& execution, MakeView&& makeView)
{
  const std::size_t batch = std::size_t(std::max(execution.threads(), 1));
  for (std::size_t start = 0; start < views; start += batch)
  {
    execution.checkpoint(double(start) / double(views));
    execution.forRanges(std::min(batch, views - start), 1,
                        [&](std::size_t from, std::size_t to)
                        {
                          for (std::size_t v = start + from; v < start + to; ++v)
                          {
                            makeView(v);
                          }
                        });
  }
  execution.checkpoint(1.0);
}

} // namespace

std::vector<Projection> syntheticCameras(const Mesh& truth, int views, int width, int height)
{
  validateImages(views, width, height);
  std::vector<Projection> result;
  for (const Camera& camera : ringCameras(truth, views, width, height))
  {
    result.push_back(camera.projection());
  }
  return result;
}

SyntheticCapture synthesizeCapture(const Mesh& truth, const SyntheticCaptureOptions& options,
                                   Execution& execution)
{
  validate(options);
  const std::vector<Camera> cameras = ringCameras(truth, options.views, options.width, options.height);
  const std::vector<bool> cut = blobViews(options);
  const ShadingNormals normals = options.photographs ? shadingNormals(truth) : ShadingNormals();
  SyntheticCapture capture;
  capture.width = options.width;
  capture.height = options.height;
  capture.views.resize(options.views);
  forViews(cameras.size(), execution,
           [&](std::size_t v)
           {
             SyntheticView& view = capture.views[v];
             view.name = viewName(v);
             view.trueProjection = cameras[v].projection();
             view.cleanMask = renderSilhouette(truth, view.trueProjection, options.width, options.height);
             drawNoise(view, cameras[v], options, v, cut[v]);
             if (options.photographs)
             {
               view.photograph = shadePhotograph(truth, normals, view.trueProjection, view.cleanMask);
             }
           });
  return capture;
}

void redrawNoise(SyntheticCapture& capture, const Mesh& truth, const SyntheticCaptureOptions& options,
                 Execution& execution)
{
  validate(options);
  if (capture.views.size() != std::size_t(options.views) || capture.width != options.width ||
      capture.height != options.height)
  {
    throw InvalidInput("the capture has " + std::to_string(capture.views.size()) + " views of " +
                       std::to_string(capture.width) + " x " + std::to_string(capture.height) +
                       " pixels, the options have " + std::to_string(options.views) + " of " +
                       std::to_string(options.width) + " x " + std::to_string(options.height));
  }
  const std::vector<Camera> cameras = ringCameras(truth, options.views, options.width, options.height);
  const std::vector<bool> cut = blobViews(options);
  forViews(cameras.size(), execution,
           [&](std::size_t v) { drawNoise(capture.views[v], cameras[v], options, v, cut[v]); });
}

} // namespace silhouette
