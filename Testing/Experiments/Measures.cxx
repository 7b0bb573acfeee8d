// SPDX-License-Identifier: BSD-3-Clause
#include "Measures.h"

#include "Error.h"
#include "MeshSoundness.h"
#include "SilhouetteComparison.h"
#include "SurvivorCoverage.h"

#include <algorithm>
#include <exception>

namespace silhouette::experiments
{
namespace
{

/** Leaf octants between samples: most triangles of marching cubes are sampled once. */
constexpr double SampleSpacing = 1.5;
/** Triangles that are sampled of each surface. */
constexpr std::size_t SampledTriangles = 12000;
/** The same for what VTK and Qhull have: far from the reference, where distances are dear and tell little. */
constexpr std::size_t SampledTrianglesOfKnown = 3000;

void measureSoundness(const Mesh& mesh, Trial& trial, Row& row)
{
  const MeshSoundness soundness = assessMesh(mesh, trial.execution());
  row.value[Faces] = double(soundness.triangles);
  row.value[OpenEdges] = double(soundness.openEdges);
  row.value[NonManifoldEdges] = double(soundness.nonManifoldEdges);
  row.value[NonManifoldVertices] = double(soundness.nonManifoldVertices);
  row.value[InconsistentEdges] = double(soundness.inconsistentEdges);
  row.value[SelfIntersections] = double(soundness.selfIntersections);
  row.value[Pieces] = double(soundness.components);
  row.value[Volume] = soundness.volume;
  if (soundness.genus)
  {
    row.value[Genus] = double(*soundness.genus);
  }
}

/** What takes most of the time is measured with the first seed, of the methods that run with all. */
bool measuresMore(const Method& method, const Trial& trial)
{
  return trial.isFirst() && !method.firstSeedOnly && method.family != Family::Ablation;
}

struct BothWays
{
  SampledDistance to;
  SampledDistance from;
};

BothWays distances(const Yardstick& mesh, const Yardstick& truth, std::size_t triangles, double leaf,
                   Execution& execution)
{
  const double spacing = SampleSpacing * leaf;
  return {sampledDistance(mesh.surface(), truth, triangles, spacing, execution),
          sampledDistance(truth.surface(), mesh, triangles, spacing, execution)};
}

void measureErrors(const Mesh& mesh, const Method& method, Trial& trial, double leaf, Row& row)
{
  const Yardstick surface(mesh);
  const std::size_t triangles =
      method.family == Family::Known ? SampledTrianglesOfKnown : SampledTriangles;
  const BothWays reference =
      distances(surface, *trial.subject().reference, triangles, leaf, trial.execution());
  row.value[ErrorTo] = reference.to.mean / leaf;
  row.value[ErrorFrom] = reference.from.mean / leaf;
  row.value[Error] = (row.value[ErrorTo] + row.value[ErrorFrom]) / 2.0;
  row.value[Largest] = std::max(reference.to.largest, reference.from.largest) / leaf;
  if (measuresMore(method, trial))
  {
    const BothWays solid = distances(surface, trial.subject().solid, triangles, leaf, trial.execution());
    row.value[SolidError] = (solid.to.mean + solid.from.mean) / 2.0 / leaf;
  }
}

void measure(const Mesh& mesh, const Method& method, Trial& trial, Row& row)
{
  const Octree& octree = trial.octree(method.backgroundVotes);
  row.value[SurvivorPieces] = double(trial.survivorPieces(method.backgroundVotes));
  measureSoundness(mesh, trial, row);
  DroppedSurvivors dropped;
  row.value[Lost] =
      double(lostSurvivors(dropLeaves(octree, trial.dropped.leaves, dropped), mesh, trial.execution()));
  row.value[Dropped] = double(trial.dropped.octants);
  if (measuresMore(method, trial))
  {
    row.value[XorShare] = totalAgreement(compareSilhouettes(mesh, trial.views(), trial.execution())).xorShare;
  }
  measureErrors(mesh, method, trial, octree.lattice.leafEdge(), row);
}

/** What methods share, and what is not timed. Voting may have an octree where the strict one is empty. */
void makeReady(const Method& method, Trial& trial)
{
  try
  {
    trial.imperfect();
  }
  catch (const NothingSurvives&)
  {
  }
  trial.octree(method.backgroundVotes);
}

} // namespace

Row runMethod(const Method& method, Trial& trial, const Case& at, const Settings& settings)
{
  Row row;
  row.at = at;
  row.method = method.name;
  row.settings = settings;
  trial.note.clear();
  trial.dropped = {};
  try
  {
    makeReady(method, trial);
    const Stopwatch watch;
    const Mesh mesh = method.make(trial);
    row.value[Seconds] = watch.seconds();
    if (trial.imperfectSeconds() > 0.0)
    {
      row.value[TimeRatio] = row.value[Seconds] / trial.imperfectSeconds();
    }
    if (mesh.triangles.empty())
    {
      throw InvalidInput("the surface is empty");
    }
    measure(mesh, method, trial, row);
  }
  catch (const std::exception& error)
  {
    row.failure = error.what();
  }
  row.note = trial.note;
  return row;
}

} // namespace silhouette::experiments
