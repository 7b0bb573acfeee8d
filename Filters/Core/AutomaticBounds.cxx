// SPDX-License-Identifier: BSD-3-Clause
#include "AutomaticBounds.h"

#include "Carving.h"

#include <algorithm>

namespace silhouette
{
namespace
{

/** The box of the octants that survive a carve of `cube`. */
Box survivorsBox(
  const PreparedViews& views, const RootCube& cube, int depth, int backgroundVotes, Execution& execution)
{
  const Lattice lattice{ cube, depth };
  CarveOptions options;
  options.backgroundVotes = backgroundVotes;
  const Octree octree = carve(LatticeViews(views, lattice), options, execution);
  Box box;
  for (int g = octree.treeGeneration; g <= depth; ++g)
  {
    const auto& generation = octree.generations[g];
    const std::int32_t size = std::int32_t(1) << (depth - g);
    for (std::size_t i = 0; i < generation.size(); ++i)
    {
      const bool survivor = generation.state[i] == OctantState::Inside ||
        (g == depth && generation.state[i] == OctantState::Intersection);
      if (survivor)
      {
        const LatticePoint p = fromMorton(generation.code[i]);
        box.extend(lattice.position({ p.i * size, p.j * size, p.k * size }));
        box.extend(lattice.position({ (p.i + 1) * size, (p.j + 1) * size, (p.k + 1) * size }));
      }
    }
  }
  return box;
}

/** The cube around `box` that keeps `margin` of its edge free on each side of the longest one. */
RootCube cubeAround(const Box& box, double margin)
{
  const double edge = box.sizes().maxCoeff() / (1.0 - 2.0 * margin);
  return { box.center() - Vector3::Constant(0.5 * edge), edge };
}

} // namespace

RootCube enclosingCube(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest)
{
  const double edge = (highest - lowest).maxCoeff();
  if (!lowest.allFinite() || !highest.allFinite() || !((highest - lowest).minCoeff() > 0.0))
  {
    throw InvalidInput("the bounds are empty or not finite: every upper bound must lie above the lower one");
  }
  return { 0.5 * (lowest + highest) - Vector3::Constant(0.5 * edge), edge };
}

RootCube automaticBounds(const PreparedViews& views, const AutomaticBoundsOptions& options, Execution& execution)
{
  constexpr int CoarseDepth = 6;
  constexpr int FineDepth = 7;
  const Box cones = intersectViewingCones(views, options.backgroundVotes);
  execution.checkpoint(0.1);
  // A 64th of the edge stays free at each side: an octant that touches the cube's border says nothing of what is beyond.
  constexpr double CoarseMargin = 1.0 / 64.0;
  RootCube cube = cubeAround(cones, CoarseMargin);
  constexpr int Rounds = 8;
  for (int round = 0; round < Rounds; ++round)
  {
    Phase phase(execution, 0.1 + 0.05 * round, 0.1 + 0.05 * (round + 1));
    const Box box = survivorsBox(views, cube, CoarseDepth, options.backgroundVotes, phase);
    const RootCube tighter = cubeAround(box, CoarseMargin);
    const bool settled = tighter.edge > 0.97 * cube.edge;
    cube = tighter.edge < cube.edge ? tighter : cube;
    if (settled)
    {
      break;
    }
  }
  Phase last(execution, 0.5, 1.0);
  const Box box = survivorsBox(views, cube, FineDepth, options.backgroundVotes, last);
  // One leaf of the final depth, and a hundredth of one against rounding.
  const double margin = options.depth > 1 ? 1.01 * std::ldexp(1.0, -options.depth) : 0.05;
  return cubeAround(box, std::min(margin, 0.3));
}

} // namespace silhouette
