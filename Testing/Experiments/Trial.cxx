// SPDX-License-Identifier: BSD-3-Clause
#include "Trial.h"

#include "Carving.h"
#include "Error.h"
#include "LatticeRegions.h"
#include "VotingMarchingCubes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace silhouette::experiments
{
namespace
{

/** Distances from the reference beyond this are measured in its coarse stand-in; leaf octants. */
constexpr double FarOctants = 3.0;
/** The reference is two generations deeper than the octrees, but no deeper than this: it has to fit the memory. */
constexpr int DeepestReference = 10;

std::vector<View> viewsOf(const SyntheticCapture& capture)
{
  std::vector<View> views;
  for (const SyntheticView& view : capture.views)
  {
    views.push_back({view.name, view.projection, view.mask});
  }
  return views;
}

/** The views of a case, drawn in the subject's capture. */
std::vector<View> noisyViews(Subject& subject, const Case& at, const Settings& settings, Execution& execution)
{
  redrawNoise(subject.capture, subject.solid.surface(), captureOptions(at, settings), execution);
  return viewsOf(subject.capture);
}

Octree carveCube(const PreparedViews& views, int depth, int backgroundVotes, Execution& execution)
{
  CarveOptions options;
  options.backgroundVotes = backgroundVotes;
  return carve(LatticeViews(views, Lattice{studyCube(), depth}), options, execution);
}

Mesh exactCubes(const PreparedViews& views, int depth, Execution& execution)
{
  return votingMarchingCubes(carveCube(views, depth, 0, execution), views, VotingOptions(), execution).mesh;
}

int referenceDepth(int depth)
{
  return std::max(depth + 1, std::min(depth + 2, DeepestReference));
}

} // namespace

RootCube studyCube()
{
  return {Eigen::Vector3d::Constant(-1.0), 2.0};
}

Subject::Subject(const Object& which, const Settings& settings, Execution& execution)
    : object(which), solid(syntheticShape(which.shape))
{
  const Case clean{which.name, CleanName, 0.0, 0};
  this->capture = synthesizeCapture(this->solid.surface(), captureOptions(clean, settings), execution);
  if (which.thin)
  {
    this->reference = std::make_unique<Yardstick>(this->solid.surface());
    return;
  }
  const PreparedViews views(viewsOf(this->capture), ViewOptions(), execution);
  this->reference = std::make_unique<Yardstick>(exactCubes(views, referenceDepth(settings.depth), execution),
                                                exactCubes(views, settings.depth, execution),
                                                FarOctants * std::ldexp(studyCube().edge, -settings.depth));
}

Trial::Trial(Subject& subject, const Case& at, const Settings& settings, bool first, Execution& execution)
    : TheSubject(subject), TheExecution(execution), Depth(settings.depth), IsFirst(first),
      Views(noisyViews(subject, at, settings, execution)), Prepared(this->Views, ViewOptions(), execution)
{
}

const Octree& Trial::octree(int backgroundVotes)
{
  const auto found = this->Octrees.find(backgroundVotes);
  if (found != this->Octrees.end())
  {
    return found->second;
  }
  if (this->Empty.count(backgroundVotes) > 0)
  {
    throw NothingSurvives(NothingLeft);
  }
  try
  {
    Octree octree = carveCube(this->Prepared, this->Depth, backgroundVotes, this->TheExecution);
    return this->Octrees.emplace(backgroundVotes, std::move(octree)).first->second;
  }
  catch (const NothingSurvives&)
  {
    this->Empty.insert(backgroundVotes);
    throw NothingSurvives(NothingLeft);
  }
}

std::uint64_t Trial::survivorPieces(int backgroundVotes)
{
  const auto [found, isNew] = this->Pieces.emplace(backgroundVotes, 0);
  if (isNew)
  {
    found->second = countSurvivorComponents(this->octree(backgroundVotes), this->TheExecution);
  }
  return found->second;
}

const Mesh& Trial::imperfect()
{
  if (!this->Imperfect)
  {
    const Octree& strict = this->octree(0);
    const Stopwatch watch;
    this->Imperfect = std::make_unique<Mesh>(
        votingMarchingCubes(strict, this->Prepared, VotingOptions(), this->TheExecution).mesh);
    this->ImperfectSeconds = watch.seconds();
  }
  return *this->Imperfect;
}

} // namespace silhouette::experiments
