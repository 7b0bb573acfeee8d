// SPDX-License-Identifier: BSD-3-Clause
/**
 * The first part of covering (SurvivorCovering.h): every octant that has no inside corner gets one.
 */
#pragma once

#include "CornerDepth.h"
#include "LatticeLabels.h"

#include <cstdint>
#include <vector>

namespace silhouette
{

struct LostCovering
{
  std::vector<std::uint32_t> corners; ///< of the labels' shell, that were labelled inside
  bool mayEnclose = false;            ///< one of these may have changed more than components of the solid
};

/**
 * Grow from the solid, a corner at a time, as long as that changes no topology but for joining components; then found a component in the first octant that is left,
 * grow again, and so on. Which of an octant's corners is taken coverSurvivors() tells. `lost`: the shell's survivors without an inside corner, ascending. Those far from
 * one another (PointClusters.h) are covered side by side where that is a matter of the labels around them alone; where it takes the solid's components to tell, one after
 * another. Cost: linear in the lost octants.
 */
LostCovering coverLost(LatticeLabels& labels, const std::vector<std::uint32_t>& lost, const CornerDepth* depth, Execution& execution);

} // namespace silhouette
