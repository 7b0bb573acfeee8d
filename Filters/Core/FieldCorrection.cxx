// SPDX-License-Identifier: BSD-3-Clause
#include "FieldCorrection.h"

#include "BlockAgreement.h"
#include "BlockBits.h"
#include "ContourDeficit.h"
#include "ContourLimit.h"
#include "Error.h"
#include "FieldRaising.h"
#include "FieldRefinement.h"
#include "FieldSmoothing.h"
#include "FirstTouch.h"
#include "LeastDistances.h"
#include "NearViews.h"
#include "ParameterRange.h"
#include "SurfaceCells.h"
#include "ViewAlignment.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string>

namespace silhouette
{
namespace
{

constexpr std::size_t BlockPoints = FieldViews::BlockPoints;
constexpr double FinestShift = 0.1; ///< px: the contours of clean silhouettes seem shifted by up to two thirds of this
constexpr int MostAlignments = 100;
/**
 * How far a round's shifts are gone: a first round leaves about a fifth of them, later ones half of what there is, since the surface, the least of all views', follows the
 * wrong ones.
 */
constexpr double FirstStep = 1.25, LaterStep = 1.6;
constexpr double SamplesPerOctant = 2.0; ///< of the silhouettes' distances: they are straight but for corners
constexpr int MostHalvings = 3;          ///< between the lattice of the field and that of the octants
constexpr double FinestSmoothing = 1.9;  ///< octants of the field's lattice, where contours alone are noisy
constexpr double FinestOfFine = 0.7;     ///< the same of a lattice with ThoughtOutAt cells a side and more, whose octants are little of the object
constexpr double FinestAligned = 3.0;    ///< the same where views may have to be aligned, of any lattice
constexpr int RefinedMargin = 3;         ///< octants that the field is given around the surface

void check(const FieldCorrectionOptions& options)
{
  requireRange("smallest deficit", options.smallestDeficit, 0.0);
  requireRange("smallest shift", options.smallestShift, 0.0);
  requireRange("shift noise", options.shiftNoise, 0.0);
  requireRange("alignments", options.alignments, 1, MostAlignments);
  requireRange("model dissent", options.modelDissent, 0.0, 1.0);
  requireRange("smoothing", options.smoothing, 0.0);
  requireRange("greatest smoothing", options.greatestSmoothing, 0.0);
  requireRange("gentleness", options.gentleness, 0.0);
  requireAboveZero("contour reach", options.contourReach);
  requireRange("hull convexity", options.hullConvexity, 0.0);
  requireRange("raise width", options.raiseWidth, 0.0, WidestRaising);
}

/** Lengths that go with the lattice, in its octants. */
struct Lengths
{
  double proportion; ///< of the lattice's cells to those that the largest lengths are stated for
  double scale;      ///< the same, but 1 at least: no band is narrower than three octants
  double octants = 1.0; ///< of the surface's for one of the lattice's

  explicit Lengths(const Lattice& lattice)
    : proportion(lattice.cells() / ThoughtOutAt)
    , scale(lengthScale(lattice))
  {
  }

  /** On a lattice with fewer generations. */
  Lengths coarser(int halvings) const
  {
    Lengths lengths = *this;
    lengths.octants = double(1 << halvings);
    lengths.proportion /= lengths.octants;
    lengths.scale /= lengths.octants;
    return lengths;
  }

  double limit() const { return ContourLimit * this->scale; } ///< contours that are further apart are not each other's
  double reach() const { return 4.0 * this->scale; } ///< distances are cut off there
};

class Correction
{
public:
  Correction(const Mesh& surface, FieldViews& views, const Lengths& lengths, const FieldCorrectionOptions& options)
    : Options(options)
    , Views(views)
    , Length(lengths)
    , Surface(surface)
    , All(views.size())
    , Some(everyThirdView(views.size()))
  {
    std::iota(this->All.begin(), this->All.end(), 0);
  }

