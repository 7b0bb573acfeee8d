// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRuns.h"

#include <limits>

namespace silhouette
{
namespace
{

/** The columns at which runs begin and end, one after another, and then one beyond all. */
class Turns
{
public:
  Turns(const PixelRun* first, const PixelRun* last)
    : Run(first)
    , Last(last)
  {
  }

  std::int32_t now() const
  {
    return this->Run == this->Last ? std::numeric_limits<std::int32_t>::max() : this->IsEnd ? this->Run->end : this->Run->begin;
  }

  void pass()
  {
    this->Run += this->IsEnd;
    this->IsEnd = !this->IsEnd;
  }

private:
  const PixelRun* Run;
  const PixelRun* Last;
  bool IsEnd = false;
};

} // namespace

SilhouetteRuns runsOf(const BinaryImage& image)
{
  SilhouetteRuns runs{ image.width, image.height, {}, { 0 } };
  for (int row = 0; row < image.height; ++row)
  {
    const auto first = image.pixels.begin() + std::ptrdiff_t(row) * image.width, last = first + image.width;
    for (auto at = std::find(first, last, 1); at != last; at = std::find(at, last, 1))
    {
      const auto from = at;
      at = std::find(at, last, 0);
      runs.runs.push_back({ std::int32_t(from - first), std::int32_t(at - first) });
    }
    runs.firstOfRow.push_back(runs.runs.size());
  }
  return runs;
}

void drawRuns(const SilhouetteRuns& runs, BinaryImage& image)
{
  image.width = runs.width;
  image.height = runs.height;
  image.pixels.assign(std::size_t(runs.width) * std::size_t(runs.height), 0);
  for (int row = 0; row < runs.height; ++row)
  {
    std::uint8_t* pixels = image.pixels.data() + std::size_t(row) * std::size_t(runs.width);
    for (const PixelRun* run = runs.begin(row); run != runs.end(row); ++run)
    {
      std::fill(pixels + run->begin, pixels + run->end, std::uint8_t(1));
    }
  }
}

std::vector<ContourPlace> contourPlaces(const SilhouetteRuns& runs)
{
  std::vector<ContourPlace> places;
  for (int row = 0; row < runs.height; ++row)
  {
    const int below = std::min(row + 1, runs.height - 1); // nothing differs below the last row
    Turns beside(runs.begin(row), runs.end(row)), own = beside, others(runs.begin(below), runs.end(below));
    const auto placeBeside = [&]
    {
      const std::int32_t turn = beside.now();
      if (turn > 0 && turn < runs.width)
      {
        places.push_back({ turn - 1, row, false });
      }
      beside.pass();
    };
    // The row and the one below differ between each two columns at which one of them turns alone.
    bool differ = false;
    const std::int32_t beyond = std::numeric_limits<std::int32_t>::max();
    while (std::min(own.now(), others.now()) != beyond)
    {
      const std::int32_t from = std::min(own.now(), others.now());
      const bool turnsOwn = own.now() == from, turnsOther = others.now() == from;
      turnsOwn ? own.pass() : void();
      turnsOther ? others.pass() : void();
      differ = differ != (turnsOwn != turnsOther);
      const std::int32_t to = std::min(own.now(), others.now());
      for (std::int32_t column = from; differ && column < to; ++column)
      {
        while (beside.now() <= column + 1)
        {
          placeBeside();
        }
        places.push_back({ column, row, true });
      }
    }
    while (beside.now() != beyond)
    {
      placeBeside();
    }
  }
  return places;
}

} // namespace silhouette
