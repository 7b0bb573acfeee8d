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
  Regions(const BinaryImage& covered, const LostPartLimits& limits)
    : Covered(covered)
    , Limits(limits)
    , Distances(covered.pixels.data(), covered.width, covered.height, limits.distance + 1.0)
  {
  }

  /** How many pixels of a region are lost? */
  std::uint64_t lost(const std::vector<RowColumn>& region)
  {
    return this->cuts(region) ? region.size() : std::uint64_t(std::count_if(region.begin(), region.end(),
      [this](const RowColumn& pixel) { return -this->Distances.at(pixel.second, pixel.first) > this->Limits.distance; }));
  }

private:
  bool cuts(const std::vector<RowColumn>& region)
  {
    std::array<std::vector<RowColumn>, 2> beside; // background, covered
    for (const auto& [row, column] : region)
    {
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, this->Covered.height - 1); ++r)
      {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, this->Covered.width - 1); ++c)
        {
          if (!std::binary_search(region.begin(), region.end(), RowColumn(r, c)))
          {
            beside[this->Covered.at(c, r)].emplace_back(r, c);
          }
        }
      }
    }
    return std::all_of(beside.begin(), beside.end(), [this](std::vector<RowColumn>& pixels) { return this->contacts(pixels) >= 2; });
  }

  /** In how many stretches do pixels, in any order, each any number of times, touch a region? */
  std::ptrdiff_t contacts(std::vector<RowColumn>& pixels) const
  {
    std::sort(pixels.begin(), pixels.end());
    pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
    const auto stretches = regionsOf(pixels);
    return std::count_if(stretches.begin(), stretches.end(),
      [this](const std::vector<RowColumn>& stretch) { return double(stretch.size()) >= this->Limits.contact; });
  }

  const BinaryImage& Covered;
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
  Regions regions(covered, limits);
  std::uint64_t pixels = 0;
  for (const auto& region : regionsOf(uncovered))
  {
    pixels += double(region.size()) >= limits.area ? regions.lost(region) : 0;
  }
  return pixels;
}

} // namespace silhouette
