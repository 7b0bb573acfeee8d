// SPDX-License-Identifier: BSD-3-Clause
#include "UncoveredRegions.h"

#include "DistanceMap.h"
#include "UnionFind.h"

#include <algorithm>
#include <array>

namespace silhouette
{
namespace
{

/** The 8-connected regions of some pixels in order, by their first pixels'; those of each in order. */
std::vector<std::vector<RowColumn>> regionsOf(const std::vector<RowColumn>& pixels)
{
  UnionFind sets(pixels.size());
  std::size_t above = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const auto [row, column] = pixels[i];
    if (i > 0 && pixels[i - 1] == RowColumn(row, column - 1))
    {
      sets.unite(std::uint32_t(i - 1), std::uint32_t(i));
    }
    while (above < i && pixels[above] < RowColumn(row - 1, column - 1))
    {
      ++above;
    }
    for (std::size_t n = above; n < i && pixels[n] <= RowColumn(row - 1, column + 1); ++n)
    {
      sets.unite(std::uint32_t(n), std::uint32_t(i));
    }
  }
  std::vector<std::vector<RowColumn>> regions;
  std::vector<std::size_t> number(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const std::uint32_t first = sets.find(std::uint32_t(i)); // the least, so it has a number
    if (first == i)
    {
      number[i] = regions.size();
      regions.emplace_back();
    }
    regions[number[first]].push_back(pixels[i]);
  }
  return regions;
}

/** Tells the regions of one image. */
class Regions
{
public:
  Regions(const std::vector<RowColumn>& uncovered, const BinaryImage& covered, const LostPartLimits& limits)
    : Covered(covered)
    , Kinds(covered)
    , Limits(limits)
    , Distances(covered.pixels.data(), covered.width, covered.height, limits.distance + 1.0)
  {
    for (const auto& [row, column] : uncovered)
    {
      this->Kinds.at(column, row) = UncoveredObject;
    }
  }

  /** How many pixels of a region are lost? */
  std::uint64_t lost(const std::vector<RowColumn>& region)
  {
    return this->cuts(region) ? region.size() : std::uint64_t(std::count_if(region.begin(), region.end(),
      [this](const RowColumn& pixel) { return -this->Distances.at(pixel.second, pixel.first) > this->Limits.distance; }));
  }

private:
  static constexpr std::uint8_t Background = 0, CoveredPixel = 1, UncoveredObject = 2, Counted = 3;

  /** The pixels beside a pixel, and itself. */
  template <typename Work>
  void forBeside(const RowColumn& pixel, const Work& work) const
  {
    for (int r = std::max(pixel.first - 1, 0); r <= std::min(pixel.first + 1, this->Covered.height - 1); ++r)
    {
      for (int c = std::max(pixel.second - 1, 0); c <= std::min(pixel.second + 1, this->Covered.width - 1); ++c)
      {
        work(r, c);
      }
    }
  }

  bool cuts(const std::vector<RowColumn>& region)
  {
    std::array<std::vector<RowColumn>, 2> beside; // background, covered
    for (const RowColumn& pixel : region)
    {
      this->forBeside(pixel,
        [&](int r, int c)
        {
          if (this->Kinds.at(c, r) != UncoveredObject)
          {
            beside[this->Kinds.at(c, r)].emplace_back(r, c);
          }
        });
    }
    const auto isAny = [](const std::vector<RowColumn>&) { return true; };
    const auto isNoHole = [this](const std::vector<RowColumn>& stretch) { return !this->isHole(stretch.front()); };
    return this->contacts(beside[CoveredPixel], isAny) >= 2 && this->contacts(beside[Background], isNoHole) >= 2;
  }

  /** In how many stretches that pass do pixels, in any order, each any number of times, touch a region? */
  template <typename Passes>
  std::ptrdiff_t contacts(std::vector<RowColumn>& pixels, const Passes& passes) const
  {
    std::sort(pixels.begin(), pixels.end());
    pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
    const auto stretches = regionsOf(pixels);
    return std::count_if(stretches.begin(), stretches.end(),
      [&](const std::vector<RowColumn>& stretch) { return double(stretch.size()) >= this->Limits.contact && passes(stretch); });
  }

  /** Does a pixel belong to background that is smaller than a square of the distance, and all inside the image? Such holes noise makes beside the contour. */
  bool isHole(const RowColumn& pixel)
  {
    const double area = this->Limits.distance * this->Limits.distance;
    std::vector<RowColumn> found = { pixel };
    this->Kinds.at(pixel.second, pixel.first) = Counted;
    bool isHole = true;
    for (std::size_t n = 0; n < found.size() && isHole; ++n)
    {
      const RowColumn from = found[n]; // `found` moves
      this->forBeside(from,
        [&](int r, int c)
        {
          if (this->Kinds.at(c, r) == Background)
          {
            this->Kinds.at(c, r) = Counted;
            found.emplace_back(r, c);
          }
        });
      isHole = double(found.size()) < area && !this->isAtBorder(from);
    }
    for (const auto& [row, column] : found)
    {
      this->Kinds.at(column, row) = Background;
    }
    return isHole;
  }

  bool isAtBorder(const RowColumn& pixel) const
  {
    return pixel.first == 0 || pixel.second == 0 || pixel.first == this->Covered.height - 1 || pixel.second == this->Covered.width - 1;
  }

  const BinaryImage& Covered;
  BinaryImage Kinds;
  const LostPartLimits& Limits;
  DistanceProbe Distances;
};

} // namespace

std::uint64_t pixelsOfLostParts(const std::vector<RowColumn>& uncovered, const BinaryImage& covered, const LostPartLimits& limits)
{
  if (double(uncovered.size()) < limits.area)
  {
    return 0;
  }
  Regions regions(uncovered, covered, limits);
  std::uint64_t pixels = 0;
  for (const auto& region : regionsOf(uncovered))
  {
    pixels += double(region.size()) >= limits.area ? regions.lost(region) : 0;
  }
  return pixels;
}

} // namespace silhouette
