// SPDX-License-Identifier: BSD-3-Clause
#include "CarvingTolerance.h"

#include "ParameterRange.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <optional>
#include <string>

namespace silhouette
{
namespace
{

constexpr double GreatestDilation = 10.0;

void check(const PreparedViews& views, const CarvingToleranceOptions& options)
{
  if (options.backgroundVotes < 0 || options.backgroundVotes >= views.size())
  {
    throw InvalidInput("background votes " + std::to_string(options.backgroundVotes) + " are outside 0 to " +
      std::to_string(views.size() - 1) + " (the number of views less one)");
  }
  requireRange("uncovered share", options.uncoveredShare, 0.0, 1.0);
  if (!(options.voteShare >= 0.0 && options.voteShare < 1.0))
  {
    throw InvalidInput(
      "share of the views " + numberText(options.voteShare) + " is outside 0 to below 1");
  }
  requireRange("dilation in octants", options.greatestDilation, 0.0, GreatestDilation);
}

BinaryImage dilated(const PreparedView& view, int radius)
{
  BinaryImage image{ view.width, view.height, {} };
  image.pixels.assign(std::size_t(view.width) * view.height, 0);
  std::vector<int> halfWidth;
  for (int d = 0; d <= radius; ++d)
  {
    halfWidth.push_back(int(std::sqrt((radius + 0.5) * (radius + 0.5) - double(d) * d)));
  }
  const auto within = [&](int column, int row, int width, int height)
  {
    const int c0 = std::max(0, column - width), c1 = std::min(view.width - 1, column + width);
    const int r0 = std::max(0, row - height), r1 = std::min(view.height - 1, row + height);
    return r0 <= r1 && view.contentInImage(c0, c1, r0, r1).object;
  };
  const auto& box = view.objectBox;
  for (int row = std::max(0, box[2] - radius); row <= std::min(view.height - 1, box[3] + radius); ++row)
  {
    const int end = std::min(view.width, box[1] + radius + 1);
    for (int column = std::max(0, box[0] - radius); column < end; ++column)
    {
      bool object = within(column, row, 0, 0);
      if (!object && within(column, row, radius, radius))
      {
        for (int d = -radius; d <= radius && !object; ++d)
        {
          const bool there = row + d >= 0 && row + d < view.height;
          object = there && within(column, row + d, halfWidth[std::abs(d)], 0);
        }
      }
      image.at(column, row) = object;
    }
  }
  return image;
}

/** Tries tolerances and keeps what it has to. */
class Search
{
public:
  Search(std::shared_ptr<const PreparedViews> views, const Carve& carve,
    const CarvingToleranceOptions& options, Execution& execution)
    : Given(std::move(views))
    , CarveOnce(carve)
    , Options(options)
    , Exec(execution)
  {
  }

  TolerantCarving run()
  {
    std::exception_ptr nothingSurvives; // of the strict octree
    std::optional<TolerantCarving> strict;
    try
    {
      strict = this->attempt(this->Options.backgroundVotes, 0);
    }
    catch (const NothingSurvives&)
    {
      if (this->emptySilhouettes() > this->Options.backgroundVotes)
      {
        throw;
      }
      nothingSurvives = std::current_exception();
    }
    const int least = this->Options.backgroundVotes;
    const int most =
      std::max(least, int(std::floor(this->Options.voteShare * this->Given->size() + 1e-9)));
    this->StrictUncovered = strict ? strict->uncovered : 1.0;
    if (strict && this->borne(*strict))
    {
      return this->finished(std::move(*strict));
    }
    std::optional<TolerantCarving> voted, dilated;
    const auto withVotes = [&](int k) { return this->attemptOrNothing(k, 0); };
    if (this->findLeast(least, most, withVotes, voted))
    {
      return this->finished(std::move(*voted));
    }
    const auto withDilation = [&](int radius) { return this->attemptOrNothing(most, radius); };
    if (const auto& some = strict ? strict : voted)
    {
      const double widest = this->Options.greatestDilation * pixelsPerOctant(*this->Given, some->octree.lattice);
      if (this->findLeast(0, int(std::floor(widest + 1e-9)), withDilation, dilated))
      {
        return this->finished(std::move(*dilated));
      }
    }
    for (auto* partly : { &voted, &dilated })
    {
      if (*partly && (*partly)->uncovered <= 0.5 * this->StrictUncovered)
      {
        return this->finished(std::move(**partly));
      }
    }
    if (!strict)
    {
      std::rethrow_exception(nothingSurvives);
    }
    return this->finished(std::move(*strict));
  }

private:
  int emptySilhouettes() const
  {
    int empty = 0;
    for (int view = 0; view < this->Given->size(); ++view)
    {
      const PreparedView& one = (*this->Given)[view];
      empty += one.objectPixels(0, one.width, 0, one.height) == 0;
    }
    return empty;
  }