  /**
   * `cells`: those of the surface's points; `measured`: the residuals of some views against the surface, which count where this lattice is the surface's; null where they tell that no camera is
   * wrong. Lengths are octants of this lattice.
   */
  void run(const std::vector<std::uint64_t>& cells, const std::vector<ContourResidual>* measured, FieldCorrection& result, Execution& execution)
  {
    // As wide as smoothing reaches by one standard deviation, for the noise there is.
    this->Band = std::clamp(
      this->Options.smoothing * std::max(result.deficit, result.shift), 3.0 / this->Length.octants, 3.0 * this->Length.scale);
    this->Least = BrickField(this->Views.lattice(), cells, int(std::ceil(this->Band)), execution);
    this->Views.observe(this->All, execution);
    result.remainingDeficit = result.deficit;
    const bool isAligned = this->Options.alignViews && measured && this->align(*measured, execution);
    if (isAligned)
    {
      double sum = 0.0;
      for (const int view : this->All)
      {
        sum += this->Views.shift(view).norm();
      }
      result.alignment = sum / double(this->All.size());
    }
    execution.checkpoint(0.5);
    this->findLeast(this->modelRank(), execution);
    if (isAligned)
    {
      result.remainingDeficit = std::max(0.0, typicalResidual(this->residuals(this->Least.contourMesh(execution), this->Some, execution)));
    }
    execution.checkpoint(0.65);
    if (this->Options.moveSurface)
    {
      this->move(result, execution);
    }
    result.field = std::move(this->Least);
  }

private:
  std::vector<ContourResidual> residuals(const Mesh& model, const std::vector<int>& views, Execution& execution) const
  {
    return contourResiduals(this->Views, model, views, this->Length.limit(), execution);
  }

  /** Residuals of all views against the surface, of which some are known. */
  std::vector<ContourResidual> completed(const std::vector<ContourResidual>& measured, Execution& execution) const
  {
    std::vector<ContourResidual> all(this->All.size());
    std::vector<int> others;
    std::set_difference(
      this->All.begin(), this->All.end(), this->Some.begin(), this->Some.end(), std::back_inserter(others));
    const auto residuals = this->residuals(this->Surface, others, execution);
    for (std::size_t n = 0; n < measured.size(); ++n)
    {
      all[this->Some[n]] = measured[n];
    }
    for (std::size_t n = 0; n < others.size(); ++n)
    {
      all[others[n]] = residuals[n];
    }
    return all;
  }

  /**
   * Shift the views towards the contours of the surface, then of the surface of the shifted views, and so on. Where the field's lattice is coarser than the
   * surface's, its own surface comes first: it has fewer triangles. False where chance alone may have shifted them: then they are left as they are.
   */
  bool align(const std::vector<ContourResidual>& measured, Execution& execution)
  {
    for (int round = 0; round < this->Options.alignments; ++round)
    {
      const bool isMeasured = round == 0 && this->Length.octants == 1.0;
      if (!isMeasured)
      {
        this->findLeast(1, execution);
      }
      auto residuals = isMeasured ? this->completed(measured, execution) : this->residuals(this->Least.contourMesh(execution), this->All, execution);
      removeCommonShift(this->Views, this->All, residuals);
      if (round == 0 && noiseShare(residuals) > this->Options.shiftNoise)
      {
        return false;
      }
      for (const int view : this->All)
      {
        this->Views.addShift(view, (round == 0 ? FirstStep : LaterStep) * residuals[view].shift);
      }
      execution.checkpoint(0.5 * (round + 1) / this->Options.alignments);
    }
    return true;
  }

  /** Of the distances in the observed silhouettes, which is the model's? */
  int modelRank() const
  {
    const int views = this->Views.size();
    const double share = this->Options.modelDissent / (this->Length.scale * this->Length.octants); // whatever the field's lattice
    return std::min(std::max(2, int(std::lround(share * views))), views);
  }

  /** The least and the `rank`-th least distance over the observed silhouettes. */
  void findLeast(int rank, Execution& execution)
  {
    if (this->Ranked.size() != this->Least.size())
    {
      this->Ranked.clear();
      resizeSideBySide(this->Ranked, this->Least.size(), execution);
    }
    const auto take = [&](std::size_t block, const BlockGroups&, const float* least)
    {
      std::copy_n(least, BlockPoints, &this->Least.values()[block]);
      std::copy_n(least + std::size_t(rank - 1) * BlockPoints, BlockPoints, &this->Ranked[block]);
    };
    const auto areFar = [far = float(this->Views.reach())](std::size_t, const BlockGroups&, std::size_t from, const float* greatest)
    { return std::size_t(std::find_if(greatest + from, greatest + BlockPoints, [far](float value) { return value > -far; }) - greatest); };
    const auto all = [](std::size_t) { return BlockGroups::all(); };
    forLeastDistances(this->Least, this->Views, rank, [&] { return BlockQuestions{ all, areFar, take }; }, execution);
  }

