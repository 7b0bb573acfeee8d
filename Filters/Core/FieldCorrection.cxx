// SPDX-License-Identifier: BSD-3-Clause
#include "FieldCorrection.h"

#include "Error.h"
#include "ViewAlignment.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace silhouette
{
namespace
{

constexpr int BlockSize = 4;             ///< points a side of a block, in which views are asked or not
constexpr std::size_t BlockPoints = 64;  ///< consecutive in Morton order
constexpr double FinestShift = 0.1; ///< px: the contours of clean silhouettes seem shifted by up to two thirds of this
constexpr double ThoughtOutAt = 128.0; ///< cells a side of the lattice that the largest lengths are stated for

void check(const FieldCorrectionOptions& options)
{
  const auto require = [](bool fine, const char* name, double value)
  {
    if (!fine)
    {
      throw InvalidInput(std::string(name) + " " + std::to_string(value) + " is out of range");
    }
  };
  require(options.smallestDeficit >= 0.0, "smallest deficit", options.smallestDeficit);
  require(options.smallestShift >= 0.0, "smallest shift", options.smallestShift);
  require(options.alignments >= 1, "number of alignments", options.alignments);
  require(options.smoothing >= 0.0, "smoothing", options.smoothing);
  require(options.greatestSmoothing >= 0.0, "greatest smoothing", options.greatestSmoothing);
  require(options.gentleness >= 0.0, "gentleness", options.gentleness);
  require(options.contourReach > 0.0, "contour reach", options.contourReach);
  require(options.hullConvexity >= 0.0, "hull convexity", options.hullConvexity);
}

std::vector<std::uint64_t> cellsOf(const Mesh& surface, const Lattice& lattice)
{
  std::vector<std::uint64_t> cells;
  cells.reserve(surface.points.size());
  const int last = lattice.cells() - 1;
  for (const auto& p : surface.points)
  {
    const Eigen::Array3d x = ((p - lattice.root.origin).array() / lattice.leafEdge()).floor();
    if (x.isFinite().all())
    {
      const auto c = x.max(0.0).min(double(last)).cast<int>().eval();
      cells.push_back(mortonCode({ c[0], c[1], c[2] }));
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/** The mean length of the shifts of the views that say anything. */
struct TypicalShift
{
  double octants = 0.0;
  double pixels = 0.0;

  TypicalShift(
    const std::vector<ContourResidual>& residuals, const std::vector<int>& views, const FieldViews& fieldViews)
  {
    int count = 0;
    for (std::size_t n = 0; n < views.size(); ++n)
    {
      if (residuals[n].count > 0)
      {
        ++count;
        this->pixels += residuals[n].shift.norm();
        this->octants += residuals[n].shift.norm() / fieldViews.pixelsPerOctant(views[n]);
      }
    }
    this->pixels /= std::max(count, 1);
    this->octants /= std::max(count, 1);
  }
};

class Correction
{
public:
  Correction(const Mesh& surface, FieldViews& views, const FieldCorrectionOptions& options)
    : Options(options)
    , Views(views)
    , Proportion(views.lattice().cells() / ThoughtOutAt)
    , Scale(std::max(1.0, Proportion))
    , Surface(surface)
    , All(views.size())
  {
    std::iota(this->All.begin(), this->All.end(), 0);
  }

  double limit() const { return 3.0 * this->Scale; }

  void run(FieldCorrection& result, Execution& execution)
  {
    this->Least = BrickField(this->Views.lattice(), cellsOf(this->Surface, this->Views.lattice()), this->margin());
    this->Views.observe(this->All, execution);
    result.remainingDeficit = result.deficit;
    if (this->Options.alignViews)
    {
      this->align(execution);
      double sum = 0.0;
      for (const int view : this->All)
      {
        sum += this->Views.shift(view).norm();
      }
      result.alignment = sum / double(this->All.size());
    }
    execution.checkpoint(0.5);
    this->findLeast(execution);
    if (this->Options.alignViews)
    {
      result.remainingDeficit = std::max(0.0,
        typicalResidual(contourResiduals(this->Views, this->Least.contourMesh(execution), this->All, this->limit(), execution)));
    }
    execution.checkpoint(0.65);
    if (this->Options.moveSurface)
    {
      this->move(result, execution);
    }
    result.field = std::move(this->Least);
  }

private:
  int margin() const { return int(std::ceil(3.0 * this->Scale)); }

  /** Shift the views towards the contours of the surface, then of the surface of the shifted views, and so on. */
  void align(Execution& execution)
  {
    Mesh model = this->Surface;
    for (int round = 0; round < this->Options.alignments; ++round)
    {
      const auto residuals = contourResiduals(this->Views, model, this->All, this->limit(), execution);
      for (const int view : this->All)
      {
        this->Views.addShift(view, residuals[view].shift);
      }
      if (round + 1 < this->Options.alignments)
      {
        this->findLeast(execution);
        model = this->Least.contourMesh(execution);
      }
      execution.checkpoint(0.5 * (round + 1) / this->Options.alignments);
    }
  }

  /** The least and the second-least distance over the observed silhouettes. */
  void findLeast(Execution& execution)
  {
    this->Second.assign(this->Least.size(), 0.0f);
    const float far = -float(this->Views.reach());
    execution.forRanges(this->Least.size() / BlockPoints, 8,
      [&](std::size_t first, std::size_t last)
      {
        std::vector<int> near;
        for (std::size_t block = first; block < last; ++block)
        {
          this->findNear(fromMorton(this->Least.code(block * BlockPoints)), nullptr, near);
          for (std::size_t n = block * BlockPoints; n < (block + 1) * BlockPoints; ++n)
          {
            const LatticePoint p = fromMorton(this->Least.code(n));
            float least = -far, second = -far;
            for (std::size_t i = 0; i < near.size() && !(least <= far && second <= far); ++i)
            {
              const int view = near[i];
              const float distance = this->Views.inside(this->Views.observed(view), this->Views.place(view, p));
              second = std::min(second, std::max(least, distance));
              least = std::min(least, distance);
            }
            const bool border = this->Views.lattice().onBorder(p);
            this->Least.values()[n] = border ? far : least;
            this->Second[n] = border ? far : second;
          }
        }
      });
  }

  /** The views that say anything but the whole reach in a block of points: all that have to be asked there. */
  void findNear(const LatticePoint& block, const std::vector<DistanceMap>* maps, std::vector<int>& near) const
  {
    near.clear();
    for (const int view : this->All)
    {
      const FieldViews::Region region = this->Views.region(view, block, BlockSize);
      if (!this->Views.wholeReach(this->Views.observed(view), region) ||
        (maps && !this->Views.wholeReach((*maps)[view], region)))
      {
        near.push_back(view);
      }
    }
  }

  /** From the least distance to the model, and from the model to where the views agree. */
  void move(FieldCorrection& result, Execution& execution)
  {
    const double deficit = result.remainingDeficit;
    const double sigma =
      std::min(this->Options.greatestSmoothing * this->Proportion, this->Options.smoothing * deficit);
    BrickField model = this->Least;
    for (std::size_t n = 0; n < model.size(); ++n)
    {
      model.values()[n] = std::min(this->Second[n], model.values()[n] + float(2.0 * deficit));
    }
    smoothGently(model, sigma, deficit * this->Options.gentleness, execution);
    execution.checkpoint(0.75);
    result.hull = applyHullBase(model, this->Options.hullConvexity, 3.0 * this->Scale, execution);
    const auto maps = this->Views.distances(this->Views.render(model.contourMesh(execution), this->All, execution), execution);
    execution.checkpoint(0.85);
    const float reach = float(this->Options.contourReach * this->Proportion);
    execution.forRanges(model.size() / BlockPoints, 8,
      [&](std::size_t first, std::size_t last)
      {
        std::vector<float> own(maps.size()), seen(maps.size());
        std::vector<int> near;
        for (std::size_t block = first; block < last; ++block)
        {
          bool known = false;
          for (std::size_t n = block * BlockPoints; n < (block + 1) * BlockPoints; ++n)
          {
            this->Least.values()[n] = model.values()[n];
            if (std::abs(model.values()[n]) < 3.0f * float(this->Scale))
            {
              if (!known)
              {
                known = true;
                this->findNear(fromMorton(model.code(block * BlockPoints)), &maps, near);
                std::fill(own.begin(), own.end(), float(this->Views.reach()));
                std::fill(seen.begin(), seen.end(), float(this->Views.reach()));
              }
              this->Least.values()[n] = this->agreement(fromMorton(model.code(n)), maps, near, reach, own, seen);
            }
          }
        }
      });
    smoothGently(this->Least, sigma, deficit * this->Options.gentleness, execution);
  }

  /** Smooth, but change no value by more than `most`: noise is no larger, thin parts are. */
  static void smoothGently(BrickField& field, double sigma, double most, Execution& execution)
  {
    const std::vector<float> before = field.values();
    field.smooth(sigma, execution);
    for (std::size_t n = 0; n < before.size(); ++n)
    {
      field.values()[n] = std::clamp(field.values()[n], before[n] - float(most), before[n] + float(most));
    }
  }

  /** What the model is corrected by at a point. `own` and `seen` hold the whole reach for views that are not `near`. */
  float agreement(const LatticePoint& p, const std::vector<DistanceMap>& maps, const std::vector<int>& near, float reach,
    std::vector<float>& own, std::vector<float>& seen) const
  {
    const float far = float(this->Views.reach());
    if (this->Views.lattice().onBorder(p))
    {
      return -far;
    }
    float least = far;
    for (const int view : near)
    {
      const FieldViews::Place place = this->Views.place(view, p);
      own[view] = this->Views.inside(maps[view], place);
      seen[view] = this->Views.inside(this->Views.observed(view), place);
      least = std::min(least, own[view]);
    }
    float sum = 0.0f, weights = 0.0f;
    for (std::size_t view = 0; view < maps.size(); ++view)
    {
      const float x = (own[view] - least) / reach;
      const float residual = seen[view] - own[view];
      if (x < 3.0f && std::abs(residual) < float(this->limit()))
      {
        const float weight = std::exp(-0.5f * x * x);
        sum += weight * residual;
        weights += weight;
      }
    }
    return weights > 0.0f ? std::clamp(least + sum / weights, -far, far) : least;
  }

  const FieldCorrectionOptions& Options;
  FieldViews& Views;
  double Proportion; ///< of the lattice's cells to those that the largest lengths are stated for
  double Scale;      ///< the same, but that bands of the field and of views are never narrower than three octants
  const Mesh& Surface;
  std::vector<int> All;
  BrickField Least;
  std::vector<float> Second;
};

} // namespace

FieldCorrection correctField(const Mesh& surface, const Lattice& lattice, const PreparedViews& views,
  const FieldCorrectionOptions& options, Execution& execution)
{
  check(options);
  FieldCorrection result;
  if (surface.triangles.empty() || !(options.alignViews || options.moveSurface))
  {
    return result;
  }
  const double reach = 4.0 * std::max(1.0, lattice.cells() / ThoughtOutAt);
  FieldViews fieldViews(views, lattice, reach);
  std::vector<int> some;
  for (int view = 0; view < views.size(); view += 3)
  {
    some.push_back(view);
  }
  Correction correction(surface, fieldViews, options);
  const auto residuals = contourResiduals(fieldViews, surface, some, correction.limit(), execution);
  result.deficit = std::max(0.0, typicalResidual(residuals));
  const TypicalShift shift(residuals, some, fieldViews);
  result.shift = shift.octants;
  execution.checkpoint(0.3);
  // A surface that some views may dissent from has no deficit: its contours differ from the silhouettes' by design.
  if (result.deficit > options.smallestDeficit ||
    (2.0 * result.deficit > options.smallestDeficit && result.shift > options.smallestShift &&
      shift.pixels > FinestShift))
  {
    Phase correcting(execution, 0.3, 1.0);
    correction.run(result, correcting);
  }
  execution.progress(1.0);
  return result;
}

} // namespace silhouette
