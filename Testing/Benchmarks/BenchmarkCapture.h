// SPDX-License-Identifier: BSD-3-Clause
/**
 * The capture that benchmarks run on: a solid of the synthesized ones on a turntable, the same bytes as
 * `vtksilhouette synthesize` writes for the same options.
 */
#pragma once

#include "Carving.h"
#include "SmpExecution.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"
#include "VotingMarchingCubes.h"

#include <string>
#include <vector>

namespace silhouette::benchmarks
{

inline SyntheticShape shapeNamed(const std::string& name)
{
  const std::pair<const char*, SyntheticShape> shapes[] = { { "jug", SyntheticShape::Jug },
    { "sphere", SyntheticShape::Sphere }, { "torus", SyntheticShape::Torus }, { "twig", SyntheticShape::Twig },
    { "pebble", SyntheticShape::Pebble }, { "pumpkin", SyntheticShape::Pumpkin } };
  for (const auto& [known, shape] : shapes)
  {
    if (name == known)
    {
      return shape;
    }
  }
  throw InvalidInput("there is no shape '" + name + "'; there are jug, sphere, torus, twig, pebble and pumpkin");
}

inline std::vector<View> capturedViews(SyntheticShape shape, SyntheticCaptureOptions options, Execution& execution)
{
  options.photographs = false;
  const SyntheticCapture capture = synthesizeCapture(syntheticShape(shape), options, execution);
  std::vector<View> views;
  for (const SyntheticView& view : capture.views)
  {
    views.push_back({ view.name, view.projection, view.mask });
  }
  return views;
}

/** The cube that everything is carved in. */
inline RootCube benchmarkCube()
{
  return { Eigen::Vector3d::Constant(-1.0), 2.0 };
}

} // namespace silhouette::benchmarks