  /** From the least distance to the model, and from the model to where the views agree. */
  void move(FieldCorrection& result, Execution& execution)
  {
    const double deficit = result.remainingDeficit;
    const double widest = this->Views.lattice().cells(); // whatever is asked for
    const double sigma = std::min({ this->Options.greatestSmoothing * this->Length.proportion,
      std::min(this->Options.smoothing, widest) * deficit, widest });
    this->makeModel(deficit, execution);
    const auto most = float(deficit * this->Options.gentleness); // noise is no larger, thin parts are
    FieldSmoother smoother;
    smoother.smooth(this->Least, sigma, most, execution);
    execution.checkpoint(0.75);
    Mesh surface = this->Least.contourMesh(execution);
    result.hull = applyHullBase(this->Least, surface, this->Options.hullConvexity, this->Band, execution);
    if (result.hull.applied)
    {
      surface = this->Least.contourMesh(execution);
    }
    this->findAgreed(this->Views.distances(surface, execution), execution);
    smoother.smooth(this->Least, sigma, most, execution);
  }

  /** From the two kinds of distances. */
  void makeModel(double deficit, Execution& execution)
  {
    std::vector<float>& values = this->Least.values();
    execution.forRanges(values.size(), 1 << 16,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first; n < last; ++n)
        {
          values[n] = std::min(this->Ranked[n], values[n] + float(2.0 * deficit));
        }
      });
  }

  /** From the model's field to where its views agree, in the ranked distances' memory; `maps`: the distances in the model's silhouettes. */
  void findAgreed(const std::vector<DistanceMap>& maps, Execution& execution)
  {
    execution.checkpoint(0.85);
    const std::vector<float>& model = this->Least.values();
    std::vector<float>& values = this->Ranked;
    execution.forRanges(values.size(), 1 << 16,
      [&](std::size_t first, std::size_t last) { std::copy(&model[first], &model[0] + last, &values[first]); });
    const float band = float(this->Band);
    const auto inBand = [&](float value) { return std::abs(value) < band; };
    const auto concerns = [&](std::size_t block) { return BlockGroups::where([&](std::size_t n) { return inBand(model[block + n]); }); };
    const auto makeWork = [&]
    {
      const auto agree = [&, own = std::vector<float>(maps.size() * BlockPoints)](std::size_t block, const BlockGroups& groups, const std::vector<NearView>& near) mutable
      {
        const LatticePoint lowest = fromMorton(this->Least.code(block));
        for (std::size_t i = 0; i < near.size(); ++i)
        {
          if (i + 1 < near.size())
          {
            this->Views.fetch(maps[near[i + 1].view], near[i + 1].region);
            this->Views.fetch(this->Views.observed(near[i + 1].view), near[i + 1].region);
          }
          this->Views.insideBlock(near[i].view, lowest, near[i].region, groups, maps[near[i].view], &own[i * BlockPoints]);
        }
        float agreed[BlockPoints];
        this->agree(lowest, groups, near, own.data(), agreed);
        const bool atBorder = touchesBorder(this->Views.lattice(), lowest);
        for (std::size_t n = 0; n < groups.points(); ++n)
        {
          const std::size_t point = groups.point(n);
          if (inBand(model[block + point]))
          {
            const bool border = atBorder && this->Views.lattice().onBorder(lowest + fromMorton(point));
            values[block + point] = border ? -float(this->Views.reach()) : agreed[n];
          }
        }
      };
      return BlockWork{ concerns, agree };
    };
    forBlocks(this->Least, this->Views, &maps, makeWork, execution);
    this->Least.values().swap(values);
  }

  /**
   * What the field is to be at the points of some groups of a block. `own` holds their distances in the model's silhouettes for the views that are near; others say the whole
   * reach, in those and in the observed ones.
   */
  void agree(const LatticePoint& lowest, const BlockGroups& groups, const std::vector<NearView>& near, const float* own, float* agreed) const
  {
    const float far = float(this->Views.reach());
    BlockAgreement views(groups.points(), far, float(this->Options.contourReach * this->Length.proportion), float(this->Length.limit()));
    for (std::size_t n = 0; n < near.size(); ++n)
    {
      views.approach(&own[n * BlockPoints]);
    }
    float others[BlockPoints], seen[BlockPoints];
    std::fill(others, others + BlockPoints, far);
    const BlockGroups whereOthersAreHeard = views.heard(others);
    std::size_t next = 0;
    for (const int view : this->All)
    {
      if (next == near.size() || near[next].view != view)
      {
        views.hear(whereOthersAreHeard, others, others);
        continue;
      }
      const float* const modelled = &own[next * BlockPoints];
      const BlockGroups heard = views.heard(modelled);
      if (!heard.empty())
      {
        this->Views.insideBlock(view, lowest, near[next].region, groups.at(heard), this->Views.observed(view), seen);
        views.hear(heard, modelled, seen);
      }
      ++next;
    }
    for (std::size_t n = 0; n < groups.points(); ++n)
    {
      agreed[n] = std::clamp(views.least(n) + views.difference(n), -far, far);
    }
  }