  bool borne(const TolerantCarving& carving) const
  {
    return carving.uncovered <= this->Options.uncoveredShare;
  }

  TolerantCarving finished(TolerantCarving carving) const
  {
    carving.strictUncovered = this->StrictUncovered;
    carving.carves = this->Carves;
    this->Exec.checkpoint(1.0);
    return carving;
  }

  TolerantCarving attempt(int backgroundVotes, int dilation)
  {
    // Nobody knows how many will follow: each takes half of what is left.
    const double from = 1.0 - std::ldexp(1.0, -this->Carves), to = 1.0 - std::ldexp(1.0, -this->Carves - 1);
    ++this->Carves;
    TolerantCarving carving;
    carving.views = this->Given;
    carving.dilation = dilation;
    if (dilation > 0)
    {
      carving.dilatedViews = dilatedSilhouettes(*this->Given, dilation, this->Exec);
      carving.views =
        std::make_shared<const PreparedViews>(carving.dilatedViews, this->Given->options(), this->Exec);
    }
    Phase carvingPhase(this->Exec, from, from + 0.8 * (to - from));
    carving.octree = this->CarveOnce(*carving.views, backgroundVotes, carvingPhase);
    Phase measuring(this->Exec, from + 0.8 * (to - from), to);
    const std::vector<double> shares =
      uncoveredShares(carving.octree, *this->Given, this->Options.measure, measuring);
    carving.uncovered = std::accumulate(shares.begin(), shares.end(), 0.0) / double(shares.size());
    const auto greatest = std::max_element(shares.begin(), shares.end());
    carving.leastCoveredView = int(greatest - shares.begin());
    carving.greatestUncovered = *greatest;
    return carving;
  }

  /** More votes may leave the object without automatic bounds; then these are too many. Of few still nothing may survive. */
  std::optional<TolerantCarving> attemptOrNothing(int backgroundVotes, int dilation)
  {
    try
    {
      return this->attempt(backgroundVotes, dilation);
    }
    catch (const UnboundedObject&)
    {
      return std::nullopt;
    }
    catch (const NothingSurvives&)
    {
      return std::nullopt;
    }
  }

  /**
   * The least value above `failed`, up to `most`, that is borne; true if there is one. Else `found` is what
   * `most` gives, or nothing.
   */
  template <typename Try>
  bool findLeast(int failed, int most, const Try& tryOne, std::optional<TolerantCarving>& found)
  {
    int good = failed;
    for (int step = 1; failed < most; step *= 2)
    {
      good = std::min(most, failed + step);
      found = tryOne(good);
      if (found && this->borne(*found))
      {
        break;
      }
      failed = good;
    }
    if (!found || !this->borne(*found))
    {
      return false;
    }
    while (good - failed > 1)
    {
      const int middle = failed + (good - failed) / 2;
      auto tried = tryOne(middle);
      if (tried && this->borne(*tried))
      {
        found = std::move(tried);
        good = middle;
      }
      else
      {
        failed = middle;
      }
    }
    return true;
  }

  std::shared_ptr<const PreparedViews> Given;
  const Carve& CarveOnce;
  const CarvingToleranceOptions& Options;
  Execution& Exec;
  double StrictUncovered = 0.0;
  int Carves = 0;
};

} // namespace

TolerantCarving carveTolerantly(std::shared_ptr<const PreparedViews> views, const Carve& carve,
  const CarvingToleranceOptions& options, Execution& execution)
{
  check(*views, options);
  return Search(std::move(views), carve, options, execution).run();
}

std::vector<View> dilatedSilhouettes(const PreparedViews& views, int radius, Execution& execution)
{
  std::vector<View> all(static_cast<std::size_t>(views.size()));
  execution.forRanges(all.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const PreparedView& view = views[int(i)];
        all[i] = { view.name, view.projection, dilated(view, radius) };
      }
    });
  return all;
}

} // namespace silhouette
