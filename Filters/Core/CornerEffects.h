// SPDX-License-Identifier: BSD-3-Clause
/**
 * What labelling a corner inside would do, and how much speaks for it: remembered until a label beside it changes.
 */
#pragma once

#include "CodeCursor.h"
#include "CornerDepth.h"
#include "LabelCache.h"
#include "LatticeRegions.h"
#include "SimplePoint.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace silhouette
{

/** What labelling a corner inside does to the topology, best first. */
enum class CornerEffect : int
{
  Nothing,  ///< the corner is simple
  Joins,    ///< it joins components and makes no tunnel
  Founds,   ///< it starts a component of its own
  Otherwise ///< tunnels or cavities may come or go
};

/** The effect as far as it is a matter of the labels around a corner; nothing where it joins components or else makes tunnels, by what these are. */
std::optional<CornerEffect> localEffect(const TopologicalNumbers& numbers);

/** Do the parts of the solid around a point, as `numbers` has them, belong to as many of its components? `corners`: the codes of the shell's. */
bool joinsComponents(const LatticePoint& p, const TopologicalNumbers& numbers, CodeCursor& corners, SolidComponents& solid);

/**
 * Of corners with equal effects, in ascending order of their numbers or not, the one with most support, which is asked for where there are several; of these the one that
 * covers most octants, which is asked for where supports are equal; of these the one with the least number. `support(corner, least)` may tell anything between a
 * support that is less than `least` and that.
 */
template <typename Support, typename Covers>
std::uint32_t bestOfEquals(const std::uint32_t* equals, std::size_t count, const Support& support, const Covers& covers)
{
  std::uint32_t best = equals[0];
  float most = count > 1 ? support(best, -std::numeric_limits<float>::infinity()) : 0.0f;
  for (std::size_t n = 1; n < count; ++n)
  {
    const std::uint32_t corner = equals[n];
    const float own = support(corner, most);
    bool isBetter = own > most;
    if (own == most)
    {
      const int cells = covers(corner), others = covers(best);
      isBetter = cells > others || (cells == others && corner < best);
    }
    best = isBetter ? corner : best;
    most = isBetter ? own : most;
  }
  return best;
}

/** Of corners of the labels' shell that are outside and not on the root cube's border. For one thread at a time. */
class CornerEffects
{
public:
  /** Labels and `depth`, which may be null, have to outlive this; the shell has to stay. */
  CornerEffects(const LatticeLabels& labels, const CornerDepth* depth);

  /** The effect now; `solid` are the solid's components now. Cost: a few operations where it is known, else the 26 points around. */
  CornerEffect of(std::uint32_t corner, SolidComponents& solid);
  /** How little far outside the silhouettes a corner is, by `depth`; without it the labels' support. */
  float support(std::uint32_t corner);

  /** A corner is labelled inside now. Returns the shell's corners around it, -1 where there is none and for itself. */
  std::array<std::ptrdiff_t, 27> setInside(std::uint32_t corner);

private:
  LatticePoint point(std::uint32_t corner) const { return fromMorton(this->Labels.shell().corners[corner]); }

  const LatticeLabels& Labels;
  const CornerDepth* Depth;
  LabelCache Cache;
  CodeCursor Corners;
  OctantCursor Octants;
  std::vector<float> Supports;       ///< by Depth, of each corner of the shell that it was asked for
  std::vector<std::uint8_t> Effects; ///< of each corner, as long as no label around it changes
};

} // namespace silhouette
