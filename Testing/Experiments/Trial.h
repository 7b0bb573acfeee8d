// SPDX-License-Identifier: BSD-3-Clause
/**
 * What all methods of one case share: the object and its reference, the case's views, octrees and marching-
 * cubes surface.
 */
#pragma once

#include "Cases.h"
#include "Octree.h"
#include "PreparedViews.h"
#include "SmpExecution.h"
#include "SurvivorIslands.h"
#include "Yardstick.h"

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace silhouette::experiments
{

/** Seconds since it was made. */
class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

/**
 * The cube that every capture is carved in, so that the octants of all methods and of the reference agree.
 */
RootCube studyCube();

/** An object with what is the same in all its cases. */
struct Subject
{
  Subject(const Object& object, const Settings& settings, Execution& execution);

  const Object& object;
  Yardstick solid;                      ///< its own mesh
  SyntheticCapture capture;             ///< the clean masks; the noise is that of the last trial
  /** Exact marching cubes of the clean masks, two generations deeper; the solid's own mesh where it is thin. */
  std::unique_ptr<Yardstick> reference;
};

/** One case under work. */
class Trial
{
public:
  /** `first`: of the first seed, for which more is measured. */
  Trial(Subject& subject, const Case& at, const Settings& settings, bool first, Execution& execution);

  const std::vector<View>& views() const { return this->Views; }
  const PreparedViews& prepared() const { return this->Prepared; }
  /** The octree that allows k background votes. Throws NothingSurvives. */
  const Octree& octree(int backgroundVotes);
  /** Components of that octree's survivors. */
  std::uint64_t survivorPieces(int backgroundVotes);
  /** Exact marching cubes of the strict octree: the imperfect surface that methods start from. */
  const Mesh& imperfect();
  /** What it took to make it. */
  double imperfectSeconds() const { return this->ImperfectSeconds; }

  bool isFirst() const { return this->IsFirst; }
  const Subject& subject() const { return this->TheSubject; }
  Execution& execution() { return this->TheExecution; }

  std::string note;         ///< what a method has to say of its run; emptied before the next
  DroppedSurvivors dropped; ///< what it gave up; likewise

private:
  Subject& TheSubject;
  Execution& TheExecution;
  int Depth;
  bool IsFirst;
  std::vector<View> Views;
  PreparedViews Prepared;
  std::map<int, Octree> Octrees;
  std::set<int> Empty; ///< votes for which nothing survives: known at once, since to find out is slow
  std::map<int, std::uint64_t> Pieces;
  std::unique_ptr<Mesh> Imperfect;
  double ImperfectSeconds = 0.0;
};

} // namespace silhouette::experiments
