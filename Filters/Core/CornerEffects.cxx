// SPDX-License-Identifier: BSD-3-Clause
#include "CornerEffects.h"

#include <algorithm>
#include <iterator>

namespace silhouette
{
namespace
{

constexpr float Unknown = 1.0f; ///< no depth

/** After all effects. */
enum : std::uint8_t
{
  Depends = 4,  ///< on the components too
  Asked = 0xfe, ///< while looking ahead
  NotAsked = 0xff
};

TopologicalNumbers numbersAt(const LatticePoint& p, LabelCache& cache)
{
  return topologicalNumbers(cache.insideAround(p));
}

/** The effect as far as it is a matter of the labels around a corner. */
std::uint8_t localEffect(const TopologicalNumbers& numbers)
{
  const CornerEffect effect = isSimple(numbers) ? CornerEffect::Nothing
    : numbers.inside == 0                       ? CornerEffect::Founds
                                                : CornerEffect::Otherwise;
  return std::uint8_t(effect == CornerEffect::Otherwise && numbers.outside == 1 ? int(Depends) : int(effect));
}

} // namespace

CornerEffects::CornerEffects(const LatticeLabels& labels, const CornerDepth* depth)
  : Labels(labels)
  , Depth(depth)
  , Cache(labels)
  , Corners(labels.shell().corners)
  , Octants(labels.octree())
  , Supports(depth ? labels.shell().corners.size() : 0, Unknown)
  , Effects(labels.shell().corners.size(), NotAsked)
{
}

CornerEffect CornerEffects::of(std::uint32_t corner, SolidComponents& solid)
{
  std::uint8_t& known = this->Effects[corner];
  if (known < Depends)
  {
    return CornerEffect(known);
  }
  const LatticePoint p = this->point(corner);
  const auto numbers = numbersAt(p, this->Cache);
  known = localEffect(numbers);
  return known < Depends                              ? CornerEffect(known)
    : this->distinctComponents(p, numbers, solid) ? CornerEffect::Joins
                                                  : CornerEffect::Otherwise;
}

float CornerEffects::support(std::uint32_t corner)
{
  if (!this->Depth)
  {
    return this->Labels.support()[corner];
  }
  float& known = this->Supports[corner];
  if (known == Unknown)
  {
    known = this->depthOf(corner, this->Octants);
  }
  return known;
}

std::array<std::ptrdiff_t, 27> CornerEffects::setInside(std::uint32_t corner)
{
  this->Cache.setInside(this->Labels.shell().corners[corner]);
  const CodesAround codes(this->point(corner));
  std::array<std::ptrdiff_t, 27> around;
  for (int n = 0; n < 27; ++n)
  {
    around[n] = n != 13 ? this->Corners.find(codes[n]) : -1;
    if (around[n] >= 0)
    {
      this->Effects[std::size_t(around[n])] = NotAsked;
    }
  }
  return around;
}

/** The cells' corners that may be labelled inside, each once. */
std::vector<std::uint32_t> CornerEffects::cornersToAsk(const std::vector<std::uint32_t>& cells)
{
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t cell : cells)
  {
    for (const std::uint32_t corner : this->Labels.shell().cellCorners[cell])
    {
      if (this->Effects[corner] == NotAsked && !this->Labels.octree().lattice.onBorder(this->point(corner)))
      {
        this->Effects[corner] = Asked;
        corners.push_back(corner);
      }
    }
  }
  return corners;
}

/** The corners of cells of which several have the best effect; ascending. */
std::vector<std::uint32_t> CornerEffects::equalCorners(const std::vector<std::uint32_t>& cells) const
{
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t cell : cells)
  {
    const auto& all = this->Labels.shell().cellCorners[cell];
    std::uint8_t least = NotAsked;
    for (const std::uint32_t corner : all)
    {
      least = std::min(least, this->Effects[corner]);
    }
    const auto isEqual = [&](std::uint32_t corner) { return this->Effects[corner] == least; };
    if (least < NotAsked && std::count_if(all.begin(), all.end(), isEqual) > 1)
    {
      std::copy_if(all.begin(), all.end(), std::back_inserter(corners), isEqual);
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

void CornerEffects::lookAhead(const std::vector<std::uint32_t>& cells, Execution& execution)
{
  const auto asked = this->cornersToAsk(cells);
  execution.forRanges(asked.size(), 1024,
    [&](std::size_t first, std::size_t last)
    {
      LabelCache cache(this->Labels);
      for (std::size_t n = first; n < last; ++n)
      {
        this->Effects[asked[n]] = localEffect(numbersAt(this->point(asked[n]), cache));
      }
    });
  const auto equals = this->Depth ? this->equalCorners(cells) : std::vector<std::uint32_t>();
  execution.forRanges(equals.size(), 256,
    [&](std::size_t first, std::size_t last)
    {
      OctantCursor octants(this->Labels.octree());
      for (std::size_t n = first; n < last; ++n)
      {
        this->Supports[equals[n]] = this->depthOf(equals[n], octants);
      }
    });
}

/** Do the local components around p belong to as many components of the whole solid? */
bool CornerEffects::distinctComponents(const LatticePoint& p, const TopologicalNumbers& numbers, SolidComponents& solid)
{
  std::vector<std::uint32_t> roots;
  for (int part = 0; part < numbers.inside; ++part)
  {
    for (int n = 0; n < 27; ++n)
    {
      const auto corner = numbers.insideComponent[n] == part ? this->Corners.find(mortonCode(neighbourOf(p, n))) : -1;
      if (corner >= 0)
      {
        roots.push_back(solid.of(std::uint32_t(corner)));
        break;
      }
    }
  }
  std::sort(roots.begin(), roots.end());
  return int(roots.size()) == numbers.inside && std::adjacent_find(roots.begin(), roots.end()) == roots.end();
}

} // namespace silhouette
