// SPDX-License-Identifier: BSD-3-Clause
/**
 * The methods that the study compares: a line of one table each.
 */
#pragma once

#include "Trial.h"

#include <functional>
#include <string>
#include <vector>

namespace silhouette::experiments
{

/** Families that the report looks for the best of, or speaks of as one. */
enum class Family
{
  Cubes,
  Faithful,
  Consistent,
  Known,   ///< what VTK and Qhull have
  Hulls,   ///< ours: these keep the promises
  Ablation ///< ours without one of its stages
};

struct Method
{
  std::string name;
  std::string label;
  Family family;
  int backgroundVotes; ///< of the octree that it is made from, whose survivors may be lost
  bool firstSeedOnly;  ///< slow, or less asked after
  std::function<Mesh(Trial&)> make;
};

/** The ablation that gives islands and debris up. */
inline constexpr const char* WithoutIslands = "no-islands";

const std::vector<Method>& methods();
/** The robust local hulls, each without one of their stages. */
const std::vector<Method>& ablations();
/** The named one, of both tables. Throws InvalidInput where there is none. */
const Method& methodNamed(const std::string& name);

} // namespace silhouette::experiments
