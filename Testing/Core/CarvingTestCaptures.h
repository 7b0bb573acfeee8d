// SPDX-License-Identifier: BSD-3-Clause
/**
 * Captures for the tests of carving and surfacing: scenes of known visual hull, and noise of every kind.
 */
#pragma once

#include "AutomaticBounds.h"
#include "Carving.h"
#include "EvaluationTestMeshes.h"
#include "MeshSoundness.h"
#include "PreparedViews.h"
#include "SilhouetteRendering.h"
#include "VotingMarchingCubes.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace silhouette::test
{

/** Numbers that are the same everywhere: splitmix64. */
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : State(seed)
  {
  }
  std::uint64_t next()
  {
    std::uint64_t z = (this->State += 0x9e3779b97f4a7c15ULL);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ z >> 27) * 0x94d049bb133111ebULL;
    return z ^ z >> 31;
  }
  /** In [0, 1). */
  double uniform() { return double(this->next() >> 11) * 0x1.0p-53; }
  double uniform(double from, double to) { return from + (to - from) * this->uniform(); }
  int below(int n) { return int(this->next() % std::uint64_t(n)); }

private:
  std::uint64_t State;
};

/** A camera at `eye` that looks at the origin; `focal` in pixels, the principal point in the image's middle. */
inline Projection lookAtOrigin(const Vector3& eye, double focal, int size)
{
  const Vector3 forward = -eye.normalized();
  const Vector3 helper = std::abs(forward.z()) > 0.9 ? Vector3::UnitX() : Vector3::UnitZ();
  const Vector3 right = forward.cross(helper).normalized();
  Eigen::Matrix3d R;
  R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  Eigen::Matrix3d K;
  K << focal, 0, 0.5 * (size - 1), 0, focal, 0.5 * (size - 1), 0, 0, 1;
  Projection P;
  P << K * R, -K * R * eye;
  return P;
}

/** `count` cameras around the origin at distance 6, in a ring that sways up and down. */
inline std::vector<Projection> swayingRing(int count, int size)
{
  std::vector<Projection> cameras;
  const double pi = std::acos(-1.0);
  for (int i = 0; i < count; ++i)
  {
    const double a = 2 * pi * i / count;
    cameras.push_back(lookAtOrigin(6.0 * Vector3(std::cos(a), std::sin(a), 0.6 * std::sin(2.3 * a)).normalized(),
      2.2 * size, size));
  }
  return cameras;
}

inline std::vector<View> viewsOf(const Mesh& mesh, const std::vector<Projection>& cameras, int size)
{
  std::vector<View> views;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    views.push_back({ "v" + std::to_string(i), cameras[i], renderSilhouette(mesh, cameras[i], size, size) });
  }
  return views;
}

/** Affine cameras along the axes: u = scale * x + c and so on; their hulls have closed forms. */
inline std::vector<Projection> axisCameras(double scale, int size)
{
  std::vector<Projection> cameras;
  for (int axis = 0; axis < 3; ++axis)
  {
    Projection P = Projection::Zero();
    P(0, (axis + 1) % 3) = scale;
    P(1, (axis + 2) % 3) = scale;
    P(0, 3) = P(1, 3) = 0.5 * (size - 1);
    P(2, 3) = 1.0;
    cameras.push_back(P);
  }
  return cameras;
}

/** Every kind of noise that silhouettes and matrices have, `kind` 0 to 5; 0 is none. */
inline void disturb(std::vector<View>& views, int kind, Random& random)
{
  for (auto& view : views)
  {
    auto& image = view.silhouette;
    const auto paint = [&](double u, double v, double radius, std::uint8_t value)
    {
      for (int row = 0; row < image.height; ++row)
      {
        for (int column = 0; column < image.width; ++column)
        {
          if (std::hypot(column - u, row - v) <= radius)
          {
            image.at(column, row) = value;
          }
        }
      }
    };
    const int n = image.width;
    if (kind == 1) // salt and pepper
    {
      for (auto& pixel : image.pixels)
      {
        pixel ^= std::uint8_t(random.uniform() < 0.02);
      }
    }
    if (kind == 2) // shifted matrices
    {
      Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
      shift(0, 2) = random.uniform(-3, 3);
      shift(1, 2) = random.uniform(-3, 3);
      view.projection = shift * view.projection;
    }
    for (int blob = 0; blob < 6 && kind == 3; ++blob) // holes and debris
    {
      paint(random.uniform(0, n), random.uniform(0, n), random.uniform(1, n * 0.06), std::uint8_t(blob % 2));
    }
    if (kind == 4) // half of the pixels anything
    {
      for (auto& pixel : image.pixels)
      {
        pixel = random.uniform() < 0.5 ? std::uint8_t(random.below(2)) : pixel;
      }
    }
    if (kind == 5) // cut by the image's border
    {
      image.height = n * 2 / 3;
      image.pixels.resize(std::size_t(image.width) * image.height);
    }
  }
}

inline Octree carveViews(const PreparedViews& views, const RootCube& cube, int depth, int backgroundVotes = 0)
{
  Execution execution;
  CarveOptions options;
  options.backgroundVotes = backgroundVotes;
  return carve(LatticeViews(views, { cube, depth }), options, execution);
}

inline PreparedViews prepareViews(const std::vector<View>& views, OutsidePolicy outside = OutsidePolicy::Border)
{
  Execution execution;
  ViewOptions options;
  options.outside = outside;
  return PreparedViews(views, options, execution);
}

/** A torus whose silhouettes are disturbed four times over: many of its octants are lost. */
inline PreparedViews disturbedTorus(std::uint64_t seed)
{
  Random random(seed);
  auto captured = viewsOf(torusMesh(48, 24, 0.75, 0.2), swayingRing(9, 100), 100);
  for (int n = 0; n < 4; ++n)
  {
    disturb(captured, 1, random);
  }
  return prepareViews(captured);
}

inline RootCube unitCube(double half = 1.3)
{
  return { Vector3::Constant(-half), 2 * half };
}

inline std::uint64_t survivorsOf(const Octree& octree)
{
  return octree.count(OctantState::Intersection, octree.lattice.depth) +
    octree.count(OctantState::Inside, octree.lattice.depth);
}

inline bool sameOctants(const Octree& a, const Octree& b)
{
  for (std::size_t g = 0; g < a.generations.size(); ++g)
  {
    if (a.generations[g].code != b.generations[g].code || a.generations[g].state != b.generations[g].state ||
      a.generations[g].childBlock != b.generations[g].childBlock)
    {
      return false;
    }
  }
  return a.generations.size() == b.generations.size();
}

} // namespace silhouette::test
