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
#include <cstdint>
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

  /**
   * What will be asked first of `cells` without an inside corner, side by side: the effects of their corners on the labels as they are, and the support of
   * those that are equal. Decides nothing.
   */
  void lookAhead(const std::vector<std::uint32_t>& cells, Execution& execution);

private:
  LatticePoint point(std::uint32_t corner) const { return fromMorton(this->Labels.shell().corners[corner]); }
  float depthOf(std::uint32_t corner, OctantCursor& octants) const { return float((*this->Depth)(this->point(corner), octants)); }
  std::vector<std::uint32_t> cornersToAsk(const std::vector<std::uint32_t>& cells);
  std::vector<std::uint32_t> equalCorners(const std::vector<std::uint32_t>& cells) const;
  bool distinctComponents(const LatticePoint& p, const TopologicalNumbers& numbers, SolidComponents& solid);

  const LatticeLabels& Labels;
  const CornerDepth* Depth;
  LabelCache Cache;
  CodeCursor Corners;
  OctantCursor Octants;
  std::vector<float> Supports;       ///< by Depth, of each corner of the shell that it was asked for
  std::vector<std::uint8_t> Effects; ///< of each corner, as long as no label around it changes
};

} // namespace silhouette
