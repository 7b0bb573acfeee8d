// SPDX-License-Identifier: BSD-3-Clause
#include "CornerEffects.h"

#include <algorithm>

namespace silhouette
{
namespace
{

constexpr float Unknown = 1.0f; ///< no depth

constexpr std::uint8_t NotKnown = 0xff; ///< no effect

} // namespace

std::optional<CornerEffect> localEffect(const TopologicalNumbers& numbers)
{
  const bool mayJoin = numbers.inside > 1 && numbers.outside == 1;
  return mayJoin ? std::nullopt
                 : std::optional(isSimple(numbers)     ? CornerEffect::Nothing
                       : numbers.inside == 0 ? CornerEffect::Founds
                                             : CornerEffect::Otherwise);
}

bool joinsComponents(const LatticePoint& p, const TopologicalNumbers& numbers, CodeCursor& corners, SolidComponents& solid)
{
  std::vector<std::uint32_t> roots;
  for (int part = 0; part < numbers.inside; ++part)
  {
    for (int n = 0; n < 27; ++n)
    {
      const auto corner = numbers.insideComponent[n] == part ? corners.find(mortonCode(neighbourOf(p, n))) : -1;
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

CornerEffects::CornerEffects(const LatticeLabels& labels, const CornerDepth* depth)
  : Labels(labels)
  , Depth(depth)
  , Cache(labels)
  , Corners(labels.shell().corners)
  , Octants(labels.octree())
  , Supports(depth ? labels.shell().corners.size() : 0, Unknown)
  , Effects(labels.shell().corners.size(), NotKnown)
{
}

CornerEffect CornerEffects::of(std::uint32_t corner, SolidComponents& solid)
{
  std::uint8_t& known = this->Effects[corner];
  if (known != NotKnown)
  {
    return CornerEffect(known);
  }
  const LatticePoint p = this->point(corner);
  const auto numbers = topologicalNumbers(this->Cache.insideAround(p));
  const auto effect = localEffect(numbers);
  known = effect ? std::uint8_t(*effect) : NotKnown;
  return effect                                              ? *effect
    : joinsComponents(p, numbers, this->Corners, solid) ? CornerEffect::Joins
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
    known = float((*this->Depth)(this->point(corner), this->Octants));
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
      this->Effects[std::size_t(around[n])] = NotKnown;
    }
  }
  return around;
}

} // namespace silhouette
