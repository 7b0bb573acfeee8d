// SPDX-License-Identifier: BSD-3-Clause
#include "LoneCarvers.h"

#include "Carving.h"
#include "OctantTest.h"

#include <algorithm>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr int CoarsestSearch = 5;
constexpr int FinestSearch = 8; ///< so that the search costs no more than a carve of an ordinary depth

/** The whole root cube carved; nothing may be left. */
Octree carved(const LatticeViews& views, int backgroundVotes, Execution& execution)
{
  Unannounced quiet(execution);
  CarveOptions options;
  options.backgroundVotes = backgroundVotes;
  options.trees.resize(std::size_t(1) << 3 * treeGeneration(views.lattice().depth)); // all by name, of which none need survive
  std::iota(options.trees.begin(), options.trees.end(), std::uint64_t(0));
  return carve(views, options, quiet);
}

/** Mark the views, `votes` of them at most, that call a box background; those that are marked are asked first. */
void markObjectors(const LatticeViews& views, const OctantBox& box, int votes, std::vector<bool>& marked)
{
  const std::vector<bool> known = marked;
  for (const bool isKnown : { true, false })
  {
    for (int i = 0; i < views.size() && votes > 0; ++i)
    {
      if (known[std::size_t(i)] == isKnown && relate(views.view(i), views.projection(i), box) == ViewRelation::Background)
      {
        marked[std::size_t(i)] = true;
        --votes;
      }
    }
  }
}

} // namespace

std::vector<bool> loneCarvers(const PreparedViews& views, const Lattice& lattice, int backgroundVotes, Execution& execution)
{
  std::vector<bool> marked(std::size_t(views.size()), false);
  const int finest = std::min(lattice.depth, FinestSearch);
  Lattice coarse = lattice;
  coarse.depth = std::min(lattice.depth, CoarsestSearch);
  // A carve that leaves something with all views leaves it without any of them, and would name them all.
  while (coarse.depth <= finest && anySurvivor(carved(LatticeViews(views, coarse), backgroundVotes, execution)))
  {
    ++coarse.depth;
  }
  if (coarse.depth > finest || backgroundVotes + 1 >= views.size())
  {
    return marked;
  }
  // What survives if one view more may dissent survives without any one of the views that do.
  const LatticeViews coarseViews(views, coarse);
  const Octree octree = carved(coarseViews, backgroundVotes + 1, execution);
  for (int g = octree.treeGeneration; g <= coarse.depth; ++g)
  {
    execution.checkpoint(1.0);
    const Generation& generation = octree.generations[std::size_t(g)];
    for (std::size_t n = 0; n < generation.size(); ++n)
    {
      const OctantState state = generation.state[n];
      if (state == OctantState::Inside || (state == OctantState::Intersection && g == coarse.depth))
      {
        const std::int32_t size = std::int32_t(1) << (coarse.depth - g);
        const LatticePoint p = fromMorton(generation.code[n]);
        markObjectors(coarseViews, { { size * p.i, size * p.j, size * p.k }, size }, backgroundVotes + 1, marked);
      }
    }
  }
  return marked;
}

} // namespace silhouette
