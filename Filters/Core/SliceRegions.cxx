// SPDX-License-Identifier: BSD-3-Clause
#include "SliceRegions.h"

#include "ParameterRange.h"
#include "RowIntervals.h"
#include "UnionFind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace silhouette
{
namespace
{

/** The survivors by slices along one axis: octants of each generation by their layer. */
class SliceIndex
{
public:
  SliceIndex(const Octree& octree, const std::vector<std::uint64_t>& furtherCells, int axis)
    : Depth(octree.lattice.depth)
    , Layers(octree.generations.size())
  {
    const auto add = [&](int g, const LatticePoint& p)
    {
      const std::int32_t w = coordinateOf(p, axis);
      this->Layers[g].push_back({ w, coordinateOf(p, (axis + 1) % 3), coordinateOf(p, (axis + 2) % 3) });
      const int shift = this->Depth - g;
      this->First = std::min(this->First, w << shift);
      this->End = std::max(this->End, (w + 1) << shift);
    };
    for (int g = octree.treeGeneration; g <= this->Depth; ++g)
    {
      const auto& generation = octree.generations[g];
      for (std::size_t n = 0; n < generation.size(); ++n)
      {
        if (generation.state[n] == OctantState::Inside ||
          (g == this->Depth && generation.state[n] == OctantState::Intersection))
        {
          add(g, fromMorton(generation.code[n]));
        }
      }
    }
    for (const std::uint64_t cell : furtherCells)
    {
      add(this->Depth, fromMorton(cell));
    }
    for (auto& layer : this->Layers)
    {
      std::sort(layer.begin(), layer.end());
    }
  }

  std::int32_t first() const { return this->First; }
  std::int32_t count() const { return std::max(0, this->End - this->First); }

  SliceRuns runs(std::int32_t slice) const
  {
    SliceRuns all;
    for (int g = 0; g < int(this->Layers.size()); ++g)
    {
      const int shift = this->Depth - g;
      const std::int32_t layer = slice >> shift;
      auto at = std::lower_bound(this->Layers[g].begin(), this->Layers[g].end(), std::array<std::int32_t, 3>{ layer });
      for (; at != this->Layers[g].end() && (*at)[0] == layer; ++at)
      {
        const std::int32_t u = (*at)[1] << shift, v = (*at)[2] << shift, size = std::int32_t(1) << shift;
        for (std::int32_t row = v; row < v + size; ++row)
        {
          all.push_back({ row, u, u + size });
        }
      }
    }
    std::sort(all.begin(), all.end());
    SliceRuns merged;
    for (const auto& run : all)
    {
      if (!merged.empty() && merged.back().v == run.v && run.from <= merged.back().to)
      {
        merged.back().to = std::max(merged.back().to, run.to);
      }
      else
      {
        merged.push_back(run);
      }
    }
    return merged;
  }

private:
  int Depth;
  std::vector<std::vector<std::array<std::int32_t, 3>>> Layers; ///< for each generation layer, place, row; ascending
  std::int32_t First = std::int32_t(1) << MaximumDepth, End = 0;
};

SlicedVolume sliceAlong(const Octree& octree, const std::vector<std::uint64_t>& furtherCells, int axis,
  double tolerance, Execution& execution)
{
  const SliceIndex index(octree, furtherCells, axis);
  SlicedVolume volume;
  volume.axis = axis;
  volume.firstSlice = index.first();
  volume.parts.resize(std::size_t(index.count()));
  std::vector<std::uint64_t> regions(volume.parts.size());
  constexpr std::size_t Block = 64; // slices between two looks at whether to stop
  for (std::size_t begin = 0; begin < volume.parts.size(); begin += Block)
  {
    execution.checkpoint(double(begin) / double(volume.parts.size()));
    execution.forRanges(std::min(Block, volume.parts.size() - begin), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t s = begin + first; s < begin + last; ++s)
        {
          const SliceRuns slice = index.runs(volume.firstSlice + std::int32_t(s));
          for (const auto& region : connectedRegions(slice))
          {
            auto parts = convexParts(region, slice, tolerance);
            std::move(parts.begin(), parts.end(), std::back_inserter(volume.parts[s]));
            ++regions[s];
          }
        }
      });
  }
  for (const std::uint64_t count : regions)
  {
    volume.regions += count;
  }
  execution.checkpoint(1.0);
  return volume;
}

std::uint64_t partCount(const SlicedVolume& volume)
{
  std::uint64_t count = 0;
  for (const auto& slice : volume.parts)
  {
    count += slice.size();
  }
  return count;
}

/** Fewer parts a slice, then more slices. */
bool better(const SlicedVolume& a, const SlicedVolume& b)
{
  const std::uint64_t left = partCount(a) * b.parts.size(), right = partCount(b) * a.parts.size();
  return left != right ? left < right : a.parts.size() > b.parts.size();
}

} // namespace

SlicedVolume sliceVolume(const Octree& octree, const std::vector<std::uint64_t>& furtherCells,
  const SliceOptions& options, Execution& execution)
{
  requireRange("slice axis", options.axis, -1, 2);
  requireRange("slice tolerance", options.tolerance, 0.0);
  if (options.axis >= 0)
  {
    return sliceAlong(octree, furtherCells, options.axis, options.tolerance, execution);
  }
  SlicedVolume best;
  for (int axis = 0; axis < 3; ++axis)
  {
    Phase phase(execution, axis / 3.0, (axis + 1) / 3.0);
    SlicedVolume volume = sliceAlong(octree, furtherCells, axis, options.tolerance, phase);
    if (axis == 0 || better(volume, best))
    {
      best = std::move(volume);
    }
  }
  return best;
}

} // namespace silhouette
