// SPDX-License-Identifier: BSD-3-Clause
/**
 * How the components of a closed lattice surface lie in each other: outer walls of solids, walls of their cavities, and what lies
 * in those. Found on the lattice rows, where a surface's components follow each other, without any look at volumes.
 */
#pragma once

#include "LatticeSurface.h"

namespace silhouette
{

constexpr std::uint32_t NoComponent = 0xffffffffu;

/** The components, ordered by their first edges. */
struct SurfaceNesting
{
  /** Where the surface crosses a row along x. */
  struct Crossing
  {
    std::uint64_t row = 0;    ///< rowKey
    std::int32_t lower = 0;   ///< lower end of the crossed edge
    std::uint32_t edge = 0;   ///< number of the surface's edge
    bool entering = false;    ///< does the row enter the solid, going up?
  };

  std::vector<std::uint32_t> component;  ///< of each edge of the surface
  std::vector<std::uint32_t> parent;     ///< of each component the one that encloses it directly, or NoComponent
  std::vector<std::uint8_t> cavity;      ///< of each component, 1 where it is a cavity's wall
  std::vector<Crossing> crossings;       ///< ascending by row and place

  /** The outer wall of the solid that a component bounds. */
  std::uint32_t solidOf(std::uint32_t c) const { return this->cavity[c] ? this->parent[c] : c; }
  /** The outer wall of the solid that holds an inside lattice point. Cost: a binary search. */
  std::uint32_t solidAt(const LatticePoint& p) const;
};

/** Cost: n log n in the surface's edges. */
SurfaceNesting nestSurface(const CornerShell& shell, const LatticeSurface& surface);

/** The surface, and the fractions of its edges, without the components whose `keep` is 0. */
void keepComponents(
  const SurfaceNesting& nesting, const std::vector<std::uint8_t>& keep, LatticeSurface& surface, std::vector<double>& fractions);

} // namespace silhouette