  const FieldCorrectionOptions& Options;
  FieldViews& Views;
  Lengths Length;
  const Mesh& Surface;
  std::vector<int> All;
  std::vector<int> Some;   ///< every third view
  double Band = 3.0;       ///< octants: as far from the surface the field is corrected
  BrickField Least;
  std::vector<float> Ranked; ///< what the model is made of, at the same points; then of any value
};

/** Generations by which the field's lattice may be coarser than the surface's, for the smoothing that the deficit calls for. */
int halvingsFor(double deficit, bool mayBeCameras, const Lattice& lattice, const FieldCorrectionOptions& options)
{
  const double sigma = std::min(options.greatestSmoothing * Lengths(lattice).proportion, options.smoothing * deficit);
  const auto isFineEnough = [&](int halvings)
  {
    const bool isFine = double(lattice.cells() >> halvings) >= ThoughtOutAt;
    const double least = mayBeCameras ? FinestAligned : isFine ? FinestOfFine : FinestSmoothing;
    return sigma >= least * double(1 << halvings);
  };
  int halvings = 0;
  while (halvings < std::min(MostHalvings, lattice.depth - 1) && isFineEnough(halvings + 1))
  {
    ++halvings;
  }
  return halvings;
}

/** Leaf cells that the surface will have to cross, and the background votes that they were carved with. */
struct Survivors
{
  const std::vector<std::uint64_t>& cells;
  int backgroundVotes;
};

/** `result` and `residuals`, which may be null as Correction has them, in octants of the lattice, which the field's is where the residuals count. */
void correctOnCoarserLattice(const Mesh& surface, const Lattice& lattice, const PreparedViews& views, const FieldCorrectionOptions& options,
  const std::vector<ContourResidual>* residuals, const Survivors& survivors, FieldCorrection& result, Execution& execution)
{
  const int halvings = halvingsFor(result.deficit, residuals != nullptr, lattice, options);
  const Lengths lengths = Lengths(lattice).coarser(halvings);
  FieldViews fieldViews(views, { lattice.root, lattice.depth - halvings }, lengths.reach(), SamplesPerOctant);
  FieldCorrection coarse;
  coarse.deficit = result.deficit / lengths.octants;
  coarse.shift = result.shift / lengths.octants;
  const std::vector<std::uint64_t> cells = surfaceCells(surface, lattice, execution);
  Correction(surface, fieldViews, lengths, options).run(coarserCells(cells, halvings), residuals, coarse, execution);
  result.remainingDeficit = coarse.remainingDeficit * lengths.octants;
  result.alignment = coarse.alignment;
  result.hull = coarse.hull;
  result.field = halvings == 0 ? std::move(coarse.field)
                               : refinedField(*coarse.field, halvings, cells, RefinedMargin, execution);
  execution.checkpoint(0.95);
  if (options.raiseWidth > 0.0)
  {
    fieldViews.look(lattice, Lengths(lattice).reach()); // as their cameras say, from where the survivors were carved
    raiseToSurvivors(*result.field, survivors.cells, fieldViews, survivors.backgroundVotes, options.raiseWidth, execution);
  }
}

} // namespace

FieldCorrection correctField(const Mesh& surface, const Lattice& lattice, const PreparedViews& views,
  const FieldCorrectionOptions& options, const std::vector<std::uint64_t>& survivors, int backgroundVotes, Execution& execution)
{
  check(options);
  FieldCorrection result;
  if (surface.triangles.empty() || !(options.alignViews || options.moveSurface))
  {
    return result;
  }
  const Lengths lengths(lattice);
  FieldViews fieldViews(views, lattice, lengths.reach());
  const ContourDeficit measured(fieldViews, surface, lengths.limit(), options.smallestDeficit, options.shiftNoise, execution);
  result.deficit = measured.octants;
  result.shift = measured.shift.octants;
  execution.checkpoint(0.3);
  // A surface that some views may dissent from has no deficit: its contours differ from the silhouettes' by design.
  if (result.deficit > options.smallestDeficit ||
    (2.0 * result.deficit > options.smallestDeficit && result.shift > options.smallestShift &&
      measured.shift.pixels > FinestShift))
  {
    Phase correcting(execution, 0.3, 1.0);
    const auto* residuals = measured.mayBeCameras(options.shiftNoise) ? &measured.residuals : nullptr;
    correctOnCoarserLattice(surface, lattice, views, options, residuals, { survivors, backgroundVotes }, result, correcting);
  }
  execution.progress(1.0);
  return result;
}

} // namespace silhouette
