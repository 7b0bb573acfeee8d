// SPDX-License-Identifier: BSD-3-Clause
/**
 * Any silhouettes, any matrices, any settings: either one of the core's errors, or a surface that keeps the promise.
 */
#include "AutomaticBounds.h"
#include "Carving.h"
#include "LatticeRegions.h"
#include "LocalHullSurface.h"
#include "MeshSoundness.h"
#include "SurvivorCoverage.h"
#include "VotingMarchingCubes.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace silhouette;

namespace
{

/** Reads the input's bytes as numbers; zeros when they are used up. */
class Reader
{
public:
  Reader(const std::uint8_t* data, std::size_t size)
    : Data(data)
    , Size(size)
  {
  }
  std::uint8_t byte() { return this->At < this->Size ? this->Data[this->At++] : 0; }
  int below(int n) { return this->byte() % n; }
  double number()
  {
    const int raw = this->byte() | this->byte() << 8;
    return (raw - 32768) / 8192.0;
  }

private:
  const std::uint8_t* Data;
  std::size_t Size;
  std::size_t At = 0;
};

/** Mostly a camera that sees the cube; now and then anything. */
Projection matrix(Reader& in, int size)
{
  Projection P;
  for (int n = 0; n < 12; ++n)
  {
    P.data()[n] = in.number();
  }
  if (in.below(8) != 0)
  {
    P.row(2) *= 0.1;
    P(2, 3) += 3.0;
    P.topRows<2>() *= 0.3 * size;
    P.row(0) += 0.5 * size * P.row(2);
    P.row(1) += 0.5 * size * P.row(2);
  }
  return P;
}

View view(Reader& in)
{
  View view;
  const int size = 1 + in.below(24);
  view.silhouette = { size, 1 + in.below(24), {} };
  view.projection = matrix(in, size);
  const int kind = in.below(4);
  for (int n = 0; n < view.silhouette.width * view.silhouette.height; ++n)
  {
    const double x = n % size - 0.5 * size, y = n / size - 0.5 * size;
    const bool disc = std::hypot(x, y) < 0.4 * size;
    view.silhouette.pixels.push_back(
      std::uint8_t(kind == 0 ? in.byte() & 1 : (kind == 1 ? 1 : disc != (in.byte() < 8 * kind))));
  }
  return view;
}

void require(bool condition, const char* what)
{
  if (!condition)
  {
    std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
  }
}

void expectPromise(const Mesh& mesh, const Octree& octree, Execution& execution)
{
  const MeshSoundness soundness = assessMesh(mesh, execution);
  require(soundness.sound(), "sound");
  require(lostSurvivors(octree, mesh, execution) == 0, "no lost octant");
  require(soundness.components <= countSurvivorComponents(octree, execution), "components");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Reader in(data, size);
  Execution execution;
  try
  {
    std::vector<View> views;
    const int count = 1 + in.below(5);
    for (int n = 0; n < count; ++n)
    {
      views.push_back(view(in));
    }
    ViewOptions viewOptions;
    viewOptions.outside = OutsidePolicy(in.below(3));
    const PreparedViews prepared(views, viewOptions, execution);
    const int depth = 1 + in.below(5);
    const int k = in.below(count);
    const RootCube cube = in.below(3) == 0 ? automaticBounds(prepared, { depth, k }, execution)
                                           : RootCube{ Vector3::Constant(-1.0), 2.0 };
    CarveOptions carving;
    carving.backgroundVotes = k;
    const Octree octree = carve(LatticeViews(prepared, { cube, depth }), carving, execution);
    VotingOptions voting;
    voting.share = double(count - k) / count;
    voting.edges = EdgePlacement(in.below(3));
    const auto surface = votingMarchingCubes(octree, prepared, voting, execution);
    const MeshSoundness soundness = assessMesh(surface.mesh, execution);
    require(soundness.openEdges + soundness.nonManifoldEdges + soundness.nonManifoldVertices == 0, "voting is closed");
    LocalHullOptions options;
    options.bridgeGap = in.below(4);
    options.singlePrecision = in.below(2) != 0;
    options.islandShare = in.below(3) == 0 ? 0.1 * in.below(11) : 0.0;
    for (const LocalHullMode mode : { LocalHullMode::Robust, LocalHullMode::Thesis })
    {
      options.mode = mode;
      for (const PreparedViews* known : { &prepared, static_cast<const PreparedViews*>(nullptr) })
      {
        const LocalHullSurface found = localHullSurface(surface.mesh, octree, known, options, execution);
        DroppedSurvivors dropped;
        expectPromise(found.mesh, dropLeaves(octree, found.dropped.leaves, dropped), execution);
        for (const LocalHull& hull : classifyLocalHulls(surface.mesh, octree, known, options, execution))
        {
          require(assessMesh(hull.mesh, execution).volume > 0.0, "a hull's volume");
        }
      }
    }
  }
  catch (const Error&)
  {
  }
  return 0;
}
