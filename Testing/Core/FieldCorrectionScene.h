// SPDX-License-Identifier: BSD-3-Clause
/**
 * Synthesized captures whose noise is drawn anew at will, and their correction, for the tests of the corrected field.
 */
#pragma once

#include "CarvingTestCaptures.h"
#include "CornerShell.h"
#include "FieldCorrection.h"
#include "MeshDistance.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"

#include <functional>
#include <utility>

namespace silhouette::test
{

constexpr int Size = 160; ///< pixels
constexpr int Depth = 5;

/** A shape's capture, its noise drawn anew at will, and what exact marching cubes make of it. */
class Capture
{
public:
  explicit Capture(SyntheticShape shape, int views = 24)
  {
    SyntheticShapeOptions coarse;
    coarse.refinement = 0.5;
    this->Truth = syntheticShape(shape, coarse);
    this->Options.photographs = false;
    this->Options.views = views;
    this->Options.width = this->Options.height = Size;
    Execution execution;
    this->Views = synthesizeCapture(this->Truth, this->Options, execution);
  }

  void draw(double contour, double camera, std::uint64_t seed)
  {
    Execution execution;
    auto options = this->Options;
    options.noiseContour = contour;
    options.noiseCamera = camera;
    options.seed = seed;
    redrawNoise(this->Views, this->Truth, options, execution);
  }

  PreparedViews prepared(bool clean = false) const
  {
    return this->preparedWhere([clean](std::size_t) { return clean; });
  }

  /** Some views without noise: those whose numbers `isClean` holds for. */
  PreparedViews preparedWhere(const std::function<bool(std::size_t)>& isClean) const
  {
    std::vector<View> views;
    for (const auto& view : this->Views.views)
    {
      const bool clean = isClean(views.size());
      views.push_back({ view.name, clean ? view.trueProjection : view.projection, clean ? view.cleanMask : view.mask });
    }
    return prepareViews(views);
  }

  /** Every second view. */
  PreparedViews preparedHalf() const
  {
    std::vector<View> views;
    for (std::size_t view = 0; view < this->Views.views.size(); view += 2)
    {
      views.push_back({ this->Views.views[view].name, this->Views.views[view].projection, this->Views.views[view].mask });
    }
    return prepareViews(views);
  }

  /** What the silhouettes can tell at best: the hull of the clean ones, by a finer lattice. */
  const Mesh& cleanHull()
  {
    if (this->Hull.triangles.empty())
    {
      Execution execution;
      const PreparedViews views = this->prepared(true);
      this->Hull = votingMarchingCubes(carveViews(views, unitCube(1.05), 7), views, {}, execution).mesh;
    }
    return this->Hull;
  }

  /** For each view: what the reported projection adds to every pixel. */
  std::vector<Vector2> applied() const
  {
    std::vector<Vector2> shifts;
    for (const auto& view : this->Views.views)
    {
      const auto pixel = [](const Projection& P) { return Vector2(P(0, 3) / P(2, 3), P(1, 3) / P(2, 3)); };
      shifts.push_back(pixel(view.projection) - pixel(view.trueProjection));
    }
    return shifts;
  }

  const SyntheticCapture& views() const { return this->Views; }

private:
  Mesh Truth;
  SyntheticCaptureOptions Options;
  SyntheticCapture Views;
  Mesh Hull;
};

inline Capture& captureOf(SyntheticShape shape)
{
  static Capture sphere(SyntheticShape::Sphere), torus(SyntheticShape::Torus);
  return shape == SyntheticShape::Sphere ? sphere : torus;
}

/** The capture as it is now, marching cubes of it and the field's correction. */
struct Corrected
{
  explicit Corrected(const Capture& capture, const FieldCorrectionOptions& options = {}, int depth = Depth)
    : Corrected(capture.prepared(), options, depth)
  {
  }

  explicit Corrected(PreparedViews prepared, const FieldCorrectionOptions& options = {}, int depth = Depth)
    : views(std::move(prepared))
  {
    Execution execution;
    const Octree octree = carveViews(this->views, unitCube(1.05), depth);
    this->lattice = octree.lattice;
    this->survivors = leafCells(octree, OctantState::Intersection);
    this->exact = votingMarchingCubes(octree, this->views, {}, execution).mesh;
    this->correction = this->correct(options, execution);
  }

  FieldCorrection correct(const FieldCorrectionOptions& options, Execution& execution) const
  {
    return correctField(this->exact, this->lattice, this->views, options, {}, 0, execution);
  }

  PreparedViews views;
  Lattice lattice;
  std::vector<std::uint64_t> survivors;
  Mesh exact;
  FieldCorrection correction;
};

/** Mean distance from a mesh to the hull, octants. */
inline double errorOf(const Mesh& mesh, const Mesh& hull, const Lattice& lattice)
{
  Execution execution;
  return meshDistance(mesh, hull, lattice.leafEdge(), execution).mean / lattice.leafEdge();
}

} // namespace silhouette::test
